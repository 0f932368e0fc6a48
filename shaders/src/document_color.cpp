// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/document_color.h>
#include <regain/shaders/white_adaptation.h>

#include <algorithm>
#include <cmath>
#include <cstring>

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

enum class Curve { linear, srgb, gamma18, gamma22, adobe };

// x and y of red, green, blue and white.
struct Primaries
{
    double xy[4][2];
};
constexpr double d65[2] = {0.3127, 0.3290}, aces[2] = {0.32168, 0.33767};
constexpr Primaries rec709{{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {d65[0], d65[1]}}},
    p3{{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {d65[0], d65[1]}}},
    adobe{{{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {d65[0], d65[1]}}},
    ap1{{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {aces[0], aces[1]}}},
    ap0{{{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}, {aces[0], aces[1]}}};

struct Known
{
    const char* names[6];  // MaterialX's, then those of the usual configs
    Curve curve;
    const Primaries* primaries;
};
constexpr Known known[] = {
    {{"srgb_texture", "srgb_rec709_scene", "sRGB - Texture", "srgb_tx", "Utility - sRGB - Texture"},
     Curve::srgb,
     &rec709},
    {{"lin_rec709", "lin_rec709_scene", "Linear Rec.709 (sRGB)", "lin_rec709_srgb", "lin_srgb",
      "Utility - Linear - sRGB"},
     Curve::linear,
     &rec709},
    {{"g22_rec709", "g22_rec709_scene", "Gamma 2.2 Rec.709 - Texture", "g22_rec709_tx"},
     Curve::gamma22,
     &rec709},
    {{"g18_rec709", "g18_rec709_scene", "Gamma 1.8 Rec.709 - Texture", "g18_rec709_tx"},
     Curve::gamma18,
     &rec709},
    {{"acescg", "lin_ap1", "lin_ap1_scene", "ACEScg", "ACES - ACEScg"}, Curve::linear, &ap1},
    {{"lin_ap0", "lin_ap0_scene", "ACES2065-1", "ACES - ACES2065-1"}, Curve::linear, &ap0},
    {{"g22_ap1", "g22_ap1_scene", "Gamma 2.2 AP1 - Texture", "g22_ap1_tx"}, Curve::gamma22, &ap1},
    {{"adobergb", "adobergb_scene"}, Curve::adobe, &adobe},
    {{"lin_adobergb", "lin_adobergb_scene"}, Curve::linear, &adobe},
    {{"srgb_displayp3", "srgb_p3d65_scene"}, Curve::srgb, &p3},
    {{"lin_displayp3", "lin_p3d65_scene", "Linear P3-D65", "lin_p3d65"}, Curve::linear, &p3}};

Imath::M33d xyz_d65_of(const Primaries& p)
{
    Imath::M33d m;
    for (int k = 0; k < 3; ++k)
    {
        const double x = p.xy[k][0], y = p.xy[k][1], xyz[3] = {x, y, 1 - x - y};
        for (int row = 0; row < 3; ++row) m[row][k] = xyz[row];
    }
    const C3d white = xyz_of_chromaticity(p.xy[3][0], p.xy[3][1]),
              scale = times_column(m.inverse(), white);
    for (int k = 0; k < 3; ++k)
        for (int row = 0; row < 3; ++row) m[row][k] *= scale[k];
    return bradford_adaptation(white, d65_white()) * m;
}

double decoded(double v, Curve curve)
{
    const double a = std::abs(v);
    switch (curve)
    {
        case Curve::linear: return v;
        case Curve::srgb:
            return std::copysign(a <= 0.04045 ? a / 12.92 : std::pow((a + 0.055) / 1.055, 2.4), v);
        case Curve::gamma18: return std::copysign(std::pow(a, 1.8), v);
        case Curve::gamma22: return std::copysign(std::pow(a, 2.2), v);
        case Curve::adobe: return std::copysign(std::pow(a, 563.0 / 256), v);
    }
    return v;
}

}  // namespace

struct DocumentColor::Definition
{
    Curve curve;
    Imath::M33d to_scene_linear;
};

std::optional<DocumentColor> DocumentColor::named(const ColorConfig& config,
                                                  const std::string& name)
{
    DocumentColor color;
    for (const char* plain : {"", "none", "raw", "data"})
        if (name == plain) return color;
    const auto by_config = [&](const std::string& space) {
        if (!config.has_color_space(space)) return false;
        color._transform = config.convert(space, "scene_linear");
        return true;
    };
    if (by_config(name)) return color;
    for (const Known& space : known)
    {
        const auto end = std::find(std::begin(space.names), std::end(space.names), nullptr);
        if (std::none_of(std::begin(space.names), end, [&](const char* n) { return name == n; }))
            continue;
        for (auto other = std::begin(space.names); other != end; ++other)
            if (by_config(*other)) return color;
        const auto definition = std::make_shared<Definition>();
        definition->curve = space.curve;
        const Imath::M33d to_xyz = xyz_d65_of(*space.primaries);
        for (int k = 0; k < 3; ++k)
        {
            const C3d column =
                config.to_scene_linear_from_xyz_d65(C3d(to_xyz[0][k], to_xyz[1][k], to_xyz[2][k]));
            for (int row = 0; row < 3; ++row) definition->to_scene_linear[row][k] = column[row];
        }
        color._definition = definition;
        return color;
    }
    return {};
}

void DocumentColor::apply(Imath::C3f* colors, std::size_t count) const
{
    if (!_definition) return _transform.apply(colors, count);
    for (std::size_t i = 0; i < count; ++i)
    {
        C3d c;
        for (int k = 0; k < 3; ++k)
            c[k] = decoded(static_cast<double>(colors[i][k]), _definition->curve);
        colors[i] = Imath::C3f(times_column(_definition->to_scene_linear, c));
    }
}

}  // namespace shaders
REGAIN_NAMESPACE_END
