// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "svg_parts.h"

#include "html.h"

#include <fmt/format.h>

namespace regain::tools::figures {

using Imath::V2d;

std::string svg_text(double x, double y, const std::string& anchor, const std::string& words)
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y,
                       anchor, escaped(words));
}

std::string svg_line(const V2d& a, const V2d& b, const std::string& style)
{
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", a.x,
                       a.y, b.x, b.y, style);
}

std::string svg_document(double width, double height, const std::string& body)
{
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" {2}>\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"white\"/>\n{3}</svg>\n",
        width, height, "font-family=\"sans-serif\" font-size=\"13\"", body);
}

}  // namespace regain::tools::figures
