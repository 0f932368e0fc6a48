// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Runs `regain render` inside the test, in a folder that is gone afterwards.

#pragma once

#include "../support/temporary_folder.h"
#include "commands.h"
#include "errors.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace regain::tools {

class RenderTest : public testing::Test
{
protected:
    /// Exit code of `regain render` with these arguments; out and err hold what it said.
    int run(std::vector<std::string> arguments)
    {
        CLI::App app;
        int exit_code = kDone;
        add_render(app, exit_code);
        arguments.insert(arguments.begin(), "render");
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        try
        {
            app.parse(reversed);
        }
        catch (const CLI::ParseError& e)
        {
            exit_code = app.exit(e) == 0 ? kDone : kBadInput;
        }
        out = testing::internal::GetCapturedStdout();
        err = testing::internal::GetCapturedStderr();
        return exit_code;
    }
    std::string file(const std::string& name) const { return (folder / name).string(); }

    static std::string attribute(const std::string& exr, const std::string& name)
    {
        const auto input = OIIO::ImageInput::open(exr);
        return input ? std::string(input->spec().get_string_attribute(name)) : "no such file";
    }
    /// Of the red channel.
    static double mean(const std::string& exr)
    {
        const auto input = OIIO::ImageInput::open(exr);
        if (!input) return -1;
        const int width = input->spec().width, height = input->spec().height,
                  channels = input->spec().nchannels;
        std::vector<float> pixels(static_cast<std::size_t>(width * height * channels));
        if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, pixels.data())) return -1;
        double sum = 0;
        for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(channels))
            sum += static_cast<double>(pixels[i]);
        return sum / (width * height);
    }
    static std::vector<char> bytes(const std::string& path)
    {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    const test::TemporaryFolder temporary;
    const std::filesystem::path folder = temporary.path();
    std::string out, err;
};

}  // namespace regain::tools
