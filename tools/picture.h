// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Pictures, and how they get to disk: EXR for work, PNG for eyes. Files appear whole or not at
/// all.

#pragma once

#include <regain/shaders/color_config.h>

#include <Imath/ImathColor.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace regain::tools {

/// Row-major, top row first, scene linear.
struct Picture
{
    int width = 0, height = 0;
    std::vector<Imath::C3f> pixels;
};

/// Written as text attributes "regain:NAME", in this order.
struct Metadata
{
    std::vector<std::pair<std::string, std::string>> entries;
};

/// The first three channels of a file that OpenImageIO reads. Throws std::runtime_error that names
/// the file and what is wrong.
Picture read_picture(const std::filesystem::path& file);

/// A text attribute of a file; empty where there is none, or no such file.
std::string text_attribute(const std::filesystem::path& file, const std::string& name);

/// As an EXR of half floats holds it: what write_exr writes and read_picture reads.
Picture as_written(const Picture& picture);

/// More channels of a picture, in its EXR: NAME.R, NAME.G, NAME.B, or NAME.Y of one.
struct Layer
{
    std::string name;
    int channels = 3;
    std::vector<float> values;  ///< pixel by pixel
};

/// Half float, scene linear. Values beyond the range of half (65504) are clamped to it. Beside the
/// metadata the file says the software, "regain:version", and its colour space,
/// "regain:colorspace": the entry of that name where there is one, otherwise the scene_linear of
/// ColorConfig::active(). It carries no date: the same picture is the same file, byte for byte.
/// Throws std::runtime_error if a pixel is not finite (with their number), if the size does not fit
/// the pixels, if the name does not end in .exr, or if the file cannot be written.
/// Layers are 32 bits a channel, and of the picture's size.
void write_exr(const std::filesystem::path& file, const Picture& picture, const Metadata& metadata,
               const std::vector<Layer>& layers = {});

/// Row-major, top row first, three bytes a pixel as a display takes them.
struct DisplayPicture
{
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes;
};

/// 8 bits a channel, through the display and view of the config ("" = default); values are clamped
/// to [0, 1] and rounded to the nearest step, without dither. Throws where the config does not know
/// the display or the view.
DisplayPicture displayed(const Picture& picture, const shaders::ColorConfig& config,
                         const std::string& display, const std::string& view);

/// Those. Throws as write_exr does (the name must end in .png), and as `displayed`.
void write_png(const std::filesystem::path& file, const Picture& picture,
               const shaders::ColorConfig& config, const std::string& display,
               const std::string& view);

/// Those bytes. Throws std::runtime_error if the size does not fit them, if the name does not end
/// in .png, or if the file cannot be written.
void write_png(const std::filesystem::path& file, const DisplayPicture& picture);

/// The same as the bytes of such a file.
std::string png_bytes(const DisplayPicture& picture);

}  // namespace regain::tools
