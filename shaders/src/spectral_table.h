// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The measured tables that are compiled in: columns against wavelength, linear in between.

#pragma once

#include <regain/closures/version.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace embedded {

/// The text of a file in shaders/data; empty if there is none of that name.
std::string_view colour_data(std::string_view name);

}  // namespace embedded

namespace shaders::detail {

class SpectralTable
{
public:
    /// Reads an embedded file: lines that start with #, a line with the columns' names, then
    /// numbers separated by commas, the first of each line a wavelength in nm, ascending. Throws
    /// std::logic_error if the file is not like that.
    explicit SpectralTable(std::string_view name);

    /// Column 0, 1, ... after the wavelength; beyond the ends the last value holds.
    double at(std::size_t column, double wavelength) const;

    /// The comment lines without their #.
    const std::string& head() const { return _head; }

private:
    std::string _head;
    std::vector<double> _wavelengths;
    std::vector<std::vector<double>> _columns;
};

}  // namespace shaders::detail
REGAIN_NAMESPACE_END
