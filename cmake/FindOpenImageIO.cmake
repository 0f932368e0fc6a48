# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Finds OpenImageIO by its header and libraries and defines OpenImageIO::OpenImageIO.
#
# Why not its own CMake package: Debian splits OpenImageIO, and the package file in
# libopenimageio-dev stops with an error unless the programs of openimageio-tools, and Qt with
# them, are installed too. No program is needed here.

find_path(OpenImageIO_INCLUDE_DIR OpenImageIO/oiioversion.h)
find_library(OpenImageIO_LIBRARY OpenImageIO)
find_library(OpenImageIO_Util_LIBRARY OpenImageIO_Util)
mark_as_advanced(OpenImageIO_INCLUDE_DIR OpenImageIO_LIBRARY OpenImageIO_Util_LIBRARY)

if(OpenImageIO_INCLUDE_DIR)
  set(OpenImageIO_VERSION "")
  foreach(_part MAJOR MINOR PATCH)
    file(STRINGS ${OpenImageIO_INCLUDE_DIR}/OpenImageIO/oiioversion.h _line
         REGEX "^#define OIIO_VERSION_${_part} +[0-9]+")
    string(REGEX MATCH "[0-9]+" _number "${_line}")
    string(APPEND OpenImageIO_VERSION ".${_number}")
  endforeach()
  string(SUBSTRING "${OpenImageIO_VERSION}" 1 -1 OpenImageIO_VERSION)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO
  REQUIRED_VARS OpenImageIO_LIBRARY OpenImageIO_Util_LIBRARY OpenImageIO_INCLUDE_DIR
  VERSION_VAR OpenImageIO_VERSION
  HANDLE_VERSION_RANGE
  REASON_FAILURE_MESSAGE
    "Install it (Debian, Ubuntu: libopenimageio-dev) or set OpenImageIO_ROOT to the folder it is installed in.")

if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
  # Its public headers include Imath's.
  find_package(Imath 3.1 CONFIG REQUIRED)
  add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    IMPORTED_LOCATION "${OpenImageIO_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenImageIO_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${OpenImageIO_Util_LIBRARY};Imath::Imath")
endif()
