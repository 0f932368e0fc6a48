# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# The example plug-ins are projects of their own: each builds against the installed package, and is
# loaded by the installed program.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

foreach(host renderman clarisse osl)
  configure_and_build(${SOURCE_DIR}/adapters/${host}/example ${SCRATCH}/${host}
    -DCMAKE_PREFIX_PATH=${INSTALLED})
endforeach()
if(TOOLS)
  foreach(plugin renderman/regain_surface clarisse/regain_car_paint osl/regain_brocade)
    run(${INSTALLED}/bin/regain render --plugin ${SCRATCH}/${plugin}.so --spp 1
      --size 16x16 --quiet -o ${SCRATCH}/picture.exr)
  endforeach()
endif()
