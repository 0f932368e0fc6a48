// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "spectral_table.h"

#include <algorithm>
#include <iterator>
#include <locale>
#include <sstream>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace shaders::detail {

SpectralTable::SpectralTable(std::string_view name)
{
    const auto fail = [&](const std::string& why) {
        throw std::logic_error("compiled-in table '" + std::string(name) + "': " + why);
    };

    std::istringstream lines{std::string(embedded::colour_data(name))};
    bool named = false;
    for (std::string line; std::getline(lines, line);)
    {
        if (line.empty()) continue;
        if (line[0] == '#')
        {
            if (!_head.empty()) _head += '\n';
            _head += line.substr(std::min(line.find_first_not_of("# "), line.size()));
            continue;
        }
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream fields(line);
        if (!named)
        {
            const auto names = std::distance(std::istream_iterator<std::string>(fields), {});
            if (names < 2) fail("no columns");
            _columns.resize(static_cast<std::size_t>(names) - 1);
            named = true;
            continue;
        }
        // The host program's locale may write numbers with commas.
        fields.imbue(std::locale::classic());
        double wavelength = 0;
        fields >> wavelength;
        for (auto& column : _columns) fields >> column.emplace_back();
        if (!fields) fail("'" + line + "' is short of numbers");
        if (!_wavelengths.empty() && !(wavelength > _wavelengths.back())) fail("not ascending");
        _wavelengths.push_back(wavelength);
    }
    if (_wavelengths.empty()) fail("no values");
}

double SpectralTable::at(std::size_t column, double wavelength) const
{
    const auto& values = _columns.at(column);
    const auto above = std::upper_bound(_wavelengths.begin(), _wavelengths.end(), wavelength);
    if (above == _wavelengths.begin()) return values.front();
    if (above == _wavelengths.end()) return values.back();
    const auto i = static_cast<std::size_t>(above - _wavelengths.begin());
    const double t = (wavelength - _wavelengths[i - 1]) / (_wavelengths[i] - _wavelengths[i - 1]);
    return values[i - 1] + t * (values[i] - values[i - 1]);
}

}  // namespace shaders::detail
REGAIN_NAMESPACE_END
