# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# The files that `cmake --install` puts down are exactly those of manifest.txt: a header that was
# forgotten, or a private one that slipped in, is found here and not by users. With UPDATE set, the
# manifest is written anew; this takes a build with all parts.

include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

if(UPDATE)
  if(NOT LUTS OR NOT SHADERS OR NOT ADAPTERS OR NOT TOOLS)
    message(FATAL_ERROR "The manifest is that of a full build, and this build leaves parts out.")
  endif()
  install(${BUILD_DIR} ${SCRATCH}/prefix)
  list_installed(files ${SCRATCH}/prefix)
  list(JOIN files "\n" text)
  file(WRITE ${CMAKE_CURRENT_LIST_DIR}/manifest.txt
    "# SPDX-License-Identifier: Apache-2.0\n"
    "# Copyright Contributors to the Regain project\n"
    "# What a full build installs. Written by the build target update-manifest.\n"
    "${text}\n")
  return()
endif()

separate_arguments(PARTS)
if(TOOLS)
  list(APPEND PARTS tools)
endif()
check_manifest(${INSTALLED} ${PARTS})
