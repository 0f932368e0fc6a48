// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Colour spaces by MaterialX's names. A config that knows the name, or one of the usual other
/// names of that space, converts by it. For one that does not, the space's own definition is used:
/// its transfer curve, then its primaries' XYZ by D65 (Rec. 709: ITU-R BT.709; sRGB: IEC
/// 61966-2-1; Display P3: SMPTE EG 432-1; Adobe RGB (1998); ACES: SMPTE ST 2065-1, ACEScg
/// S-2014-004, adapted by Bradford), which the config leads to scene_linear.

#pragma once

#include <regain/shaders/color_config.h>

#include <optional>
#include <string>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

class DocumentColor
{
public:
    /// Leaves colours as they are.
    DocumentColor() = default;

    /// From the space of that name to scene_linear. "none", "raw", "data" and "" leave values
    /// alone; null where neither the config nor MaterialX knows the name.
    REGAIN_SHADERS_API static std::optional<DocumentColor> named(const ColorConfig& config,
                                                                 const std::string& name);

    REGAIN_SHADERS_API void apply(Imath::C3f* colors, std::size_t count) const;
    Imath::C3f operator()(Imath::C3f color) const
    {
        apply(&color, 1);
        return color;
    }
    /// Values are left alone.
    bool is_identity() const { return !_definition && _transform.is_identity(); }

private:
    struct Definition;
    ColorTransform _transform;
    std::shared_ptr<const Definition> _definition;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
