// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "page.h"

#include "html.h"

#include <fmt/format.h>

#include <algorithm>

namespace regain::tools::figures {
namespace {

const char* word(Verdict verdict)
{
    switch (verdict)
    {
        case Verdict::agrees: return "agrees";
        case Verdict::differs: return "differs";
        case Verdict::shown: break;
    }
    return "shown";
}

std::string heading(const Figure& figure)
{
    const bool is_table = figure.name.rfind("table", 0) == 0;
    return (is_table ? "Table " + figure.name.substr(5) : "Figure " + figure.name) + ": " +
           figure.title;
}

}  // namespace

std::string html_page(const std::vector<Figure>& figures)
{
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>The figures of "
        "Turquin 2019, by Regain</title>\n<style>{}</style></head><body>\n<h1>The figures of "
        "Turquin 2019, by Regain</h1>\n<p>Emmanuel Turquin, \"Practical multiple scattering "
        "compensation for microfacet models\", 2019. Beside each figure: what the paper says, and "
        "what was measured here.</p>\n",
        page_style);
    for (const Figure& figure : figures)
    {
        out +=
            fmt::format("<h2 id=\"{}\">{}</h2>\n", escaped(figure.name), escaped(heading(figure)));
        for (const auto& picture : figure.pictures)
            out += fmt::format("<img src=\"{0}\" alt=\"{1}\">\n",
                               escaped(picture.filename().string()), escaped(heading(figure)));
        if (!figure.findings.empty())
        {
            out += "<table><tr><th>the paper</th><th>here</th><th></th></tr>\n";
            for (const Finding& f : figure.findings)
                out += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"{}\">{}</td></tr>\n",
                                   escaped(f.claim), escaped(f.measured), word(f.verdict),
                                   word(f.verdict));
            out += "</table>\n";
        }
        for (const Table& table : figure.tables) out += html_table(table);
    }
    return out + "</body></html>\n";
}

nlohmann::ordered_json as_json(const Figure& figure)
{
    nlohmann::ordered_json json;
    json["name"] = figure.name;
    json["title"] = figure.title;
    json["pictures"] = nlohmann::ordered_json::array();
    for (const auto& picture : figure.pictures) json["pictures"].push_back(picture.string());
    json["findings"] = nlohmann::ordered_json::array();
    for (const Finding& f : figure.findings)
        json["findings"].push_back(
            {{"paper", f.claim}, {"measured", f.measured}, {"verdict", word(f.verdict)}});
    json["numbers"] = figure.numbers;
    return json;
}

std::string as_text(const Figure& figure)
{
    std::string out = heading(figure) + "\n";
    for (const auto& picture : figure.pictures) out += fmt::format("  {}\n", picture.string());
    for (const Finding& f : figure.findings)
        out += fmt::format("  {:8}paper: {}\n          here: {}\n", word(f.verdict), f.claim,
                           f.measured);
    for (const Table& table : figure.tables)
    {
        std::vector<std::size_t> widths;
        for (const std::string& column : table.columns) widths.push_back(column.size());
        for (const auto& row : table.rows)
            for (std::size_t i = 0; i < row.size(); ++i)
                widths[i] = std::max(widths[i], row[i].size());
        const auto line = [&](const std::vector<std::string>& cells) {
            std::string text = " ";
            for (std::size_t i = 0; i < cells.size(); ++i)
                text += fmt::format(" {:<{}} ", cells[i], widths[i]);
            text.erase(text.find_last_not_of(' ') + 1);
            return text + "\n";
        };
        out += "  " + table.title + "\n" + line(table.columns);
        for (const auto& row : table.rows) out += line(row);
    }
    return out;
}

}  // namespace regain::tools::figures
