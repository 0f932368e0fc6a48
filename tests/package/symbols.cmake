# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Whatever the static LIBRARIES define for the linker is in this library's versioned namespace; weak
# symbols may be instances of other people's templates, which every object file that needs them
# brings along. NM is the program that lists symbols.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

# Sets OUT to the symbols of a library that are outside, and COUNT to how many it defines.
function(symbols_outside out count library)
  run(${NM} --extern-only --defined-only --format=posix ${library})
  string(REGEX MATCHALL "[^\n]+" lines "${output}")
  set(outside "")
  set(defined 0)
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^([^ ]+) ([A-Za-z]) ")
      continue()
    endif()
    set(name ${CMAKE_MATCH_1})
    set(type ${CMAKE_MATCH_2})
    math(EXPR defined "${defined} + 1")
    # W, V and u are weak. Mangled names say the namespace by lengths and names, "6regain4v0_1".
    if(NOT type MATCHES "^[WVu]$" AND NOT name MATCHES "^_Z.*6regain[0-9]+v[0-9]")
      list(APPEND outside ${name})
    endif()
  endforeach()
  set(${out} "${outside}" PARENT_SCOPE)
  set(${count} ${defined} PARENT_SCOPE)
endfunction()

foreach(library IN LISTS LIBRARIES)
  symbols_outside(outside count ${library})
  if(outside)
    message(FATAL_ERROR "${library} defines outside its namespace: ${outside}")
  endif()
  if(count LESS 10)
    message(FATAL_ERROR "${library} defines ${count} symbols: are they looked at?")
  endif()
  message("${library}: ${count} symbols")
endforeach()

# And one that is outside would be seen.
file(WRITE ${SCRATCH}/leak.cpp "int leaked() { return 0; }\nnamespace regain { int unversioned; }\n")
run(${CXX} -c ${SCRATCH}/leak.cpp -o ${SCRATCH}/leak.o)
symbols_outside(outside count ${SCRATCH}/leak.o)
if(NOT outside STREQUAL "_Z6leakedv;_ZN6regain11unversionedE")
  message(FATAL_ERROR "a symbol outside was not seen: ${outside}")
endif()
