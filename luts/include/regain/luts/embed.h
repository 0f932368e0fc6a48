// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A table as C++ text, for compiling it in.

#pragma once

#include <regain/luts/table.h>

#include <string>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// The definition of an array and of a `constexpr TableView` with the table's name.
REGAIN_LUTS_API std::string embedded(const Table& table);

}  // namespace luts
REGAIN_NAMESPACE_END
