# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# With everything else switched off, Regain configures on a machine that has Imath and no other
# library, installs its closures, and each of their headers compiles by itself, as C++17 with the
# compiler of this build, and all of them together as C++20, and as either with one of the other family if
# there is one, without a warning.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(other_packages "")
foreach(name OpenEXR OpenColorIO OpenImageIO embree TBB xsimd CLI11 nlohmann_json fmt GTest
        benchmark pugixml expat ZLIB MaterialX)
  list(APPEND other_packages -DCMAKE_DISABLE_FIND_PACKAGE_${name}=ON)
endforeach()

configure_and_build(${SOURCE_DIR} ${SCRATCH}/build ${other_packages}
  -DREGAIN_BUILD_LUTS=OFF -DREGAIN_BUILD_SHADERS=OFF -DREGAIN_BUILD_ADAPTERS=OFF
  -DREGAIN_BUILD_TOOLS=OFF -DREGAIN_BUILD_TESTS=OFF -DREGAIN_BUILD_BENCHMARKS=OFF)
install(${SCRATCH}/build ${SCRATCH}/prefix)
check_parts(${SCRATCH}/prefix closures)

# On many systems all libraries share one include folder, where a stray include would be found.
file(GLOB_RECURSE headers ${SCRATCH}/prefix/include/*.h)
foreach(header IN LISTS headers)
  if(header MATCHES "/closures/(xsimd|wide_closure|wide_walks)\\.h$")
    continue()
  endif()
  file(STRINGS ${header} includes REGEX "^ *# *include")
  foreach(line IN LISTS includes)
    if(NOT line MATCHES "<(regain/closures/[a-z0-9_/]+\\.h|Imath/[A-Za-z0-9]+\\.h|[a-z0-9_]+|emmintrin\\.h)>")
      message(FATAL_ERROR "closures may include the standard library, Imath and the compiler's intrinsics, nothing else:\n"
        "${header}: ${line}")
    endif()
  endforeach()
endforeach()

build_and_run_consumer(${CMAKE_CURRENT_LIST_DIR}/consumer ${SCRATCH}/prefix ${other_packages})

# The compiler of the build under test, and of the other family whatever there is.
set(compilers ${CXX})
if(CXX MATCHES "clang")
  find_program(OTHER_CXX NAMES g++)
else()
  find_program(OTHER_CXX NAMES clang++ clang++-19 clang++-16 clang++-14)
endif()
if(OTHER_CXX)
  list(APPEND compilers ${OTHER_CXX})
endif()
set(alone 17)
foreach(CXX IN LISTS compilers)
  get_filename_component(name ${CXX} NAME)
  string(MAKE_C_IDENTIFIER ${name} name)
  configure_and_build(${CMAKE_CURRENT_LIST_DIR}/headers ${SCRATCH}/headers_${name}
    ${other_packages} -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DALONE=${alone})
  set(alone none)
  message("headers compile with ${CXX}")
endforeach()
