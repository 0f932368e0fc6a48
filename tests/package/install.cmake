# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Installs the build under test for the tests that look at what was installed, and moves it: nothing
# in the package may point back to where it was put first, nor to the build.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

install(${BUILD_DIR} ${SCRATCH}/prefix)
file(REMOVE_RECURSE ${INSTALLED})
file(RENAME ${SCRATCH}/prefix ${INSTALLED})

file(GLOB_RECURSE files ${INSTALLED}/*.cmake)
foreach(file IN LISTS files)
  file(STRINGS ${file} lines)
  foreach(line IN LISTS lines)
    foreach(folder ${SOURCE_DIR} ${BUILD_DIR})
      string(FIND "${line}" "${folder}/" at)
      if(NOT at EQUAL -1)
        message(FATAL_ERROR "${file} points to ${folder}: ${line}")
      endif()
    endforeach()
  endforeach()
endforeach()
