# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Regain builds as shared libraries, installs, shows nothing internal to those who
# link it, and the consumer runs against it.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

# Without optimisation: what is looked at is linking. What is optimised whatever is built is left
# out, for it takes longer than all the rest.
set(CONFIG Debug)
configure_and_build(${SOURCE_DIR} ${SCRATCH}/build -DBUILD_SHARED_LIBS=ON -DREGAIN_BUILD_WIDE=OFF
  -DREGAIN_BUILD_LUTS=${LUTS} -DREGAIN_BUILD_SHADERS=${SHADERS} -DREGAIN_BUILD_ADAPTERS=${ADAPTERS}
  -DREGAIN_BUILD_CONFORMANCE=${CONFORMANCE} -DREGAIN_BUILD_TOOLS=OFF -DREGAIN_BUILD_TESTS=OFF)
install(${SCRATCH}/build ${SCRATCH}/prefix)
separate_arguments(parts UNIX_COMMAND "${PARTS}")
check_parts(${SCRATCH}/prefix ${parts})

find_program(NM nm)
file(GLOB_RECURSE libraries ${SCRATCH}/prefix/*.so)
if(NM)
  foreach(library IN LISTS libraries)
    run(${NM} --dynamic --defined-only --demangle ${library})
    if(output MATCHES "[^\n]* regain::(v[0-9_]+::)?([a-z]+::)?detail::[^\n]*")
      message(FATAL_ERROR "${library} shows what should be hidden: ${CMAKE_MATCH_0}")
    endif()
  endforeach()
endif()

list(JOIN parts " " parts)
build_and_run_consumer(${CMAKE_CURRENT_LIST_DIR}/consumer ${SCRATCH}/prefix "-DPARTS=${parts}")
