// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "../errors.h"
#include "environment.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cmath>

namespace regain::tools::preview {

LatLongImage read_latlong(const std::filesystem::path& path)
{
    const std::string name = path.string();
    if (!std::filesystem::exists(path))
        throw BadInput(
            fmt::format("{}: no such file (--environment takes a latitude-longitude "
                        "EXR or HDR image)",
                        name));
    const auto input = OIIO::ImageInput::open(name);
    if (!input) throw BadInput(fmt::format("{}: cannot read it: {}", name, OIIO::geterror()));

    const OIIO::ImageSpec& spec = input->spec();
    if (!spec.format.is_floating_point())
        throw BadInput(
            fmt::format("{}: holds {} values; an environment is scene linear radiance "
                        "and needs a floating-point file (EXR or HDR)",
                        name, spec.format.c_str()));
    if (spec.nchannels < 3)
        throw BadInput(
            fmt::format("{}: has {} channel(s); an environment needs red, green and blue", name,
                        spec.nchannels));
    if (spec.height < 1 || spec.width != 2 * spec.height)
        throw BadInput(
            fmt::format("{}: is {} x {}; a latitude-longitude image is twice as wide as "
                        "high",
                        name, spec.width, spec.height));

    LatLongImage image;
    image.width = spec.width;
    image.height = spec.height;
    image.pixels.resize(static_cast<std::size_t>(spec.width) *
                        static_cast<std::size_t>(spec.height));
    static_assert(sizeof(Imath::C3f) == 3 * sizeof(float), "pixels are read as packed triples");
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, image.pixels.data()))
        throw BadInput(fmt::format("{}: is damaged: {}", name, input->geterror()));

    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (unsigned k = 0; k < 3; ++k)
        {
            const float value = image.pixels[i][k];
            if (std::isfinite(value) && value >= 0.0f) continue;
            const auto width = static_cast<std::size_t>(image.width);
            throw BadInput(
                fmt::format("{}: pixel ({}, {}), channel {} is {}; radiance must be "
                            "finite and not negative",
                            name, i % width, i / width, k, value));
        }
    return image;
}

}  // namespace regain::tools::preview
