# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Two versions of Regain in one program keep out of each other's way, linked statically and as shared
# libraries. The second is this one under the next version's namespace and with a fault by which it
# is told: its metals reflect half. And a host may compile what it includes without exceptions, without
# type information, and as C++20.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

foreach(_version first second)
  file(COPY ${SOURCE_DIR}/closures/include/regain/closures ${SOURCE_DIR}/adapters/renderman/include/regain/renderman
    DESTINATION ${SCRATCH}/${_version}/regain)
endforeach()

function(change file from to)
  file(READ ${SCRATCH}/second/regain/closures/${file} text)
  string(REPLACE "${from}" "${to}" changed "${text}")
  if(changed STREQUAL text)
    message(FATAL_ERROR "${file} has no '${from}' to change")
  endif()
  file(WRITE ${SCRATCH}/second/regain/closures/${file} "${changed}")
endfunction()
change(version.h "REGAIN_ABI_NAMESPACE v0_1" "REGAIN_ABI_NAMESPACE v0_2")
change(conductor_fresnel.h "return channel(n, k, std::decay_t<decltype(n)>(mu))"
  "return channel(n, k, std::decay_t<decltype(n)>(mu)) * Real(0.5f)")

# Without optimisation templates are functions for the linker to choose from.
set(CONFIG Debug)
foreach(shared OFF ON)
  configure_and_build(${CMAKE_CURRENT_LIST_DIR}/two_versions ${SCRATCH}/build_${shared}
    -DFIRST=${SCRATCH}/first -DSECOND=${SCRATCH}/second -DSHARED=${shared})
  run(${SCRATCH}/build_${shared}/both)
  message("${output}")
endforeach()
