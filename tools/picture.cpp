// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "picture.h"

#include <regain/luts/replace_file.h>

#include <Imath/half.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace regain::tools {

namespace fs = std::filesystem;

namespace {

constexpr const char* software = "Regain " REGAIN_VERSION_STRING;

[[noreturn]] void fail(const fs::path& file, const std::string& why)
{
    throw std::runtime_error("cannot write '" + file.string() + "': " + why);
}

void check_size(const fs::path& file, int width, int height, std::size_t pixels)
{
    if (width < 1 || height < 1) fail(file, "the picture is empty");
    if (pixels != std::size_t(width) * std::size_t(height))
        fail(file, "the picture is " + std::to_string(width) + " x " + std::to_string(height) +
                       " but has " + std::to_string(pixels) + " pixels");
}

void check(const fs::path& file, const Picture& picture)
{
    check_size(file, picture.width, picture.height, picture.pixels.size());

    // Never painted over: a pixel that is not a number is a defect in what made it.
    const auto bad =
        std::count_if(picture.pixels.begin(), picture.pixels.end(), [](const Imath::C3f& p) {
            return !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
        });
    if (bad > 0)
        fail(file, std::to_string(bad) + " of " + std::to_string(picture.pixels.size()) +
                       " pixels are not finite");
}

void write(const fs::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
           const void* values)
{
    luts::replace_file(file, [&](const fs::path& temporary) {
        const auto output = OIIO::ImageOutput::create(temporary.string());
        if (!output) fail(file, OIIO::geterror());
        if (!output->open(temporary.string(), spec)) fail(file, output->geterror());
        const bool written = output->write_image(type, values);
        // A full disk shows only now.
        if (!output->close() || !written) fail(file, output->geterror());
    });
}

// Where the extension is another, OpenImageIO would write another format.
void need_extension(const fs::path& file, const std::string& extension)
{
    std::string given = file.extension().string();
    std::transform(given.begin(), given.end(), given.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (given != extension) fail(file, "its name must end in " + extension);
}

}  // namespace

std::string text_attribute(const fs::path& file, const std::string& name)
{
    const auto in = OIIO::ImageInput::open(file.string());
    if (!in) return (void)OIIO::geterror(), "";
    return std::string(in->spec().get_string_attribute(name));
}

Picture as_written(const Picture& picture)
{
    constexpr float half_max = 65504.0f;
    Picture written = picture;
    for (Imath::C3f& p : written.pixels)
        for (int c = 0; c < 3; ++c)
            p[c] = static_cast<float>(half(std::clamp(p[c], -half_max, half_max)));
    return written;
}

Picture read_picture(const fs::path& file)
{
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error("cannot read '" + file.string() + "': " + why);
    };
    const auto in = OIIO::ImageInput::open(file.string());
    if (!in) fail(OIIO::geterror());
    const OIIO::ImageSpec& spec = in->spec();
    if (spec.nchannels < 3) fail("it has fewer than three channels");
    Picture picture{spec.width, spec.height, {}};
    picture.pixels.resize(std::size_t(spec.width) * std::size_t(spec.height));
    if (!in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, picture.pixels.data()))
        fail(in->geterror());
    check(file, picture);
    return picture;
}

void write_exr(const fs::path& file, const Picture& picture, const Metadata& metadata,
               const std::vector<Layer>& layers)
{
    need_extension(file, ".exr");
    check(file, picture);

    const std::vector<Imath::C3f> pixels = as_written(picture).pixels;

    OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::HALF);
    spec.attribute("compression", "zip");
    spec.attribute("Software", software);
    std::string space;
    for (const auto& [name, value] : metadata.entries)
    {
        spec.attribute("regain:" + name, value);
        if (name == "colorspace") space = value;
    }
    if (space.empty())
    {
        space = shaders::ColorConfig::active().scene_linear();
        spec.attribute("regain:colorspace", space);
    }
    spec.attribute("oiio:ColorSpace", space);
    // Left out, it would be now, and the same picture would never be the same file.
    spec.attribute("DateTime", "");
    if (!spec.find_attribute("regain:version"))
        spec.attribute("regain:version", REGAIN_VERSION_STRING);

    if (layers.empty()) return write(file, spec, OIIO::TypeDesc::FLOAT, pixels.data());

    spec.channelnames = {"R", "G", "B"};
    spec.channelformats.assign(3, OIIO::TypeDesc::HALF);
    for (const Layer& layer : layers)
        for (int c = 0; c < layer.channels; ++c)
        {
            spec.channelnames.push_back(layer.name + (layer.channels == 1 ? ".Y"
                                                      : c == 0            ? ".R"
                                                      : c == 1            ? ".G"
                                                                          : ".B"));
            spec.channelformats.emplace_back(OIIO::TypeDesc::FLOAT);
        }
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    std::vector<float> values;
    values.reserve(pixels.size() * spec.channelnames.size());
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
        for (int c = 0; c < 3; ++c) values.push_back(pixels[i][c]);
        for (const Layer& layer : layers)
            for (int c = 0; c < layer.channels; ++c)
                values.push_back(layer.values.at(i * static_cast<std::size_t>(layer.channels) +
                                                 static_cast<std::size_t>(c)));
    }
    write(file, spec, OIIO::TypeDesc::FLOAT, values.data());
}

DisplayPicture displayed(const Picture& picture, const shaders::ColorConfig& config,
                         const std::string& display, const std::string& view)
{
    const shaders::ColorTransform to_display = config.display_transform(display, view);
    std::vector<Imath::C3f> pixels = picture.pixels;
    to_display.apply(pixels);

    // Rounded here, not by the writer, whose rounding may change with its version.
    DisplayPicture bytes{picture.width, picture.height, {}};
    bytes.bytes.reserve(3 * pixels.size());
    for (const Imath::C3f& p : pixels)
        for (int c = 0; c < 3; ++c)
        {
            const float v = p[c] > 0 ? std::min(p[c], 1.0f) : 0.0f;
            bytes.bytes.push_back(static_cast<std::uint8_t>(v * 255.0f + 0.5f));
        }
    return bytes;
}

void write_png(const fs::path& file, const Picture& picture, const shaders::ColorConfig& config,
               const std::string& display, const std::string& view)
{
    need_extension(file, ".png");
    check(file, picture);
    write_png(file, displayed(picture, config, display, view));
}

void write_png(const fs::path& file, const DisplayPicture& picture)
{
    need_extension(file, ".png");
    check_size(file, picture.width, picture.height, picture.bytes.size() / 3);
    OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("Software", software);
    write(file, spec, OIIO::TypeDesc::UINT8, picture.bytes.data());
}

std::string png_bytes(const DisplayPicture& picture)
{
    const fs::path name("a picture in memory.png");
    check_size(name, picture.width, picture.height, picture.bytes.size() / 3);
    OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("Software", software);
    OIIO::Filesystem::IOVecOutput memory;
    const auto output = OIIO::ImageOutput::create(name.string(), &memory);
    if (!output) fail(name, OIIO::geterror());
    if (!output->open(name.string(), spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, picture.bytes.data()) || !output->close())
        fail(name, output->geterror());
    const auto& bytes = memory.buffer();
    return std::string(bytes.begin(), bytes.end());
}

}  // namespace regain::tools
