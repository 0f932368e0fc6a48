// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "figure.h"

#include <regain/luts/replace_file.h>

#include <fstream>
#include <stdexcept>

namespace regain::tools::figures {

const std::vector<Maker>& makers()
{
    static const std::vector<Maker> all = {
        {"1", "rough gold without and with compensation", make_figure1},
        {"2", "white furnace rows of four distributions", make_figure2},
        {"3", "Burley's sheen from 0 to 1", make_figure3},
        {"4", "lobes of the first, second and later bounces", make_figure4},
        {"5", "E_ss of the microfacet models, as tables", make_figure5},
        {"6", "rough gold: nothing, energy alone, energy and colour", make_figure6},
        {"7", "F_ms over F_ss, and the depth of the random walk", make_figure7},
        {"8", "rough glass without and with compensation", make_figure8},
        {"9", "no compensation, ours, random walk; metal and glass", make_figure9},
        {"table1", "every method: errors, shape, reciprocity, noise, time, tables", make_table1},
    };
    return all;
}

Figure titled(std::string name, std::string title)
{
    Figure figure;
    figure.name = std::move(name);
    figure.title = std::move(title);
    return figure;
}

Finding tested(std::string claim, std::string measured, bool holds)
{
    return {std::move(claim), std::move(measured), holds ? Verdict::agrees : Verdict::differs};
}

Finding shown(std::string claim, std::string measured)
{
    return {std::move(claim), std::move(measured), Verdict::shown};
}

void write_text(const std::filesystem::path& file, const std::string& text)
{
    luts::replace_file(file, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << text;
        out.close();
        if (!out) throw std::runtime_error("cannot write '" + file.string() + "'");
    });
}

}  // namespace regain::tools::figures
