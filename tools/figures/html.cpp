// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "html.h"

#include <fmt/format.h>

namespace regain::tools::figures {

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text)
    {
        switch (c)
        {
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '&': out += "&amp;"; break;
            case '"': out += "&quot;"; break;
            default: out += c;
        }
    }
    return out;
}

std::string html_table(const Table& table)
{
    std::string out = fmt::format("<table><caption>{}</caption>\n<tr>", escaped(table.title));
    for (const std::string& column : table.columns)
        out += fmt::format("<th>{}</th>", escaped(column));
    out += "</tr>\n";
    for (const auto& row : table.rows)
    {
        out += "<tr>";
        for (const std::string& cell : row) out += fmt::format("<td>{}</td>", escaped(cell));
        out += "</tr>\n";
    }
    return out + "</table>\n";
}

const char* const page_style = R"(
body { font: 16px/1.5 sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em; }
img { max-width: 100%; display: block; margin: 1em 0; }
table { border-collapse: collapse; margin: 1em 0; font-size: 14px; }
caption { text-align: left; font-weight: bold; padding: .3em 0; }
td, th { border: 1px solid #ccc; padding: .2em .6em; text-align: left; vertical-align: top; }
.agrees { color: #1e7a34; } .differs { color: #b3261e; } .shown { color: #555; }
)";

}  // namespace regain::tools::figures
