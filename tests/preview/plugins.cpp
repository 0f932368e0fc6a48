// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Materials out of shared objects: the examples of both adapters lose no light that they should
// keep, and whatever is wrong with a file or a setting is said by its name.

#include "doubles.h"
#include "errors.h"
#include "preview/plugin_material.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace regain::tools::preview { namespace {

using namespace doubles;
using Settings = std::vector<std::string>;

float furnace(const char* file, const Settings& settings, int samples = 64)
{
    SphereWorld w(constant_image(1.0f), 16);
    w.world.max_bounces = 1000;
    PluginMaterial plugin = load_plugin(file, settings);
    std::vector<std::unique_ptr<BoundMaterial>> all;
    all.push_back(std::move(plugin.material));
    const RowIntegrator row(plugin.host, w.world, std::move(all));
    Film film(16, 16);
    EXPECT_TRUE(render({{{&row.get(), &film}}, samples, 1}));
    EXPECT_EQ(film.non_finite(), 0u);
    return mean(film).y;
}

TEST(Plugins, surface_is_white_where_its_parts_are)
{
    const auto with = [&](Settings more, int samples = 64) {
        more.push_back("base_color=1,1,1");
        return furnace(REGAIN_SURFACE, more, samples);
    };
    EXPECT_NEAR(with({}), 1, 5e-3f);
    EXPECT_NEAR(with({"coat=1", "coat_roughness=0.5", "specular_roughness=0.7"}), 1, 5e-3f);
    EXPECT_NEAR(with({"metalness=1", "specular_roughness=0.7"}), 1, 5e-3f);
    EXPECT_NEAR(with({"metalness=1", "specular_anisotropy=0.8"}), 1, 1e-2f);
    EXPECT_NEAR(with({"sheen=1", "coat=0.5", "metalness=0.3"}), 1, 5e-3f);
    EXPECT_NEAR(with({"transmission=1", "specular_roughness=0.7"}, 1024), 1, 5e-3f);
    EXPECT_NEAR(with({"coat=0.5", "metalness=0.5", "presence=0.5"}), 1, 5e-3f);
    // The switch does something.
    EXPECT_LT(with({"metalness=1", "compensation=0", "specular_roughness=1"}), 0.8f);
}

TEST(Plugins, car_paint_is_white_where_its_parts_are)
{
    const Settings white{"pigment=1,1,1", "flake_color=1,1,1"};
    const auto with = [&](Settings more) {
        more.insert(more.end(), white.begin(), white.end());
        return furnace(REGAIN_CAR_PAINT, more);
    };
    EXPECT_NEAR(with({}), 1, 5e-3f);
    EXPECT_NEAR(with({"flakes=1", "flake_tail=0.5", "coat_roughness=0.6"}), 1, 5e-3f);
    EXPECT_NEAR(with({"coat=0", "flakes=0", "opacity=0.5"}), 1, 5e-3f);
}

TEST(Plugins, brocade_is_white_where_its_parts_are)
{
    const Settings white{"cloth_color=1,1,1", "thread_color=1,1,1"};
    const auto with = [&](Settings more) {
        more.insert(more.end(), white.begin(), white.end());
        return furnace(REGAIN_BROCADE, more);
    };
    EXPECT_NEAR(with({}), 1, 5e-3f);
    EXPECT_NEAR(with({"threads=1", "nap=0", "thread_roughness=0.8"}), 1, 5e-3f);
    EXPECT_NEAR(with({"threads=0", "nap=1"}), 1, 5e-3f);
}

TEST(Plugins, say_what_they_are)
{
    const PluginMaterial surface = load_plugin(REGAIN_SURFACE, {}),
                         paint = load_plugin(REGAIN_CAR_PAINT, {});
    EXPECT_EQ(surface.name, "surface");
    EXPECT_EQ(surface.host, Host::renderman);
    EXPECT_EQ(paint.name, "car_paint");
    EXPECT_EQ(paint.host, Host::clarisse);
    const PluginMaterial brocade = load_plugin(REGAIN_BROCADE, {});
    EXPECT_EQ(brocade.name, "brocade");
    EXPECT_EQ(brocade.host, Host::osl);
    EXPECT_THROW(brocade.material->grid(), std::logic_error);
    EXPECT_THROW(surface.material->point(), std::logic_error);
    EXPECT_THROW(paint.material->osl(), std::logic_error);
}

void expect_refused(const std::string& file, const Settings& settings, const std::string& part)
{
    try
    {
        load_plugin(file, settings);
        FAIL() << file << " was taken";
    }
    catch (const BadInput& e)
    {
        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
        const std::string named = settings.empty() ? file : settings.back();
        EXPECT_NE(std::string(e.what()).find(named), std::string::npos) << e.what();
    }
}

TEST(Plugins, a_file_that_is_none_is_refused_by_name)
{
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir());
    expect_refused((folder / "no_such.so").string(), {}, "there is no such file");
    expect_refused(folder.string(), {}, "it is a folder");
    const std::string text = (folder / "plugin_text.so").string();
    std::ofstream(text) << "no shared object";
    expect_refused(text, {}, "cannot be loaded as a shared object");
    std::filesystem::remove(text);
    expect_refused(NO_PLUGIN, {}, "exports neither regain_bxdf_plugin nor regain_material_module");
    expect_refused(NULL_PLUGIN, {}, "one of its functions is null");
    expect_refused(OLD_PLUGIN, {}, "version 99 of the interface; this host knows 1");
}

TEST(Plugins, a_setting_that_is_none_is_refused_by_name)
{
    const auto refused = [](const Settings& s, const std::string& part) {
        expect_refused(REGAIN_SURFACE, s, part);
    };
    refused({"coat"}, "takes NAME=VALUE");
    refused({"coating=1"}, "no such parameter; there are base_color, base_roughness");
    refused({"coat=1.5"}, "coat takes a number in [0, 1]");
    refused({"coat=nan"}, "coat takes a number in [0, 1]");
    refused({"coat="}, "coat takes a number in [0, 1]");
    refused({"coat=1,1"}, "coat takes a number in [0, 1]");
    refused({"base_color=1,1"}, "base_color takes R,G,B, each in [0, 1]");
    refused({"base_color=1,1,1 "}, "base_color takes R,G,B, each in [0, 1]");
    refused({"coat=1", "coat=0.5"}, "coat is set twice");
}

}}  // namespace regain::tools::preview
