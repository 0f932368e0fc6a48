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

# regain_wide(SET FILES file ... FLAGS [flag ...])
function(regain_wide set)
  cmake_parse_arguments(arg "" "" "FILES;FLAGS" ${ARGN})
  set(target regain_wide_${set})
  string(TOUPPER ${set} upper)
  list(TRANSFORM arg_FILES PREPEND src/wide/)
  add_library(${target} OBJECT ${arg_FILES})
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
    ${arg_FLAGS} -O2 -ffp-contract=off
    $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized>)
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/shaders/include)
  target_link_libraries(${target} PRIVATE Regain::luts xsimd $<BUILD_INTERFACE:regain_warnings>)
  target_sources(regain_shaders PRIVATE $<TARGET_OBJECTS:${target}>)
  target_compile_definitions(regain_shaders PRIVATE REGAIN_HAS_${upper})
endfunction()

# Distributions with a tail are rare, and take as long to compile as all others: one instruction set
# has them, which those with AVX-512 use, too.
set(_files beckmann.cpp ggx.cpp plain.cpp)
set(_tails gtr.cpp std.cpp)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  regain_wide(sse4_2 FILES ${_files} FLAGS -msse4.2)
  regain_wide(avx2 FILES ${_files} ${_tails} FLAGS -mavx2 -mfma)
  set(_avx512 -mavx512f -mavx512cd -mavx512dq -mavx512bw -mavx512vl -mavx2 -mfma)
  check_cxx_compiler_flag(-mavx512bw REGAIN_COMPILER_HAS_AVX512)
  if(REGAIN_COMPILER_HAS_AVX512)
    regain_wide(avx512 FILES ${_files} FLAGS ${_avx512})
  endif()
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  regain_wide(neon FILES ${_files} ${_tails})
else()
  message(STATUS "No wide closures: they are built for x86-64 and 64-bit ARM")
endif()
