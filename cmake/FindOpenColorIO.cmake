# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Finds OpenColorIO by its header and library and defines OpenColorIO::OpenColorIO.
#
# Why not its own CMake package: Debian installs that to share/cmake itself, where find_package
# does not look, and the include folder it names does not exist.

find_path(OpenColorIO_INCLUDE_DIR OpenColorIO/OpenColorABI.h)
find_library(OpenColorIO_LIBRARY OpenColorIO)
mark_as_advanced(OpenColorIO_INCLUDE_DIR OpenColorIO_LIBRARY)

if(OpenColorIO_INCLUDE_DIR)
  file(STRINGS ${OpenColorIO_INCLUDE_DIR}/OpenColorIO/OpenColorABI.h _line
       REGEX "^#define OCIO_VERSION +\"")
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" OpenColorIO_VERSION "${_line}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenColorIO
  REQUIRED_VARS OpenColorIO_LIBRARY OpenColorIO_INCLUDE_DIR
  VERSION_VAR OpenColorIO_VERSION
  HANDLE_VERSION_RANGE
  REASON_FAILURE_MESSAGE
    "Install it (Debian, Ubuntu: libopencolorio-dev) or set OpenColorIO_ROOT to the folder it is installed in.")

if(OpenColorIO_FOUND AND NOT TARGET OpenColorIO::OpenColorIO)
  add_library(OpenColorIO::OpenColorIO UNKNOWN IMPORTED)
  set_target_properties(OpenColorIO::OpenColorIO PROPERTIES
    IMPORTED_LOCATION "${OpenColorIO_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenColorIO_INCLUDE_DIR}")
endif()
