# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Finds OpenImageIO 2.3 or later, as the target OpenImageIO::OpenImageIO.

# Its CMake files stop the configuration if the command-line tools are not there, and Debian has
# those in another package (openimageio-tools). Nothing here needs them, so without them the library
# is looked for by hand.
find_program(REGAIN_OPENIMAGEIO_TOOL iconvert)
mark_as_advanced(REGAIN_OPENIMAGEIO_TOOL)
if(REGAIN_OPENIMAGEIO_TOOL OR OpenImageIO_DIR)
  find_package(OpenImageIO 2.3 CONFIG REQUIRED)
elseif(NOT TARGET OpenImageIO::OpenImageIO)
  find_package(Imath 3.1 CONFIG REQUIRED)
  find_path(REGAIN_OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h)
  find_library(REGAIN_OPENIMAGEIO_LIBRARY OpenImageIO)
  find_library(REGAIN_OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util)
  mark_as_advanced(REGAIN_OPENIMAGEIO_INCLUDE_DIR REGAIN_OPENIMAGEIO_LIBRARY
                   REGAIN_OPENIMAGEIO_UTIL_LIBRARY)
  if(NOT REGAIN_OPENIMAGEIO_INCLUDE_DIR OR NOT REGAIN_OPENIMAGEIO_LIBRARY OR
     NOT REGAIN_OPENIMAGEIO_UTIL_LIBRARY)
    message(FATAL_ERROR "OpenImageIO 2.3 or later is needed, and was not found. Install it "
      "(Debian, Ubuntu: libopenimageio-dev) or set OpenImageIO_DIR to the folder of its "
      "OpenImageIOConfig.cmake.")
  endif()
  file(STRINGS ${REGAIN_OPENIMAGEIO_INCLUDE_DIR}/OpenImageIO/oiioversion.h _regain_oiio_version
       REGEX "#define OIIO_VERSION_(MAJOR|MINOR) ")
  string(REGEX REPLACE "[^0-9;]+" "" _regain_oiio_version "${_regain_oiio_version}")
  string(REPLACE ";" "." _regain_oiio_version "${_regain_oiio_version}")
  if(_regain_oiio_version VERSION_LESS 2.3)
    message(FATAL_ERROR "OpenImageIO 2.3 or later is needed; ${REGAIN_OPENIMAGEIO_LIBRARY} has "
      "version ${_regain_oiio_version}.")
  endif()
  unset(_regain_oiio_version)
  add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    IMPORTED_LOCATION "${REGAIN_OPENIMAGEIO_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${REGAIN_OPENIMAGEIO_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${REGAIN_OPENIMAGEIO_UTIL_LIBRARY};Imath::Imath")
endif()
