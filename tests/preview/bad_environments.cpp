// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Environments that cannot be used are refused with a message that names the file and what is
// wrong.

#include "../support/temporary_folder.h"
#include "errors.h"
#include "preview/environment.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

namespace regain::tools::preview { namespace {

namespace fs = std::filesystem;

class BadEnvironments : public testing::Test
{
protected:
    fs::path write(const char* name, int width, int height, int channels,
                   OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT,
                   const std::vector<std::pair<std::size_t, float>>& odd = {})
    {
        const fs::path path = folder / name;
        std::vector<float> values(static_cast<std::size_t>(width * height * channels), 0.5f);
        for (const auto& [index, value] : odd) values[index] = value;
        auto out = OIIO::ImageOutput::create(path.string());
        EXPECT_TRUE(out &&
                    out->open(path.string(), OIIO::ImageSpec(width, height, channels, type)));
        EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
        out->close();
        return path;
    }
    static void expect_refused(const fs::path& path, const std::string& what)
    {
        try
        {
            read_latlong(path);
            ADD_FAILURE() << path << " was accepted";
        }
        catch (const BadInput& e)
        {
            const std::string message = e.what();
            EXPECT_NE(message.find(path.string()), std::string::npos) << message;
            EXPECT_NE(message.find(what), std::string::npos) << message;
        }
    }

    const test::TemporaryFolder temporary;
    const fs::path folder = temporary.path();
};

TEST_F(BadEnvironments, GoodOnesAreRead)
{
    const LatLongImage exr = read_latlong(write("good.exr", 8, 4, 3));
    EXPECT_EQ(exr.width, 8);
    EXPECT_EQ(exr.pixels.size(), 32u);
    EXPECT_EQ(exr.pixels[5], Imath::C3f(0.5f));
    EXPECT_EQ(read_latlong(write("good.hdr", 8, 4, 3)).height, 4);
    EXPECT_EQ(read_latlong(write("alpha.exr", 8, 4, 4)).pixels[0], Imath::C3f(0.5f));
}

TEST_F(BadEnvironments, Missing) { expect_refused(folder / "none.exr", "no such file"); }
TEST_F(BadEnvironments, Folder) { expect_refused(folder, "cannot read it"); }

TEST_F(BadEnvironments, NotAnImage)
{
    std::ofstream(folder / "text.exr") << "not an image";
    expect_refused(folder / "text.exr", "cannot read it");
}

TEST_F(BadEnvironments, Damaged)
{
    const fs::path path = write("cut.exr", 256, 128, 3);
    fs::resize_file(path, fs::file_size(path) / 2);
    expect_refused(path, "");
}

TEST_F(BadEnvironments, Shape) { expect_refused(write("square.exr", 8, 8, 3), "8 x 8"); }
TEST_F(BadEnvironments, OneChannel) { expect_refused(write("grey.exr", 8, 4, 1), "1 channel"); }
TEST_F(BadEnvironments, NotLinear)
{
    expect_refused(write("display.png", 8, 4, 3, OIIO::TypeDesc::UINT8), "floating-point");
}
TEST_F(BadEnvironments, NotANumber)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect_refused(write("nan.exr", 8, 4, 3, OIIO::TypeDesc::FLOAT, {{3 * 9 + 1, nan}}),
                   "pixel (1, 1), channel 1 is nan");
}
TEST_F(BadEnvironments, Infinite)
{
    const float inf = std::numeric_limits<float>::infinity();
    expect_refused(write("inf.exr", 8, 4, 3, OIIO::TypeDesc::FLOAT, {{0, inf}}), "is inf");
}
TEST_F(BadEnvironments, Negative)
{
    expect_refused(write("negative.exr", 8, 4, 3, OIIO::TypeDesc::FLOAT, {{95, -1.0f}}),
                   "pixel (7, 3), channel 2 is -1");
}
TEST_F(BadEnvironments, Black)
{
    LatLongImage black;
    black.width = 8;
    black.height = 4;
    black.pixels.assign(32, Imath::C3f(0.0f));
    EXPECT_THROW(Environment{black}, BadInput);
}

}}  // namespace regain::tools::preview
