# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# The example of docs/conformance-kit.md is the one that lies beside it; both its forms are built
# against an installed tree and pass the kit; with a wrong pdf both fail, and the command that the
# failure prints fails again.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(example ${SOURCE_DIR}/docs/conformance/example)
file(READ ${SOURCE_DIR}/docs/conformance-kit.md guide)
foreach(name phong.h shared.c linked.cpp CMakeLists.txt)
  file(READ ${example}/${name} text)
  string(REGEX MATCH "<!-- file: ${name} -->\n```[a-z]*\n" start "${guide}")
  string(FIND "${guide}" "${start}${text}```\n" at)
  if(start STREQUAL "" OR at EQUAL -1)
    message(FATAL_ERROR "docs/conformance-kit.md does not show docs/conformance/example/${name} as "
      "it is, after a line <!-- file: ${name} -->")
  endif()
endforeach()

# expect(CODE COMMAND...): runs it; sets `output`.
function(expect code)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE said ERROR_VARIABLE progress RESULT_VARIABLE got)
  if(NOT got EQUAL code)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "exit code ${got}, not ${code}: ${command}\n${said}${progress}")
  endif()
  set(output "${said}" PARENT_SCOPE)
endfunction()

# What a failure says in its last line.
function(expect_reproduction first_word)
  if(NOT output MATCHES "\n    (${first_word} [^\n]*--setting [^\n]*)\n")
    message(FATAL_ERROR "no command to reproduce a failure:\n${output}")
  endif()
  expect(1 sh -c "${CMAKE_MATCH_1}")
endfunction()

set(ENV{PATH} "${INSTALLED}/bin:$ENV{PATH}")
configure_and_build(${example} ${SCRATCH}/right -DCMAKE_PREFIX_PATH=${INSTALLED})
expect(0 ${SCRATCH}/right/phong_linked)
message("${output}")
if(TOOLS)
  expect(0 regain conform ${SCRATCH}/right/libphong_shared.so)
  message("${output}")
endif()

# One check is enough; each failure takes a second look.
set(wrong -DPHONG_PDF_FACTOR=1.1)
set(CXX_FLAGS "${CXX_FLAGS} ${wrong}")
configure_and_build(${example} ${SCRATCH}/wrong -DCMAKE_PREFIX_PATH=${INSTALLED}
  -DCMAKE_C_FLAGS=${wrong})
expect(1 ${SCRATCH}/wrong/phong_linked --check C4)
expect_reproduction("[^\n ]*phong_linked")
if(TOOLS)
  expect(1 regain conform ${SCRATCH}/wrong/libphong_shared.so --check C4)
  expect_reproduction("regain conform")
endif()
