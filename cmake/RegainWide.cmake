# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# The files of shaders/src/wide, once for each instruction set that the compiler has; which of them
# is used is decided at run time.

find_package(xsimd QUIET)
if(NOT xsimd_FOUND)
  message(STATUS "No wide closures: they need xsimd (Debian, Ubuntu: libxsimd-dev)")
  return()
endif()
include(CheckCXXCompilerFlag)

# regain_wide(SET [flag ...])
function(regain_wide set)
  set(target regain_wide_${set})
  string(TOUPPER ${set} upper)
  add_library(${target} OBJECT
    src/wide/beckmann.cpp
    src/wide/ggx.cpp
    src/wide/gtr.cpp
    src/wide/plain.cpp
    src/wide/std.cpp)
  set_target_properties(${target} PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    POSITION_INDEPENDENT_CODE ON)
  target_compile_definitions(${target} PRIVATE REGAIN_WIDE_${upper})
  # Optimised whatever is being built: what is not inlined the linker may share with code for other
  # processors. Products and sums stay two operations, which is what makes the answers those of
  # scalar code, for 1 to 4 % of the time. Of the intrinsics for AVX-512 g++ 12 thinks that they read
  # what they leave undefined.
  target_compile_options(${target} PRIVATE
    ${ARGN} -O2 -ffp-contract=off
    $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized>)
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/shaders/include)
  target_link_libraries(${target} PRIVATE Regain::luts xsimd $<BUILD_INTERFACE:regain_warnings>)
  target_sources(regain_shaders PRIVATE $<TARGET_OBJECTS:${target}>)
  target_compile_definitions(regain_shaders PRIVATE REGAIN_HAS_${upper})
endfunction()

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  regain_wide(sse4_2 -msse4.2)
  regain_wide(avx2 -mavx2 -mfma)
  set(_avx512 -mavx512f -mavx512cd -mavx512dq -mavx512bw -mavx512vl -mavx2 -mfma)
  check_cxx_compiler_flag(-mavx512bw REGAIN_COMPILER_HAS_AVX512)
  if(REGAIN_COMPILER_HAS_AVX512)
    regain_wide(avx512 ${_avx512})
  endif()
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  regain_wide(neon)
else()
  message(STATUS "No wide closures: they are built for x86-64 and 64-bit ARM")
endif()
