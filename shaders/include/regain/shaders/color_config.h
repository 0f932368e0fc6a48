// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Which colour spaces and displays there are, by OpenColorIO: the config in $OCIO, or a small one
/// of Regain's own. Colours inside Regain are linear scene-referred, in the space of the config's
/// role `scene_linear`.
///
/// All that cannot be done throws std::runtime_error with a message that says what was given, what
/// is accepted, and what to do.

#pragma once

#include <regain/closures/version.h>
#include <regain/shaders/color.h>
#include <regain/shaders/export.h>

#include <Imath/ImathColor.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// A conversion of colours, ready to run. Cheap to copy; may be used by several threads at once.
class REGAIN_SHADERS_API ColorTransform
{
public:
    struct Impl;

    /// Leaves colours as they are.
    ColorTransform() = default;
    explicit ColorTransform(std::shared_ptr<const Impl> impl) : _impl(std::move(impl)) {}

    /// Converts packed pixels in place. Any float is accepted; what becomes of NaN and infinity is
    /// up to the config's transforms.
    void apply(Imath::C3f* pixels, std::size_t count) const;
    void apply(std::vector<Imath::C3f>& pixels) const { apply(pixels.data(), pixels.size()); }
    Imath::C3f operator()(Imath::C3f color) const
    {
        apply(&color, 1);
        return color;
    }

    /// True where colours are left as they are: data, and conversions to the same space.
    bool is_identity() const;

private:
    std::shared_ptr<const Impl> _impl;
};

/// A colour configuration. Cheap to copy; may be used by several threads at once.
class REGAIN_SHADERS_API ColorConfig
{
public:
    /// The config in the environment variable OCIO if that is set and not empty, otherwise the
    /// built-in one. Reads the file at each call: keep what is returned. Throws if OCIO names a
    /// config that cannot be used; it is never silently replaced.
    static ColorConfig active();

    /// Regain's own: `scene_linear` is ACEScg; linear and textured Rec.709 and ACES2065-1 beside
    /// it; one display, sRGB, with an ACES 1 rendering, an un-tone-mapped one and `raw`.
    static ColorConfig builtin();

    /// From a file, or from whatever else the OpenColorIO in use takes for one ("ocio://default"
    /// and .ocioz archives from 2.2 on). The config must have a role scene_linear.
    static ColorConfig from_file(const std::filesystem::path& file);

    /// The config's own name, or the path of its file if it gives none.
    std::string name() const;

    /// The colour space that the role scene_linear names, for example "ACEScg".
    std::string scene_linear() const;

    /// From CIE 1931 XYZ, scaled so that the D65 white has Y = 1, to scene_linear: matrix * column
    /// (XYZ), taken from the config itself. The white of D65, by its chromaticity
    /// (0.3127, 0.3290), becomes what the config makes of it: (1, 1, 1) in every config that adapts
    /// between whites.
    /// Three ways are tried in turn: the role aces_interchange (a Bradford adaptation leads to its
    /// white); the role cie_xyz_d65_interchange; for configs older than these roles, a space called
    /// ACES2065-1 or one of its usual other names. The scene-referred role comes first because from
    /// the other one, which is display-referred, a config may answer by inverting a tone curve.
    /// Throws where none of them leads there by a linear map.
    C3d to_scene_linear_from_xyz_d65(const C3d& xyz) const;
    Imath::C3f to_scene_linear_from_xyz_d65(const Imath::C3f& xyz) const;

    /// Colour spaces and their roles, conversion between them (textures, environments). Names are
    /// what the config knows: spaces, their aliases, roles. A data space converts to nothing else:
    /// its values are left alone.
    std::vector<std::string> color_spaces() const;
    bool has_color_space(const std::string& name_or_role) const;
    ColorTransform convert(const std::string& from_space, const std::string& to_space) const;

    /// Displays and the views of each, the default first. `raw` is a view of every display, whether
    /// or not the config says so.
    std::vector<std::string> displays() const;
    std::vector<std::string> views(const std::string& display = "") const;
    std::string default_display() const;
    std::string default_view(const std::string& display = "") const;

    /// From scene_linear to what the display is sent, in [0, 1] but for what the view leaves
    /// outside. "" is the default display, and the display's default view. The view `raw`, in any
    /// case of letters, passes values through.
    ColorTransform display_transform(const std::string& display, const std::string& view) const;

    /// Throws what OpenColorIO finds wrong with the config.
    void validate() const;

    /// The config as text, as an .ocio file holds it: for other programs that should see the same.
    std::string text() const;

private:
    struct Impl;
    explicit ColorConfig(std::shared_ptr<const Impl> impl) : _impl(std::move(impl)) {}
    std::shared_ptr<const Impl> _impl;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
