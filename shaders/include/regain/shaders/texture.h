// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Pictures that a surface's numbers come from. What reads them is a renderer's own, or what
/// `regain` has on OpenImageIO: documents only say which file, and what its values are.

#pragma once

#include <regain/closures/version.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// What is beyond the unit square, along one axis. `constant` is what who asks puts there; a
/// texture takes it for clamp.
enum class AddressMode { constant, clamp, periodic, mirror };

class Texture
{
public:
    virtual ~Texture() = default;

    /// Four channels at (u, v), v upwards: between texels interpolated, a missing channel 0 but
    /// alpha 1, one channel the same in three; a colour in scene_linear. u and v are finite. Never
    /// throws; black where the picture cannot be read any more. Any number of threads.
    virtual void at(float u, float v, AddressMode u_mode, AddressMode v_mode,
                    float result[4]) const = 0;
};

/// A picture of that file. `color_space`, of the values of colours, is a name of the document's;
/// empty where they are data, to be taken as they are. Throws std::runtime_error, which names the
/// file and says why it cannot be used.
using TextureLoader = std::function<std::shared_ptr<const Texture>(
    const std::filesystem::path& file, const std::string& color_space)>;

}  // namespace shaders
REGAIN_NAMESPACE_END
