// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Closures from elsewhere, out of a shared object that exports what c_closure.h describes:
///
///     const auto subjects = load_shared_object("./my_closure.so");
///     std::vector<const Subject*> all;
///     for (const auto& s : subjects) all.push_back(s.get());
///     Report report = run(all);

#pragma once

#include <regain/conformance/subject.h>

#include <filesystem>
#include <memory>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// The subjects of a shared object, in its order; at least one. The object stays open as long as
/// one of them, or a closure that one of them made, lives. Where one names another as `bare` or
/// `reference`, keep both.
///
/// A closure that create() refuses to make is one whose every answer is NaN, which checks reject.
///
/// Throws std::runtime_error that names the file and says what is wrong: there is no such file, it
/// is no shared object, exports no subjects, or was written for a version of the interface that
/// this kit does not know; or a subject lacks a function, has no usable name or that of another.
REGAIN_CONFORMANCE_API std::vector<std::unique_ptr<Subject>> load_shared_object(
    const std::filesystem::path& file);

}  // namespace conformance
REGAIN_NAMESPACE_END
