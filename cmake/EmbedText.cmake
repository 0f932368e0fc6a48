# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Text files compiled into a library, so that it needs no file at run time.
#
# regain_embed_text(TARGET FUNCTION file ...) adds to TARGET a source that defines
#     std::string_view FUNCTION(std::string_view name)
# in namespace regain::embedded: the text of the file of that name (without its folder), or an empty
# view. The source is written at build time by this same file, run as a script.

if(CMAKE_SCRIPT_MODE_FILE)
  set(body "")
  foreach(file IN LISTS FILES)
    get_filename_component(name "${file}" NAME)
    file(READ "${file}" text)
    string(LENGTH "${text}" length)
    if(length LESS 65000)
      string(APPEND body "    if (name == \"${name}\")\n        return R\"regain(${text})regain\";\n")
      continue()
    endif()
    # Compilers need not accept a longer string.
    file(READ "${file}" bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    string(REGEX REPLACE "(0x0a,)" "\\1\n" bytes "${bytes}")
    string(APPEND body
      "    if (name == \"${name}\")\n    {\n        static constexpr char text[] = {\n${bytes}};\n"
      "        return {text, sizeof text};\n    }\n")
  endforeach()
  file(WRITE "${OUTPUT}"
    "// Written by cmake/EmbedText.cmake.\n\n"
    "#include <regain/closures/version.h>\n\n#include <string_view>\n\n"
    "REGAIN_NAMESPACE_BEGIN\nnamespace embedded {\n\n"
    "std::string_view ${FUNCTION}(std::string_view name);\n"
    "std::string_view ${FUNCTION}([[maybe_unused]] std::string_view name)\n{\n"
    "${body}    return {};\n}\n\n"
    "}  // namespace embedded\nREGAIN_NAMESPACE_END\n")
  return()
endif()

set(REGAIN_EMBED_TEXT_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(regain_embed_text target function)
  set(files "")
  foreach(file IN LISTS ARGN)
    get_filename_component(file "${file}" ABSOLUTE)
    list(APPEND files "${file}")
  endforeach()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DFILES=${files}" -DFUNCTION=${function} -DOUTPUT=${output}
            -P ${REGAIN_EMBED_TEXT_SCRIPT}
    DEPENDS ${files} ${REGAIN_EMBED_TEXT_SCRIPT}
    COMMENT "Embedding ${function}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
