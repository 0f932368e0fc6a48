# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Finds OpenColorIO 2.1 or later, as the target OpenColorIO::OpenColorIO.

# Debian's package keeps its CMake files in share/cmake itself, where find_package does not look.
find_package(OpenColorIO CONFIG PATH_SUFFIXES share/cmake)
if(NOT OpenColorIO_FOUND)
  message(FATAL_ERROR "OpenColorIO 2.1 or later is needed, and was not found. "
    "Install it (Debian, Ubuntu: libopencolorio-dev) or set OpenColorIO_DIR to the folder of its "
    "OpenColorIOConfig.cmake.")
endif()
# Its version file calls every minor release incompatible, so the version is checked here.
if(OpenColorIO_VERSION VERSION_LESS 2.1 OR OpenColorIO_VERSION VERSION_GREATER_EQUAL 3)
  message(FATAL_ERROR "OpenColorIO 2.1 or later is needed; ${OpenColorIO_DIR} has version "
    "${OpenColorIO_VERSION}.")
endif()

# The files of that package count the folders up to the prefix as if they lay one deeper, and name
# an include folder that does not exist.
get_target_property(_regain_ocio_include OpenColorIO::OpenColorIO INTERFACE_INCLUDE_DIRECTORIES)
if(NOT EXISTS "${_regain_ocio_include}/OpenColorIO/OpenColorIO.h")
  find_path(REGAIN_OPENCOLORIO_INCLUDE_DIR OpenColorIO/OpenColorIO.h
    HINTS "${OpenColorIO_DIR}/../../include")
  mark_as_advanced(REGAIN_OPENCOLORIO_INCLUDE_DIR)
  if(NOT REGAIN_OPENCOLORIO_INCLUDE_DIR)
    message(FATAL_ERROR "OpenColorIO's CMake files are in ${OpenColorIO_DIR}, but its headers were "
      "not found. Set REGAIN_OPENCOLORIO_INCLUDE_DIR to the folder that has "
      "OpenColorIO/OpenColorIO.h.")
  endif()
  set_target_properties(OpenColorIO::OpenColorIO PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${REGAIN_OPENCOLORIO_INCLUDE_DIR}")
endif()
unset(_regain_ocio_include)
