# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# As a folder in another project's tree, Regain brings its libraries: no programs, tests or install
# rules, and no setting of the other project is changed.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

configure_and_build(${CMAKE_CURRENT_LIST_DIR}/consumer ${SCRATCH}/consumer -DREGAIN_BUILD_WIDE=OFF
  -DREGAIN_SOURCE_DIR=${SOURCE_DIR}
  -DREGAIN_BUILD_LUTS=${LUTS} -DREGAIN_BUILD_SHADERS=${SHADERS} -DREGAIN_BUILD_ADAPTERS=${ADAPTERS})
run(${SCRATCH}/consumer/consumer)
message("${output}")

run(${CMAKE_COMMAND} --install ${SCRATCH}/consumer --prefix ${SCRATCH}/prefix)
file(GLOB_RECURSE installed ${SCRATCH}/prefix/*)
if(installed)
  message(FATAL_ERROR "installed with the other project: ${installed}")
endif()
