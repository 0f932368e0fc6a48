// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a table is made of, whichever of the three ways its nodes are fitted: numbers in rows, each
/// integrated on its own, so that threads, and programs, can share them.

#pragma once

#include "definition.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

struct IntegralRows
{
    std::string name;  // tables whose rows have one name are made of the same numbers
    std::size_t count = 0, length = 0;
    std::size_t across = 1;  // after so many rows come others that cost much the same
    /// Fills a row, which is 0 before. By any number of threads.
    std::function<void(std::size_t row, double* values)> integrate;
};

IntegralRows rows_of(const Definition& definition);

/// The table of all rows, one after the other.
Table table_of(const Definition& definition, const std::vector<double>& integrals);

}  // namespace luts
REGAIN_NAMESPACE_END
