// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Pictures as documents read them: where texels are, what is beyond the edges, colour and data, and
// how much of a large one is in memory.

#include "texture_file.h"

#include "../support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <thread>

using namespace regain;
using namespace regain::shaders;
using regain::tools::TextureFiles;

namespace {

std::filesystem::path write_picture(const std::filesystem::path& file, int width, int height,
                                    int channels, OIIO::TypeDesc type, bool tiled,
                                    const std::function<float(int, int, int)>& value)
{
    auto out = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(out) << file;
    OIIO::ImageSpec spec(width, height, channels, type);
    if (tiled) spec.tile_width = spec.tile_height = 64;
    EXPECT_TRUE(out->open(file.string(), spec));
    std::vector<float> pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) pixels.push_back(value(x, y, c));
    EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
    out->close();
    return file;
}

struct Texel
{
    float c[4];
};
Texel at(const Texture& t, float u, float v, AddressMode mode = AddressMode::periodic)
{
    Texel r;
    t.at(u, v, mode, mode, r.c);
    return r;
}

TEST(Textures, texels_are_where_they_should_be)
{
    const test::TemporaryFolder folder;
    // Red is the column, green the row from above.
    const auto file = write_picture(folder / "a.exr", 4, 2, 3, OIIO::TypeDesc::FLOAT, false,
                                    [](int x, int y, int c) {
                                        return c == 0 ? float(x) : c == 1 ? float(y) : 0.5f;
                                    });
    const TextureFiles files(ColorConfig::builtin());
    const auto t = files.loader()(file, "");
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 2; ++y)
        {
            const Texel r = at(*t, (float(x) + 0.5f) / 4, 1 - (float(y) + 0.5f) / 2);
            EXPECT_NEAR(r.c[0], x, 1e-5f);
            EXPECT_NEAR(r.c[1], y, 1e-5f);
            EXPECT_EQ(r.c[2], 0.5f);
            EXPECT_EQ(r.c[3], 1);
        }
    // Half way between.
    EXPECT_NEAR(at(*t, 0.5f, 0.75f).c[0], 1.5f, 1e-5f);
    EXPECT_NEAR(at(*t, 0.375f, 0.5f).c[1], 0.5f, 1e-5f);
    // The edge, and beyond.
    EXPECT_NEAR(at(*t, 0, 0.75f).c[0], 1.5f, 1e-5f) << "0 and 3 meet";
    EXPECT_NEAR(at(*t, 0, 0.75f, AddressMode::clamp).c[0], 0, 1e-5f);
    EXPECT_NEAR(at(*t, 0, 0.75f, AddressMode::mirror).c[0], 0, 1e-5f);
    EXPECT_NEAR(at(*t, 5.125f, 0.75f).c[0], 0, 1e-4f);
    EXPECT_NEAR(at(*t, 1.125f, 0.75f, AddressMode::mirror).c[0], 3, 1e-4f);
    EXPECT_NEAR(at(*t, -7, 0.75f, AddressMode::clamp).c[0], 0, 1e-5f);
    for (const float far : {1e30f, -1e30f}) EXPECT_TRUE(std::isfinite(at(*t, far, far).c[0]));
}

TEST(Textures, channels_that_are_missing_are_made)
{
    const test::TemporaryFolder folder;
    const TextureFiles files(ColorConfig::builtin());
    const auto value = [](int, int, int c) { return 0.2f * float(c + 1); };
    const auto read = [&](int channels) {
        const auto t =
            files.loader()(write_picture(folder / (std::to_string(channels) + ".exr"), 2, 2,
                                         channels, OIIO::TypeDesc::FLOAT, false, value),
                           "");
        return at(*t, 0.5f, 0.5f);
    };
    const float expected[4][4] = {{0.2f, 0.2f, 0.2f, 1},
                                  {0.2f, 0.2f, 0.2f, 0.4f},
                                  {0.2f, 0.4f, 0.6f, 1},
                                  {0.2f, 0.4f, 0.6f, 0.8f}};
    for (int n = 1; n <= 4; ++n)
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(read(n).c[c], expected[n - 1][c], 1e-6f) << n;
}

// Between texels it is light that is interpolated, not its code.
TEST(Textures, colours_are_converted_before_they_are_mixed)
{
    const test::TemporaryFolder folder;
    const auto file = write_picture(folder / "c.png", 2, 1, 3, OIIO::TypeDesc::UINT8, false,
                                    [](int x, int, int) { return float(x); });
    const TextureFiles files(ColorConfig::builtin());
    const auto color = files.loader()(file, "srgb_texture"), data = files.loader()(file, "");
    EXPECT_NEAR(at(*color, 0.75f, 0.5f).c[1], 1, 1e-4f);
    EXPECT_NEAR(at(*color, 0.5f, 0.5f).c[1], 0.5f, 1e-4f);
    EXPECT_NEAR(at(*data, 0.5f, 0.5f).c[1], 0.5f, 1e-4f);
    const auto grey = write_picture(folder / "g.png", 1, 1, 3, OIIO::TypeDesc::UINT8, false,
                                    [](int, int, int) { return 0.5f; });
    // 128 of 255 by the sRGB curve, IEC 61966-2-1.
    const double code = 128.0 / 255, light = std::pow((code + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(at(*files.loader()(grey, "srgb_texture"), 0, 0).c[0], light, 1e-4);
    EXPECT_NEAR(at(*files.loader()(grey, ""), 0, 0).c[0], code, 1e-4);
}

// Of a picture of 4096 x 4096 floats, 201 MB, no more than the cache may hold.
TEST(Textures, large_pictures_are_in_memory_by_tiles)
{
    const test::TemporaryFolder folder;
    const int size = 4096;
    auto out = OIIO::ImageOutput::create("large.exr");
    OIIO::ImageSpec spec(size, size, 3, OIIO::TypeDesc::HALF);
    spec.tile_width = spec.tile_height = 64;
    spec.attribute("compression", "zip");
    const auto file = folder / "large.exr";
    ASSERT_TRUE(out->open(file.string(), spec));
    std::vector<float> tile(64 * 64 * 3);
    for (int y = 0; y < size; y += 64)
        for (int x = 0; x < size; x += 64)
        {
            for (std::size_t i = 0; i < tile.size(); ++i) tile[i] = float(x + y) / (2 * size);
            ASSERT_TRUE(out->write_tile(x, y, 0, OIIO::TypeDesc::FLOAT, tile.data()));
        }
    out->close();

    const int megabytes = 16;
    const TextureFiles files(ColorConfig::builtin(), megabytes);
    const auto t = files.loader()(file, "");
    (void)at(*t, 0.1f, 0.1f);
    EXPECT_LT(files.bytes_held(), 1 << 20) << "what is looked at";
    // All over it, by several threads.
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k)
        threads.emplace_back([&, k] {
            for (int i = k; i < 10000; i += 4)
            {
                const float u = float(std::fmod(i * 0.7548776662, 1.0)),
                            v = float(std::fmod(i * 0.5698402910, 1.0));
                const Texel r = at(*t, u, v, AddressMode::clamp);
                ASSERT_NEAR(r.c[0], (u + 1 - v) / 2, 0.03f);
            }
        });
    for (auto& thread : threads) thread.join();
    // The cache keeps a tile a thread besides.
    EXPECT_LT(files.bytes_held(), std::int64_t(megabytes + 2) << 20);
    EXPECT_GT(files.bytes_read(), std::int64_t(60) << 20) << "most of it was looked at";
}

}  // namespace
