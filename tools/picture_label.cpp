// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "picture_label.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cstdlib>
#include <filesystem>

namespace regain::tools {

std::string label_font()
{
    if (const char* font = std::getenv("REGAIN_FONT")) return font;
    for (const char* font : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                             "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                             "/usr/share/fonts/TTF/DejaVuSans.ttf",
                             "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"})
    {
        std::error_code ec;
        if (std::filesystem::exists(font, ec)) return font;
    }
    return {};
}

bool set_label(Picture& picture, const std::string& text, int x, int y, int size, float value)
{
    const std::string font = label_font();
    if (font.empty() || text.empty()) return false;
    OIIO::ImageBuf buffer(OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeDesc::FLOAT),
                          picture.pixels.data());
    const float color[] = {value, value, value};
    const bool set = OIIO::ImageBufAlgo::render_text(buffer, x, y, text, size, font, color,
                                                     OIIO::ImageBufAlgo::TextAlignX::Center,
                                                     OIIO::ImageBufAlgo::TextAlignY::Baseline);
    if (!set) (void)buffer.geterror();
    return set;
}

}  // namespace regain::tools
