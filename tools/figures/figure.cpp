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
        {"5", "E_ss of the microfacet models, as tables", make_figure5},
        {"7", "F_ms over F_ss, and the depth of the random walk", make_figure7},
        {"table1", "every method: errors, shape, reciprocity, noise, time, tables", make_table1},
    };
    return all;
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
