// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Colours of documents: from the space they are declared in to that of the config, whatever that
// is; indices of refraction from nowhere to nowhere.

#include "documents.h"
#include "texture_file.h"

#include "../colour/configs.h"
#include "../support/color_difference.h"
#include "../support/temporary_folder.h"
#include "../support/working_space.h"

#include <regain/shaders/document_color.h>

#include <cmath>

using namespace regain;
using namespace regain::shaders;
using namespace regain::tests;

namespace {

C3d to_xyz(const C3d& color, const ColorConfig& config)
{
    const Imath::M33d m = to_working_space(config);
    return times_column(m.inverse(), color);
}

// Configs that know MaterialX's names, and one that knows none of them.
std::vector<ColorConfig> configs(const test::TemporaryFolder& folder)
{
    return {ColorConfig::builtin(),
            ColorConfig::from_file(folder.write("a.ocio", test::working_in("ACEScg"))),
            ColorConfig::from_file(folder.write("b.ocio", test::working_in("lin_rec709"))),
            ColorConfig::from_file(folder.write("c.ocio", test::version_1))};
}

// Of a space by its definition: curve, primaries and white, all by hand for one of its colours.
TEST(DocumentColours, spaces_are_what_they_are_defined_to_be)
{
    const test::TemporaryFolder folder;
    struct Case
    {
        const char* name;
        Imath::C3f given;
        double xyz[3];
    };
    // Columns of the matrices to XYZ of D65, from the chromaticities of ITU-R BT.709, SMPTE EG
    // 432-1, Adobe RGB (1998) and ACES S-2014-004 (by Bradford from its white), in double precision
    // with NumPy.
    const Case cases[] = {
        {"lin_rec709", {1, 0, 0}, {0.41239, 0.21264, 0.01933}},
        {"lin_rec709", {0, 1, 0}, {0.3576, 0.7152, 0.1192}},
        {"srgb_texture", {0, 0, 1}, {0.1805, 0.0722, 0.9505}},
        {"srgb_texture", {0.5f, 0, 0}, {0.4124 * 0.214041, 0.2126 * 0.214041, 0.0193 * 0.214041}},
        {"g22_rec709", {0, 0.5f, 0}, {0.3576 * 0.217638, 0.7152 * 0.217638, 0.1192 * 0.217638}},
        {"g18_rec709", {0, 0.5f, 0}, {0.3576 * 0.287175, 0.7152 * 0.287175, 0.1192 * 0.287175}},
        {"lin_displayp3", {1, 0, 0}, {0.48657, 0.22897, 0.0}},
        {"lin_adobergb", {0, 1, 0}, {0.18556, 0.62736, 0.07069}},
        {"acescg", {1, 0, 0}, {0.65224, 0.26767, -0.00538}},
        {"lin_ap1", {0, 0, 1}, {0.16998, 0.05799, 1.09307}},
    };
    for (const ColorConfig& config : configs(folder))
        for (const Case& c : cases)
        {
            const auto space = DocumentColor::named(config, c.name);
            ASSERT_TRUE(space) << c.name;
            const C3d xyz = to_xyz(C3d((*space)(c.given)), config);
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(xyz[k], c.xyz[k], 3e-4) << config.name() << ' ' << c.name << ' ' << k;
        }
    EXPECT_FALSE(DocumentColor::named(ColorConfig::builtin(), "technicolor"));
    for (const char* data : {"", "none", "raw", "data"})
        EXPECT_TRUE(DocumentColor::named(ColorConfig::builtin(), data)->is_identity());
}

TEST(DocumentColours, spaces_are_inherited_and_indices_have_none)
{
    const std::string schlick =
        "<generalized_schlick_bsdf name='m' type='BSDF'>"
        "<input name='color0' type='color3' value='0.5, 0.2, 0.1'%/>"
        "</generalized_schlick_bsdf>";
    const auto F0 = [&](const std::string& input, const std::string& root) {
        std::string text = schlick;
        text.replace(text.find('%'), 1, input);
        return std::get<SchlickSurface>(facets(surface_of(document(text, root))).surface).F0;
    };
    expect_color(F0("", ""), 0.5, 0.2, 0.1);
    const ColorD converted = F0(" colorspace='lin_rec709'", "");
    EXPECT_GT(std::abs(converted.x - 0.5), 0.01);
    EXPECT_EQ(F0("", "colorspace='lin_rec709'"), converted);
    expect_color(F0(" colorspace='lin_ap1'", "colorspace='srgb_texture'"), 0.5, 0.2, 0.1);

    const auto index = surface_of(document(
        "<conductor_bsdf name='m' type='BSDF'><input name='ior' type='color3' value='0.2, 0.9, "
        "1.1'/><input name='extinction' type='color3' value='3.9, 2.4, 2.2'/></conductor_bsdf>",
        "colorspace='srgb_texture'"));
    expect_color(std::get<ConductorSurface>(facets(index).surface).n, 0.2, 0.9, 1.1);
    expect_color(std::get<ConductorSurface>(facets(index).surface).k, 3.9, 2.4, 2.2);
}

TEST(DocumentColours, what_nobody_knows_or_no_one_can_show_is_noted)
{
    const auto notes_of = [](const std::string& root, const std::string& color,
                             const DocumentSettings& with) {
        std::vector<DocumentNote> notes;
        surface_of(document("<generalized_schlick_bsdf name='m' type='BSDF'><input name='color0' "
                            "type='color3' value='" +
                                color + "'/></generalized_schlick_bsdf>",
                            root),
                   &notes, with);
        return notes;
    };
    const auto unknown = notes_of("colorspace='technicolor'", "1, 1, 1", settings());
    ASSERT_EQ(unknown.size(), 1u);
    EXPECT_TRUE(says(unknown[0].text, "nobody knows the colour space 'technicolor'"));
    // The green of AP1 is outside Rec. 709, and what is within ACEScg is within.
    const test::TemporaryFolder folder;
    const DocumentSettings rec709(
        ColorConfig::from_file(folder.write("c.ocio", test::working_in("lin_rec709"))));
    const auto outside = notes_of("colorspace='acescg'", "0, 0.9, 0", rec709);
    ASSERT_EQ(outside.size(), 1u);
    EXPECT_TRUE(says(outside[0].text, "is outside the working space"));
    EXPECT_TRUE(notes_of("colorspace='acescg'", "0, 0.9, 0", settings()).empty());
    EXPECT_TRUE(notes_of("colorspace='lin_rec709'", "0, 0.9, 0", settings()).empty());
}

// The colour of a metal at 82 degrees, not what Schlick's curve is multiplied by there, is what is
// the same in every space.
TEST(DocumentColours, metals_look_the_same_at_every_angle)
{
    const test::TemporaryFolder folder;
    std::vector<DocumentNote> notes;
    for (const char* metal : {"Gold", "Copper", "Brass"})
    {
        std::vector<std::vector<Lab>> looks;
        for (const ColorConfig& config : configs(folder))
        {
            DocumentSettings with(config);
            const tools::TextureFiles pictures(config);
            with.textures = pictures.loader();
            const auto surface =
                MaterialDocument::read(
                    std::filesystem::path(REGAIN_DOCUMENTS) / "metals_textured.mtlx", with)
                    .surface(metal, notes);
            const auto& s = std::get<SchlickSurface>(facets(surface, 1).surface);
            looks.emplace_back();
            for (const double mu : {1.0, 0.8, 0.5, 0.3, 1.0 / 7, 0.07})
                looks.back().push_back(
                    lab_of_xyz_d65(to_xyz(SchlickFresnel<double>(s.F0, s.F82).at(mu), config)));
        }
        for (std::size_t c = 1; c < looks.size(); ++c)
            for (std::size_t i = 0; i < looks[c].size(); ++i)
                EXPECT_LT(ciede2000(looks[0][i], looks[c][i]), 1) << metal << ' ' << c << ' ' << i;
    }
}

}  // namespace
