// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Baking that several programs share. What takes time is integrals, in rows that are independent
/// of each other; the table of all is quickly made:
///
///     TableIntegrals integrals("ggx_E_ss");
///     some = integrals.integrate({0, 7, 14});                // one program's rows
///     table = bake("ggx_E_ss", all);                         // of every row, one after the other
///
/// It is the table that bake makes alone, bit for bit, by the same program on the same processor.

#pragma once

#include <regain/luts/bake.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

struct IntegralRows;

/// What a table is made of.
class REGAIN_LUTS_API TableIntegrals
{
public:
    /// Throws as require_bakeable does.
    explicit TableIntegrals(const std::string& table);

    /// The same for tables that are made of the same numbers.
    const std::string& name() const;

    std::size_t rows() const;
    std::size_t length() const;  ///< of a row, in numbers
    /// Rows that differ most in what they cost lie next to each other, so many of them, again and
    /// again.
    std::size_t across() const;

    /// These rows, one after the other, on all cores. Throws std::invalid_argument where there is
    /// no such row, and as bake does.
    std::vector<double> integrate(const std::vector<std::size_t>& rows,
                                  const BakeProgress& progress = {}) const;

private:
    std::shared_ptr<const IntegralRows> _rows;
};

/// The table of all its integrals. Throws std::invalid_argument where their number is another.
REGAIN_LUTS_API Table bake(const std::string& name, const std::vector<double>& integrals);

}  // namespace luts
REGAIN_NAMESPACE_END
