// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "builtin_config.h"

#include <initializer_list>

namespace OCIO = OCIO_NAMESPACE;

REGAIN_NAMESPACE_BEGIN
namespace shaders::detail {

namespace {

OCIO::TransformRcPtr builtin(const char* style,
                             OCIO::TransformDirection direction = OCIO::TRANSFORM_DIR_FORWARD)
{
    const auto transform = OCIO::BuiltinTransform::Create();
    transform->setStyle(style);
    transform->setDirection(direction);
    return transform;
}

OCIO::TransformRcPtr group(std::initializer_list<OCIO::TransformRcPtr> transforms)
{
    const auto all = OCIO::GroupTransform::Create();
    for (const auto& transform : transforms) all->appendTransform(transform);
    return all;
}

// From the scene reference, ACES2065-1.
OCIO::TransformRcPtr to_linear_rec709()
{
    return group({builtin("ACEScg_to_ACES2065-1", OCIO::TRANSFORM_DIR_INVERSE),
                  builtin("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD")});
}

OCIO::TransformRcPtr to_srgb_texture()
{
    const auto curve = OCIO::ExponentWithLinearTransform::Create();
    curve->setGamma({2.4, 2.4, 2.4, 1.0});
    curve->setOffset({0.055, 0.055, 0.055, 0.0});
    curve->setNegativeStyle(OCIO::NEGATIVE_LINEAR);
    curve->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
    return group({to_linear_rec709(), curve});
}

OCIO::TransformRcPtr to_gamma22_texture()
{
    const auto curve = OCIO::ExponentTransform::Create();
    curve->setValue({2.2, 2.2, 2.2, 1.0});
    curve->setNegativeStyle(OCIO::NEGATIVE_MIRROR);
    curve->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
    return group({to_linear_rec709(), curve});
}

struct Space
{
    const char* name;
    std::initializer_list<const char*> aliases;  // MaterialX's and the ACES configs' names
    const char* encoding;
    const char* description;
};

void add_scene_space(OCIO::Config& config, const Space& is, const OCIO::TransformRcPtr& to_here,
                     const OCIO::TransformRcPtr& to_reference = nullptr)
{
    const auto space = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_SCENE);
    space->setName(is.name);
    for (const char* alias : is.aliases) space->addAlias(alias);
    space->setEncoding(is.encoding);
    space->setDescription(is.description);
    space->setBitDepth(OCIO::BIT_DEPTH_F32);
    if (to_here) space->setTransform(to_here, OCIO::COLORSPACE_DIR_FROM_REFERENCE);
    if (to_reference) space->setTransform(to_reference, OCIO::COLORSPACE_DIR_TO_REFERENCE);
    config.addColorSpace(space);
}

void add_display_space(OCIO::Config& config, const Space& is, const OCIO::TransformRcPtr& to_here)
{
    const auto space = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_DISPLAY);
    space->setName(is.name);
    for (const char* alias : is.aliases) space->addAlias(alias);
    space->setEncoding(is.encoding);
    space->setDescription(is.description);
    space->setBitDepth(OCIO::BIT_DEPTH_F32);
    if (to_here) space->setTransform(to_here, OCIO::COLORSPACE_DIR_FROM_REFERENCE);
    config.addColorSpace(space);
}

void add_view_transform(OCIO::Config& config, const char* name, const char* style)
{
    const auto view = OCIO::ViewTransform::Create(OCIO::REFERENCE_SPACE_SCENE);
    view->setName(name);
    view->setTransform(builtin(style), OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE);
    config.addViewTransform(view);
}

}  // namespace

OCIO::ConstConfigRcPtr make_builtin_config()
{
    const auto config = OCIO::Config::Create();
    config->setVersion(2, 1);
    config->setName("regain-builtin");
    config->setDescription("Regain's own: ACEScg rendering, sRGB display.");

    // Spaces; the scene reference is ACES2065-1, the display reference CIE XYZ for a D65 white.
    add_scene_space(*config,
                    {"ACES2065-1", {"lin_ap0"}, "scene-linear", "SMPTE ST 2065-1, AP0 primaries."},
                    nullptr);
    add_scene_space(*config,
                    {"ACEScg", {"acescg", "lin_ap1"}, "scene-linear", "AP1 primaries, linear."},
                    nullptr, builtin("ACEScg_to_ACES2065-1"));
    add_scene_space(*config, {"ACEScct", {}, "log", "AP1 primaries, logarithmic with a toe."},
                    nullptr, builtin("ACEScct_to_ACES2065-1"));
    add_scene_space(*config,
                    {"Linear Rec.709 (sRGB)",
                     {"lin_rec709", "lin_rec709_srgb", "lin_srgb"},
                     "scene-linear",
                     "Rec.709 primaries, linear."},
                    to_linear_rec709());
    add_scene_space(*config,
                    {"sRGB - Texture",
                     {"srgb_texture", "srgb_tx", "sRGB Texture"},
                     "sdr-video",
                     "Rec.709 primaries, the sRGB curve: textures painted on a monitor."},
                    to_srgb_texture());
    add_scene_space(*config,
                    {"Gamma 2.2 Rec.709 - Texture",
                     {"g22_rec709", "g22_rec709_tx"},
                     "sdr-video",
                     "Rec.709 primaries, a power of 2.2."},
                    to_gamma22_texture());
    const auto raw = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_SCENE);
    raw->setName("Raw");
    raw->setDescription("Values that are no colours: normals, masks, roughness.");
    raw->setBitDepth(OCIO::BIT_DEPTH_F32);
    raw->setIsData(true);
    config->addColorSpace(raw);

    add_display_space(
        *config,
        {"CIE-XYZ-D65", {"cie_xyz_d65"}, "display-linear", "CIE 1931 XYZ, D65 white at Y = 1."},
        nullptr);
    add_display_space(*config,
                      {"sRGB - Display", {"srgb_display"}, "sdr-video", "IEC 61966-2-1 monitor."},
                      builtin("DISPLAY - CIE-XYZ-D65_to_sRGB"));

    // Views. The first view transform is the one that links scene and display spaces elsewhere: it
    // must not be a tone curve.
    add_view_transform(*config, "Un-tone-mapped", "UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD");
    add_view_transform(*config, "ACES 1.0 - SDR Video",
                       "ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0");
    config->setDefaultViewTransformName("Un-tone-mapped");
    for (const char* view : {"ACES 1.0 - SDR Video", "Un-tone-mapped"})
        config->addDisplayView("sRGB", view, view, "sRGB - Display", "", "", "");
    config->addDisplayView("sRGB", "raw", "Raw", "");

    // Roles.
    config->setRole(OCIO::ROLE_SCENE_LINEAR, "ACEScg");
    config->setRole(OCIO::ROLE_RENDERING, "ACEScg");
    config->setRole(OCIO::ROLE_INTERCHANGE_SCENE, "ACES2065-1");
    config->setRole(OCIO::ROLE_INTERCHANGE_DISPLAY, "CIE-XYZ-D65");
    config->setRole(OCIO::ROLE_DEFAULT, "ACEScg");
    config->setRole(OCIO::ROLE_DATA, "Raw");
    config->setRole(OCIO::ROLE_COLOR_PICKING, "sRGB - Texture");
    config->setRole(OCIO::ROLE_TEXTURE_PAINT, "sRGB - Texture");
    config->setRole(OCIO::ROLE_MATTE_PAINT, "sRGB - Texture");
    config->setRole(OCIO::ROLE_COLOR_TIMING, "ACEScct");
    config->setRole(OCIO::ROLE_COMPOSITING_LOG, "ACEScct");
    return config;
}

}  // namespace shaders::detail
REGAIN_NAMESPACE_END
