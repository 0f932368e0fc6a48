# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# How every library of the project is declared: alias and export name Regain::NAME, C++17, hidden
# visibility, headers in include/regain/NAME, the project's warnings.

add_library(regain_warnings INTERFACE)
target_compile_options(regain_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow
  $<$<BOOL:${REGAIN_WARNINGS_AS_ERRORS}>:-Werror>)

# regain_library(NAME [INTERFACE] [SOURCES file ...] [LINK target ...] [PRIVATE_LINK target ...])
function(regain_library name)
  cmake_parse_arguments(arg "INTERFACE" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  set(target regain_${name})
  if(arg_INTERFACE)
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  else()
    add_library(${target} ${arg_SOURCES})
    set(scope PUBLIC)
    set_target_properties(${target} PROPERTIES
      CXX_VISIBILITY_PRESET hidden
      VISIBILITY_INLINES_HIDDEN ON
      POSITION_INDEPENDENT_CODE ON
      VERSION ${PROJECT_VERSION}
      # Before 1.0 every minor release may break the ABI.
      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:regain_warnings> ${arg_PRIVATE_LINK})
    if(name STREQUAL "luts")
      target_compile_options(${target} PRIVATE -Wconversion)
    endif()
  endif()
  add_library(Regain::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} OUTPUT_NAME regain_${name})
  target_compile_features(${target} ${scope} cxx_std_17)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} ${scope} ${arg_LINK})
  set_property(GLOBAL APPEND PROPERTY REGAIN_PARTS ${name})
  if(REGAIN_INSTALL)
    install(TARGETS ${target} EXPORT RegainTargets
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
      RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    install(DIRECTORY include/regain DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endif()
endfunction()
