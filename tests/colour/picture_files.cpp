// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "picture.h"
#include "temporary.h"

#include <regain/closures/version.h>

#include <Imath/half.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <iterator>
#include <limits>

using namespace regain::tools;
using regain::shaders::ColorConfig;
using test::message_of;
using test::says;

namespace {

Picture gradient(int width, int height)
{
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            picture.pixels.emplace_back(x / 7.0f, y / 3.0f - 0.5f, std::exp(x * 0.2f) * 0.01f);
    return picture;
}

struct ReadBack
{
    OIIO::ImageSpec spec;
    std::vector<float> values;
};

ReadBack read(const std::filesystem::path& file)
{
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) throw std::runtime_error(OIIO::geterror());
    ReadBack r{input->spec(), {}};
    r.values.resize(r.spec.image_pixels() * std::size_t(r.spec.nchannels));
    input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, r.values.data());
    return r;
}

std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool is_empty(const test::TemporaryFolder& folder)
{
    return std::filesystem::is_empty(folder.path());
}

}  // namespace

TEST(PictureFiles, exr_holds_the_pixels_as_half)
{
    const test::TemporaryFolder folder;
    const Picture picture = gradient(33, 17);
    write_exr(folder / "a.exr", picture, {});
    const ReadBack r = read(folder / "a.exr");
    ASSERT_EQ(r.spec.width, 33);
    ASSERT_EQ(r.spec.height, 17);
    ASSERT_EQ(r.spec.nchannels, 3);
    EXPECT_EQ(r.spec.format, OIIO::TypeDesc::HALF);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_EQ(r.values[3 * i + std::size_t(c)], float(half(picture.pixels[i][c]))) << i;
}

TEST(PictureFiles, exr_says_how_it_was_made)
{
    const test::TemporaryFolder folder;
    const test::OcioVariable ocio(std::nullopt);
    write_exr(folder / "a.exr", gradient(4, 4),
              {{{"method", "turquin"}, {"seed", "7"}, {"spp", "64"}, {"alpha", "0.5"}}});
    const OIIO::ImageSpec spec = read(folder / "a.exr").spec;
    EXPECT_EQ(spec.get_string_attribute("regain:method"), "turquin");
    EXPECT_EQ(spec.get_string_attribute("regain:seed"), "7");
    EXPECT_EQ(spec.get_string_attribute("regain:spp"), "64");
    EXPECT_EQ(spec.get_string_attribute("regain:alpha"), "0.5");
    EXPECT_EQ(spec.get_string_attribute("regain:version"), REGAIN_VERSION_STRING);
    EXPECT_EQ(spec.get_string_attribute("regain:colorspace"), "ACEScg");
    EXPECT_EQ(spec.get_string_attribute("Software"), "Regain " REGAIN_VERSION_STRING);

    write_exr(folder / "b.exr", gradient(4, 4), {{{"colorspace", "lin_rec709"}}});
    const OIIO::ImageSpec named = read(folder / "b.exr").spec;
    EXPECT_EQ(named.get_string_attribute("regain:colorspace"), "lin_rec709");
}

TEST(PictureFiles, same_picture_same_bytes)
{
    const test::TemporaryFolder folder;
    const Picture picture = gradient(64, 64);
    for (const char* name : {"a.exr", "b.exr"})
        write_exr(folder / name, picture, {{{"seed", "1"}}});
    EXPECT_EQ(bytes_of(folder / "a.exr"), bytes_of(folder / "b.exr"));
    EXPECT_EQ(read(folder / "a.exr").spec.get_string_attribute("DateTime"), "");
    for (const char* name : {"a.png", "b.png"})
        write_png(folder / name, picture, ColorConfig::builtin(), "", "");
    EXPECT_EQ(bytes_of(folder / "a.png"), bytes_of(folder / "b.png"));
}

TEST(PictureFiles, values_beyond_half_are_clamped)
{
    const test::TemporaryFolder folder;
    write_exr(folder / "a.exr", Picture{1, 1, {Imath::C3f(1e6f, -1e30f, 65519.0f)}}, {});
    EXPECT_EQ(read(folder / "a.exr").values, (std::vector<float>{65504.0f, -65504.0f, 65504.0f}));
}

TEST(PictureFiles, pixels_that_are_not_finite_are_counted_and_refused)
{
    const test::TemporaryFolder folder;
    Picture picture = gradient(5, 2);
    picture.pixels[1].x = std::numeric_limits<float>::quiet_NaN();
    picture.pixels[7].z = -std::numeric_limits<float>::infinity();
    const auto exr = message_of([&] { write_exr(folder / "a.exr", picture, {}); });
    EXPECT_TRUE(says(exr, "2 of 10 pixels are not finite")) << exr;
    const auto png =
        message_of([&] { write_png(folder / "a.png", picture, ColorConfig::builtin(), "", ""); });
    EXPECT_TRUE(says(png, "2 of 10 pixels are not finite")) << png;
    EXPECT_TRUE(is_empty(folder));
}

TEST(PictureFiles, unwritable_paths_throw_and_leave_nothing)
{
    const test::TemporaryFolder folder;
    const Picture picture = gradient(3, 3);
    const auto missing = folder / "no such folder/a.exr";
    EXPECT_TRUE(says(message_of([&] { write_exr(missing, picture, {}); }), missing.string()));
    EXPECT_TRUE(says(message_of([&] { write_exr(folder / "a.txt", picture, {}); }), ".exr"));
    EXPECT_TRUE(says(
        message_of([&] { write_png(folder / "a.exr", picture, ColorConfig::builtin(), "", ""); }),
        ".png"));
    std::filesystem::create_directory(folder / "taken.exr");
    EXPECT_THROW(write_exr(folder / "taken.exr", picture, {}), std::runtime_error);
    std::filesystem::remove(folder / "taken.exr");
    EXPECT_TRUE(is_empty(folder));
}

TEST(PictureFiles, wrong_sizes_are_refused)
{
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_exr(folder / "a.exr", Picture{}, {}), std::runtime_error);
    EXPECT_THROW(write_exr(folder / "a.exr", Picture{2, 2, {Imath::C3f(0.0f)}}, {}),
                 std::runtime_error);
    EXPECT_TRUE(is_empty(folder));
}

TEST(PictureFiles, failed_write_keeps_the_old_file)
{
    const test::TemporaryFolder folder;
    write_exr(folder / "a.exr", gradient(3, 3), {});
    const std::string before = bytes_of(folder / "a.exr");
    Picture broken = gradient(3, 3);
    broken.pixels[0].x = std::numeric_limits<float>::infinity();
    EXPECT_THROW(write_exr(folder / "a.exr", broken, {}), std::runtime_error);
    EXPECT_EQ(bytes_of(folder / "a.exr"), before);
}

TEST(PictureFiles, raw_png_holds_the_values)
{
    const test::TemporaryFolder folder;
    Picture picture{256, 1, {}};
    for (int i = 0; i < 256; ++i) picture.pixels.emplace_back(i / 255.0f);
    write_png(folder / "a.png", picture, ColorConfig::builtin(), "", "raw");
    const ReadBack r = read(folder / "a.png");
    EXPECT_EQ(r.spec.format, OIIO::TypeDesc::UINT8);
    for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(std::lround(r.values[3 * i] * 255), long(i));

    // Nearest step; outside [0, 1] the nearer end.
    write_png(folder / "b.png", Picture{1, 1, {Imath::C3f(-1.0f, 2.0f, 0.4f / 255)}},
              ColorConfig::builtin(), "", "raw");
    EXPECT_EQ(read(folder / "b.png").values, (std::vector<float>{0, 1, 0}));
}

TEST(PictureFiles, png_goes_through_the_view)
{
    const test::TemporaryFolder folder;
    const Picture grey{1, 1, {Imath::C3f(0.18f)}};
    write_png(folder / "a.png", grey, ColorConfig::builtin(), "sRGB", "Un-tone-mapped");
    // The sRGB curve at 0.18: 0.4614, that is 118 of 255.
    EXPECT_EQ(std::lround(read(folder / "a.png").values[0] * 255), 118);
    write_png(folder / "b.png", grey, ColorConfig::builtin(), "", "");
    EXPECT_LT(read(folder / "b.png").values[0], 0.4f);
}

TEST(PictureFiles, unknown_display_or_view_lists_names_and_writes_nothing)
{
    const test::TemporaryFolder folder;
    const auto config = ColorConfig::builtin();
    const auto display =
        message_of([&] { write_png(folder / "a.png", gradient(2, 2), config, "P3", ""); });
    EXPECT_TRUE(says(display, "sRGB")) << display;
    const auto view =
        message_of([&] { write_png(folder / "a.png", gradient(2, 2), config, "", "Filmic"); });
    EXPECT_TRUE(says(view, "Un-tone-mapped")) << view;
    EXPECT_TRUE(is_empty(folder));
}
