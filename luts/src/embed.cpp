// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/embed.h>

#include <sstream>

REGAIN_NAMESPACE_BEGIN
namespace luts {

std::string embedded(const Table& table)
{
    std::ostringstream out;
    out << "// " << table.name() << ", definition " << table.info().definition << ": "
        << table.info().method << ".\n";
    out << "constexpr std::uint16_t " << table.name() << "_data[] = {\n";
    for (std::size_t i = 0; i < table.stored().size(); ++i)
        out << table.stored()[i]
            << ((i + 1) % 16 == 0 || i + 1 == table.stored().size() ? ",\n" : ",");
    out << "};\n";
    out.precision(9);
    out << "constexpr TableView " << table.name() << " = {" << table.name() << "_data, "
        << table.width() << ", " << table.height() << ", " << table.depth()
        << ", static_cast<float>(" << table.info().offset << "), static_cast<float>("
        << table.info().scale << ")};\n";
    return out.str();
}

}  // namespace luts
REGAIN_NAMESPACE_END
