# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# The CMake package Regain: find_package(Regain), targets Regain::PART.

include(CMakePackageConfigHelpers)

# Sets OUT to what those who use TARGET link with it: what it links publicly and, if it is a static
# library, privately too. What holds in the build tree only is left out.
function(_regain_links out target)
  get_target_property(links ${target} INTERFACE_LINK_LIBRARIES)
  set(names "")
  foreach(link IN LISTS links)
    if(link AND NOT link MATCHES "BUILD_INTERFACE")
      string(REGEX REPLACE "\\$<[A-Z_]+:([^<>]*)>" "\\1" link "${link}")
      list(APPEND names "${link}")
    endif()
  endforeach()
  set(${out} "${names}" PARENT_SCOPE)
endfunction()

# The package file must look for what the parts link. That is read off the targets, so that it
# cannot fall behind them. A target NAMESPACE::name belongs to the package NAMESPACE.
get_property(REGAIN_PARTS GLOBAL PROPERTY REGAIN_PARTS)
set(REGAIN_NEEDS "")
set(_modules "")
foreach(_part IN LISTS REGAIN_PARTS)
  _regain_links(_links regain_${_part})
  set(_parts "")
  set(_packages "")
  foreach(_link IN LISTS _links)
    if(_link MATCHES "^Regain::(.+)$")
      list(APPEND _parts ${CMAKE_MATCH_1})
    elseif(_link MATCHES "^(.+)::")
      list(APPEND _packages ${CMAKE_MATCH_1})
    elseif(_link STREQUAL "xsimd")
      list(APPEND _packages xsimd)
    elseif(_link MATCHES "^regain_")
      message(FATAL_ERROR "regain_${_part} links ${_link}, which is not installed")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES _parts)
  list(REMOVE_DUPLICATES _packages)
  string(APPEND REGAIN_NEEDS
    "set(_regain_parts_of_${_part} \"${_parts}\")\n"
    "set(_regain_packages_of_${_part} \"${_packages}\")\n")
  foreach(_package IN LISTS _packages)
    set(_module ${CMAKE_CURRENT_SOURCE_DIR}/cmake/Find${_package}.cmake)
    if(EXISTS ${_module})
      list(APPEND _modules ${_module})
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES _modules)

set(_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Regain)
configure_package_config_file(
  ${CMAKE_CURRENT_SOURCE_DIR}/cmake/RegainConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/cmake/RegainConfig.cmake
  INSTALL_DESTINATION ${_package_dir}
  NO_SET_AND_CHECK_MACRO)
# Before 1.0 every minor release may break what is built against it.
write_basic_package_version_file(
  ${CMAKE_CURRENT_BINARY_DIR}/cmake/RegainConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)

install(EXPORT RegainTargets NAMESPACE Regain:: DESTINATION ${_package_dir})
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/cmake/RegainConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/cmake/RegainConfigVersion.cmake
  ${_modules}
  DESTINATION ${_package_dir})
install(FILES LICENSE README.md CHANGES.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
