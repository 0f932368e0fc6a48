# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Steps that the package tests share. Included by scripts that CMakeLists.txt starts with the
# settings of the build under test: SOURCE_DIR, BUILD_DIR, CONFIG, GENERATOR, CXX, CXX_FLAGS,
# CXX_STANDARD; SCRATCH, the test's own folder; INSTALLED, where the test package.installs leaves the
# installed tree; PARTS, the libraries that are built, separated by spaces.

cmake_minimum_required(VERSION 3.22)

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

# Runs a command; stops the test with all that the command said if it fails. Sets `output`.
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "failed (${code}): ${command}\n${said}")
  endif()
  set(output "${said}" PARENT_SCOPE)
endfunction()

# configure_and_build(SOURCE BUILD [cache setting ...]) with the compiler of the build under test.
function(configure_and_build source build)
  set(settings
    -G ${GENERATOR} -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_CXX_FLAGS=${CXX_FLAGS} -DCMAKE_CXX_EXTENSIONS=OFF)
  if(CXX_STANDARD)
    list(APPEND settings -DCMAKE_CXX_STANDARD=${CXX_STANDARD})
  endif()
  run(${CMAKE_COMMAND} -S ${source} -B ${build} ${settings} ${ARGN})
  run(${CMAKE_COMMAND} --build ${build} --config ${CONFIG} --parallel 2)
endfunction()

function(install build prefix)
  run(${CMAKE_COMMAND} --install ${build} --config ${CONFIG} --prefix ${prefix})
endfunction()

# Builds the consumer against an installed tree and runs it.
function(build_and_run_consumer source prefix)
  configure_and_build(${source} ${SCRATCH}/consumer -DCMAKE_PREFIX_PATH=${prefix} ${ARGN})
  run(${SCRATCH}/consumer/consumer)
  message("${output}")
endfunction()

# Sets OUT to the sorted files under PREFIX, written the same for every system and kind of library:
# the library folder as lib, libraries as lib/libNAME.LIBRARY, one line for all names of one.
function(list_installed out prefix)
  file(GLOB_RECURSE files LIST_DIRECTORIES false RELATIVE ${prefix} ${prefix}/*)
  list(TRANSFORM files REPLACE "^lib(64|/[^/]*-linux-[^/]*)?/" "lib/")
  list(TRANSFORM files REPLACE "^lib/(lib[a-z_]+)\\.(a|so[.0-9]*|dylib|[.0-9]+dylib)$"
       "lib/\\1.LIBRARY")
  # Which of these there are depends on the build type and on what is linked statically.
  list(FILTER files EXCLUDE REGEX "^lib/cmake/Regain/(RegainTargets-[a-z]+|Find[A-Za-z]+)\\.cmake$")
  list(REMOVE_DUPLICATES files)
  list(SORT files)
  set(${out} "${files}" PARENT_SCOPE)
endfunction()

# Sets OUT to the part that an installed file belongs to, or to nothing.
function(part_of out file)
  set(${out} "" PARENT_SCOPE)
  if(file MATCHES "^(include/regain/|lib/libregain_)([a-z]+)[/.]")
    set(${out} ${CMAKE_MATCH_2} PARENT_SCOPE)
  elseif(file MATCHES "^share/regain/presets/")
    set(${out} shaders PARENT_SCOPE)
  elseif(file MATCHES "^(bin|share/regain/farm)/")
    set(${out} tools PARENT_SCOPE)
  elseif(file MATCHES "^share/regain/([a-z]+)/")
    set(${out} ${CMAKE_MATCH_1} PARENT_SCOPE)
  endif()
endfunction()

# check_manifest(PREFIX PART...) compares an installed tree with manifest.txt, as far as these parts
# and what belongs to no part go.
function(check_manifest prefix)
  list_installed(found ${prefix})
  file(STRINGS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/manifest.txt lines)
  set(expected "")
  foreach(line IN LISTS lines)
    part_of(part "${line}")
    if(NOT line MATCHES "^#" AND (NOT part OR part IN_LIST ARGN))
      list(APPEND expected "${line}")
    endif()
  endforeach()
  set(message "")
  foreach(file IN LISTS found)
    if(NOT file IN_LIST expected)
      string(APPEND message "  installed, not in the manifest: ${file}\n")
    endif()
  endforeach()
  foreach(file IN LISTS expected)
    if(NOT file IN_LIST found)
      string(APPEND message "  in the manifest, not installed: ${file}\n")
    endif()
  endforeach()
  if(message)
    message(FATAL_ERROR "The installed files are not those of tests/package/manifest.txt.\n${message}"
      "If that is meant, run: cmake --build ${BUILD_DIR} --target update-manifest")
  endif()
endfunction()

# check_parts(PREFIX PART...): an installed tree has files of these parts and of no other.
function(check_parts prefix)
  list_installed(found ${prefix})
  set(parts "")
  foreach(file IN LISTS found)
    part_of(part "${file}")
    if(part AND NOT part IN_LIST ARGN)
      message(FATAL_ERROR "${file} was installed, though ${part} was left out")
    endif()
    list(APPEND parts ${part})
  endforeach()
  foreach(part IN LISTS ARGN)
    if(NOT part IN_LIST parts)
      message(FATAL_ERROR "nothing of ${part} was installed")
    endif()
  endforeach()
endfunction()
