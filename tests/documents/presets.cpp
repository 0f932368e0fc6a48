// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The presets: how many, that each is a material that could be, and that metals are those of the
// spectra they name.

#include "documents.h"
#include "preset_check.h"

#include "../colour/configs.h"
#include "../support/color_difference.h"
#include "../support/temporary_folder.h"
#include "../support/working_space.h"

#include <regain/closures/conductor_fresnel.h>
#include <regain/shaders/metals.h>
#include <regain/shaders/presets.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>

using namespace regain;
using namespace regain::shaders;
using namespace regain::tests;

namespace {

TEST(Presets, there_are_many_of_every_kind)
{
    const auto names = preset_names();
    EXPECT_GE(names.size(), 40u);
    std::map<std::string, int> kinds;
    for (const std::string& name : names)
    {
        const auto d = MaterialDocument::read(preset_file(name), settings());
        ++kinds[d.attribute(d.materials().at(0), "kind")];
        EXPECT_GE(d.materials().size(), 2u) << name << ": a roughness variant";
    }
    EXPECT_GE(kinds["metal"], 20);
    for (const char* kind :
         {"glass", "liquid", "gem", "plastic", "lacquer", "car paint", "ceramic", "fabric"})
        EXPECT_GE(kinds[kind], 3) << kind;
    EXPECT_EQ(kinds.size(), 9u);
}

TEST(Presets, each_is_a_material_that_could_be)
{
    for (const std::string& name : preset_names())
        for (const std::string& fault : tools::preset_faults(name, settings()))
            ADD_FAILURE() << name << ": " << fault;
}

TEST(Presets, faults_are_found)
{
    const test::TemporaryFolder folder;
    ::setenv("REGAIN_PRESETS", folder.path().c_str(), 1);
    const auto faults = [&](const std::string& elements) {
        folder.write("gold.mtlx", document(elements));
        std::string all;
        for (const auto& f : tools::preset_faults("gold", settings())) all += f + "\n";
        return all;
    };
    const std::string words = " doc='a' kind='metal' source='b'";
    const auto metal = [&](const std::string& F0, const std::string& attributes) {
        return "<generalized_schlick_bsdf name='m' type='BSDF'><input name='color0' type='color3' "
               "value='" +
               F0 +
               "'/></generalized_schlick_bsdf><surface name='s' type='surfaceshader'><input "
               "name='bsdf' type='BSDF' nodename='m'/></surface><surfacematerial name='x' "
               "type='material'" +
               attributes +
               "><input name='surfaceshader' type='surfaceshader' nodename='s'/></surfacematerial>";
    };
    EXPECT_EQ(faults(metal("0.9, 0.7, 0.3", words)), "");
    EXPECT_TRUE(says(faults(metal("0.9, 0.7, 0.3", " kind='metal' source='b'")), "no 'doc'"));
    EXPECT_TRUE(says(faults(metal("0.9, 0.7, 0.05", words)), "outside [0.15, 1]"));
    EXPECT_TRUE(says(faults(metal("1.2, 0.7, 0.5", words)), "outside [0.15, 1]"));
    EXPECT_TRUE(says(faults("<open_pbr_surface name='s' type='surfaceshader'><input "
                            "name='specular_ior' type='float' value='0.5'/></open_pbr_surface>"),
                     "index of 0.5"));
    // Twice the same on top of each other.
    EXPECT_TRUE(says(faults("<oren_nayar_diffuse_bsdf name='d' type='BSDF'><input name='color' "
                            "type='color3' value='1, 1, 1'/></oren_nayar_diffuse_bsdf><add "
                            "name='a' type='BSDF'><input name='in1' type='BSDF' nodename='d'/>"
                            "<input name='in2' type='BSDF' nodename='d'/></add><surface name='s' "
                            "type='surfaceshader'><input name='bsdf' type='BSDF' nodename='a'/>"
                            "</surface><surfacematerial name='x' type='material' doc='a' kind='b' "
                            "source='c'><input name='surfaceshader' type='surfaceshader' "
                            "nodename='s'/></surfacematerial>"),
                     "gives back"));
    EXPECT_TRUE(says(faults("<standard_surface name='s' type='surfaceshader'><input "
                            "name='emission' type='float' value='1'/></standard_surface>"),
                     "emission"));
    EXPECT_TRUE(says(faults("<broken"), "no XML"));
    ::unsetenv("REGAIN_PRESETS");
    EXPECT_THROW(preset_file("mithril"), DocumentError);
}

// Whatever the working space is.
TEST(Presets, metals_are_those_of_their_spectra)
{
    const test::TemporaryFolder folder;
    const ColorConfig configs[] = {
        ColorConfig::builtin(),
        ColorConfig::from_file(folder.write("a.ocio", test::working_in("ACEScg"))),
        ColorConfig::from_file(folder.write("b.ocio", test::working_in("lin_rec709")))};
    for (const ColorConfig& config : configs)
    {
        const Imath::M33d to_working = to_working_space(config);
        const auto lab = [&](const C3d& c) {
            return lab_of_xyz_d65(times_column(to_working.inverse(), c));
        };
        for (const std::string& name : metal_names())
        {
            std::vector<DocumentNote> notes;
            const auto d = MaterialDocument::read(preset_file(name), DocumentSettings(config));
            const auto surface = d.surface(d.materials().at(0), notes);
            const auto& s = std::get<ConductorSurface>(facets(surface).surface);
            const ConductorFresnel<double> fresnel(s.n, s.k);
            for (const double mu : {1.0, 0.7, 0.5, 0.26, 0.14, 0.05})
                EXPECT_LT(ciede2000(lab(metal_reflectance(name, mu, config)), lab(fresnel.at(mu))),
                          0.95)
                    << name << ' ' << mu << " in " << config.scene_linear();
        }
    }
}

// For programs that do not know the spectra: the index in linear Rec. 709 is in the document.
TEST(Presets, metals_say_their_index_for_others)
{
    const test::TemporaryFolder folder;
    const auto rec709 =
        ColorConfig::from_file(folder.write("b.ocio", test::working_in("lin_rec709")));
    for (const std::string& name : metal_names())
    {
        std::ifstream in(preset_file(name));
        std::string text((std::istreambuf_iterator<char>(in)), {});
        for (std::size_t at; (at = text.find("<input name=\"metal\"")) != std::string::npos;)
            text.erase(at, text.find("/>", at) + 2 - at);
        const auto s = surface_of(text);
        const auto& index = std::get<ConductorSurface>(facets(s).surface);
        const MetalIndex fitted = metal_index(name, rec709);
        for (int c = 0; c < 3; ++c)
        {
            EXPECT_NEAR(index.n[c], fitted.n[c], 1e-3 * (1 + fitted.n[c])) << name;
            EXPECT_NEAR(index.k[c], fitted.k[c], 1e-3 * (1 + fitted.k[c])) << name;
        }
    }
}

}  // namespace
