# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Finds xsimd by its headers and defines the target xsimd.
#
# Why not its own CMake package: the one Debian ships makes everything link a library called xtl,
# which is a header-only project and does not exist as a library.

find_path(xsimd_INCLUDE_DIR xsimd/xsimd.hpp)
mark_as_advanced(xsimd_INCLUDE_DIR)

if(xsimd_INCLUDE_DIR)
  set(xsimd_VERSION "")
  foreach(_part MAJOR MINOR PATCH)
    file(STRINGS ${xsimd_INCLUDE_DIR}/xsimd/config/xsimd_config.hpp _line
         REGEX "^#define XSIMD_VERSION_${_part} +[0-9]+")
    string(REGEX MATCH "[0-9]+" _number "${_line}")
    string(APPEND xsimd_VERSION ".${_number}")
  endforeach()
  string(SUBSTRING "${xsimd_VERSION}" 1 -1 xsimd_VERSION)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(xsimd
  REQUIRED_VARS xsimd_INCLUDE_DIR
  VERSION_VAR xsimd_VERSION
  HANDLE_VERSION_RANGE
  REASON_FAILURE_MESSAGE
    "Install it (Debian, Ubuntu: libxsimd-dev) or set xsimd_ROOT to the folder it is installed in.")

if(xsimd_FOUND AND NOT TARGET xsimd)
  add_library(xsimd INTERFACE IMPORTED)
  set_target_properties(xsimd PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${xsimd_INCLUDE_DIR}")
endif()
