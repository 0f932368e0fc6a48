# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Every source file says in its first lines under which licence it may be used, and whose it is.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(patterns .ci/run regain)
foreach(folder cmake closures shaders adapters luts tests tools bench docs)
  foreach(kind *.h *.c *.cpp *.cu *.cmake *.cmake.in CMakeLists.txt *.sh *.slurm *.py *.mtlx)
    list(APPEND patterns ${folder}/${kind})
  endforeach()
endforeach()
list(TRANSFORM patterns PREPEND ${SOURCE_DIR}/)
file(GLOB_RECURSE files ${patterns} ${SOURCE_DIR}/CMakeLists.txt)
list(FILTER files EXCLUDE REGEX "^${SOURCE_DIR}/build")
list(LENGTH files count)
if(count LESS 20)
  message(FATAL_ERROR "only ${count} files were looked at")
endif()

set(without "")
foreach(file IN LISTS files)
  file(READ ${file} text LIMIT 400)
  if(NOT text MATCHES "SPDX-License-Identifier: Apache-2\\.0" OR
     NOT text MATCHES "Copyright Contributors to the Regain project")
    string(APPEND without "  ${file}\n")
  endif()
endforeach()
if(without)
  message(FATAL_ERROR "These files do not begin with the licence and copyright lines:\n${without}")
endif()
message("${count} files")
