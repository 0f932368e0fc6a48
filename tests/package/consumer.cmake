# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# A separate project finds the installed package, links every part of it and runs; each installed
# header compiles by itself. (closures_alone.cmake sees to those of the closures.)

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

build_and_run_consumer(${CMAKE_CURRENT_LIST_DIR}/consumer ${INSTALLED} "-DPARTS=${PARTS}")

separate_arguments(parts UNIX_COMMAND "${PARTS}")
list(REMOVE_ITEM parts closures)
if(parts)
  list(JOIN parts " " parts)
  configure_and_build(${CMAKE_CURRENT_LIST_DIR}/headers ${SCRATCH}/headers
    -DCMAKE_PREFIX_PATH=${INSTALLED} "-DPARTS=${parts}")
endif()
