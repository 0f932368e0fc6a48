# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# The README's example of linking Regain is built against an installed tree and run. Its files are
# the code blocks that follow a line `<!-- file: NAME -->`.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

file(READ ${SOURCE_DIR}/README.md text)
set(files "")
while(text MATCHES "<!-- file: ([A-Za-z.]+) -->[ \n]*```[a-z]*\n")
  set(name ${CMAKE_MATCH_1})
  string(FIND "${text}" "${CMAKE_MATCH_0}" at)
  string(LENGTH "${CMAKE_MATCH_0}" length)
  math(EXPR at "${at} + ${length}")
  string(SUBSTRING "${text}" ${at} -1 text)
  string(FIND "${text}" "\n```" end)
  string(SUBSTRING "${text}" 0 ${end} block)
  file(WRITE ${SCRATCH}/source/${name} "${block}\n")
  list(APPEND files ${name})
endwhile()
foreach(name CMakeLists.txt main.cpp)
  if(NOT name IN_LIST files)
    message(FATAL_ERROR "README.md has no code block after a line <!-- file: ${name} -->")
  endif()
endforeach()

configure_and_build(${SCRATCH}/source ${SCRATCH}/build -DCMAKE_PREFIX_PATH=${INSTALLED})
run(${SCRATCH}/build/example)
message("${output}")
