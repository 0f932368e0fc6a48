// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A folder of documents as people write them: each is read whole, with tables for every closure,
// and what is not shown as it says is said.

#include "documents.h"
#include "texture_file.h"

#include <algorithm>
#include <filesystem>
#include <map>

using namespace regain;
using namespace regain::shaders;
using namespace regain::tests;

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> documents_of_folder()
{
    std::vector<fs::path> files;
    for (const auto& file : fs::directory_iterator(REGAIN_DOCUMENTS))
        if (file.path().extension() == ".mtlx") files.push_back(file.path());
    std::sort(files.begin(), files.end());
    return files;
}

// Words of what is noted, by document; of all others nothing is.
const std::map<std::string, std::vector<std::string>> expected_notes = {
    {"gltf_boombox", {"emission"}},
    {"maps_and_displacement", {"normal maps", "displacement", "surface_unlit"}},
    {"open_pbr_honey", {"absorption inside"}},
    {"open_pbr_leaf", {"subsurface scattering of a sheet"}},
    {"open_pbr_pearl", {"thin films", "subsurface"}},
    {"pbrlib_volume", {"volumes"}},
    {"procedural_marble", {"fractal3d", "subsurface"}},
    {"standard_brushed", {"rotation"}},
    {"standard_glass_tinted", {"absorption inside", "as rough as reflection"}},
    {"standard_jade", {"subsurface"}},
    {"standard_lamp", {"emission"}},
    {"standard_soap_bubble", {"thin films"}}};

TEST(DocumentFolder, every_document_is_read)
{
    const auto files = documents_of_folder();
    EXPECT_GE(files.size(), 30u);
    const tools::TextureFiles pictures(ColorConfig::builtin());
    DocumentSettings with = settings();
    with.textures = pictures.loader();
    std::size_t materials = 0, varying = 0;
    for (const fs::path& file : files)
    {
        SCOPED_TRACE(file.filename());
        std::vector<DocumentNote> notes;
        const auto document = MaterialDocument::read(file, with);
        EXPECT_FALSE(document.materials().empty());
        for (const std::string& name : document.materials())
        {
            VaryingTree surface = document.surface(name, notes);
            EXPECT_GE(surface.lobes(), 1) << name;
            EXPECT_NO_THROW(surface.tree.bind_tables(true)) << name;
            ++materials;
            varying += surface.varies();
        }
        const auto expected = expected_notes.find(file.stem().string());
        const std::size_t count = expected == expected_notes.end() ? 0 : expected->second.size();
        EXPECT_EQ(notes.size(), count);
        for (std::size_t i = 0; i < std::min(count, notes.size()); ++i)
        {
            EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [&](const DocumentNote& n) {
                return says(n.message(), expected->second[i]);
            })) << expected->second[i];
            EXPECT_GT(notes[i].line, 3);
            EXPECT_FALSE(notes[i].node.empty());
        }
    }
    EXPECT_GE(materials, 55u);
    EXPECT_GE(varying, 9u);
}

TEST(DocumentFolder, a_picture_that_is_not_there_is_an_error)
{
    const tools::TextureFiles pictures(ColorConfig::builtin());
    DocumentSettings with = settings();
    with.textures = pictures.loader();
    const std::string message = error_of(
        document("<image name='i' type='color3'><input name='file' type='filename' "
                 "value='no/such.png'/></image><oren_nayar_diffuse_bsdf name='d' type='BSDF'>"
                 "<input name='color' type='color3' nodename='i'/></oren_nayar_diffuse_bsdf>"),
        with);
    EXPECT_TRUE(says(message, "test.mtlx:3: i: cannot read the picture") &&
                says(message, "no/such.png"))
        << message;
    // Nor one that is no picture.
    EXPECT_THROW(pictures.loader()(fs::path(REGAIN_DOCUMENTS) / "chess_set.mtlx", ""),
                 std::runtime_error);
}

// Of a picture of UsdUVTexture, scaled and shifted, and by the default where there is none.
TEST(DocumentFolder, usd_pictures_are_scaled)
{
    const auto color = [](const std::string& inputs) {
        const tools::TextureFiles pictures(ColorConfig::builtin());
        DocumentSettings with = settings();
        with.textures = pictures.loader();
        const auto surface = surface_of(
            document("<UsdUVTexture name='t' type='multioutput'><input name='file' type='filename' "
                     "value='" +
                     std::string(REGAIN_DOCUMENTS) + "/textures/wood_roughness.png'/>" + inputs +
                     "</UsdUVTexture><oren_nayar_diffuse_bsdf name='d' type='BSDF'><input "
                     "name='color' type='color3' nodename='t' output='rgb'/>"
                     "</oren_nayar_diffuse_bsdf>"),
            nullptr, with);
        Imath::V4f values[VaryingTree::most_values];
        SurfacePoint point;
        point.uv = {0.3f, 0.6f};
        surface.values_at(point, values);
        return std::get<OrenNayarSurface>(
                   std::get<PlainMaterial>(surface.material(0, values)).surface)
            .color;
    };
    const ColorD plain = color("");
    EXPECT_GT(plain.x, 0.1);
    const ColorD other = color(
        "<input name='scale' type='vector4' value='0.5, 0.25, 1, 1'/>"
        "<input name='bias' type='vector4' value='0, 0.1, 0, 0'/>");
    expect_color(other, 0.5 * plain.x, 0.25 * plain.y + 0.1, plain.z, 1e-5);
}

TEST(DocumentFolder, libraries_are_included_under_their_names)
{
    std::vector<DocumentNote> notes;
    const auto d =
        MaterialDocument::read(fs::path(REGAIN_DOCUMENTS) / "includes_library.mtlx", settings());
    EXPECT_EQ(d.materials(), (std::vector<std::string>{"LibraryGold", "Reused"}));
    const auto a = d.surface("LibraryGold", notes), b = d.surface("Reused", notes);
    expect_color(std::get<ConductorSurface>(facets(a).surface).n,
                 std::get<ConductorSurface>(facets(b).surface).n.x,
                 std::get<ConductorSurface>(facets(b).surface).n.y,
                 std::get<ConductorSurface>(facets(b).surface).n.z);
}

}  // namespace
