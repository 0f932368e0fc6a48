// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Files appear whole or not at all: they are written under a temporary name beside the target,
/// then renamed over it.

#pragma once

#include <regain/closures/version.h>
#include <regain/luts/export.h>

#include <filesystem>
#include <functional>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Throws std::runtime_error that names the target and says why, if replace_file could not write it
/// now. It creates and removes an empty file beside the target: permissions alone do not tell,
/// since a superuser has them all and some folders take no files from anybody.
REGAIN_LUTS_API void require_replaceable(const std::filesystem::path& target);

/// Calls `write` with a temporary path in the target's folder (same extension, so writers that go
/// by it work), then renames that file to `target`. If `write` throws or leaves no file, the
/// temporary is removed, an existing target stays as it was, and the exception goes on. Throws
/// std::runtime_error that names the target when the folder is missing or not writable.
REGAIN_LUTS_API void replace_file(const std::filesystem::path& target,
                                  const std::function<void(const std::filesystem::path&)>& write);

}  // namespace luts
REGAIN_NAMESPACE_END
