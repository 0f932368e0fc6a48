// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Plans by a price list that is made up, so that what has to be chosen is known.

#include "../support/price_list.h"
#include "documents.h"

#include <regain/shaders/planner.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace regain;
using namespace regain::shaders;
using namespace regain::tests;
using Imath::V4f;

namespace {

const MethodCosts& prices()
{
    static const MethodCosts costs = MethodCosts::parse(price_list());
    return costs;
}

MicrofacetMaterial metal(double alpha, const ColorD& F0 = ColorD(1.0))
{
    MicrofacetMaterial m;
    m.surface = SchlickSurface{F0};
    m.alpha_x = m.alpha_y = alpha;
    return m;
}
MicrofacetMaterial glass(double alpha, double eta = 1.5, ScatterMode mode = ScatterMode::RT)
{
    MicrofacetMaterial m;
    m.surface = InterfaceSurface{eta, mode};
    m.alpha_x = m.alpha_y = alpha;
    return m;
}

MaterialPlan planned(const VaryingTree& surface, double tolerance,
                     const MethodCosts& costs = prices())
{
    return plan_scene({{"m", surface}}, {tolerance, &costs}).materials.at(0);
}
MaterialPlan planned(const ClosureTree::Material& m, double tolerance)
{
    VaryingTree surface;
    surface.tree = ClosureTree(m);
    return planned(surface, tolerance);
}
std::string method_of(const MaterialPlan& plan, std::size_t k = 0)
{
    return plan.lobes.at(k).method;
}

TEST(Plans, the_cheapest_method_within_the_tolerance_is_chosen)
{
    const auto rough = metal(1);
    EXPECT_EQ(method_of(planned(rough, 1)), "none");
    EXPECT_EQ(method_of(planned(rough, 0.1)), "turquin");
    EXPECT_EQ(method_of(planned(rough, 0.02)), "balanced");
    EXPECT_EQ(method_of(planned(rough, 0.005)), "directional");
    EXPECT_EQ(method_of(planned(rough, 0.001)), "walk");
    const auto plan = planned(rough, 0.02);
    EXPECT_TRUE(plan.is_known && plan.is_within);
    EXPECT_GE(plan.error, 0.01);
    EXPECT_LE(plan.error, 0.02);
    EXPECT_DOUBLE_EQ(plan.price(), 3.8);
    EXPECT_TRUE(plan.called_for.multiple_scattering);
    EXPECT_FALSE(plan.called_for.tint);
    // What is bound is what was chosen.
    EXPECT_EQ(name(facets(plan.surface).method), std::string("balanced"));
    EXPECT_TRUE(facets(plan.surface).tables().balance);
}

TEST(Plans, of_less_reflectance_and_less_width_less_is_asked)
{
    EXPECT_EQ(method_of(planned(metal(1, ColorD(0.04)), 0.1)), "none");
    EXPECT_EQ(method_of(planned(metal(0.1), 0.01)), "none");
    // Below what was measured errors fall with the square: 6 (1 / 10)^2 of those at 0.05.
    const auto smooth = planned(metal(0.005), 1);
    EXPECT_NEAR(smooth.error, 0.06 * 0.6 * 0.05 * 0.05, 1e-5);
    EXPECT_EQ(planned(metal(0), 0).error, 0);
    EXPECT_EQ(method_of(planned(metal(0), 0)), "none");
    // A channel alone can call for more.
    EXPECT_EQ(method_of(planned(metal(1, ColorD(0.04, 0.04, 1)), 0.1)), "turquin");
}

TEST(Plans, a_colour_of_its_own_costs_accuracy)
{
    MicrofacetMaterial m = metal(1);
    m.surface = ConductorSurface{ColorD(0.2, 0.4, 1.4), ColorD(3.4, 2.3, 1.8)};
    EXPECT_EQ(method_of(planned(metal(1, ColorD(0.95)), 0.015)), "balanced");
    const auto plan = planned(m, 0.015);
    EXPECT_EQ(method_of(plan), "directional");
    EXPECT_TRUE(plan.called_for.tint);
    EXPECT_GT(*plan.lobes[0].error_without, 0.015);
}

TEST(Plans, at_a_tolerance_of_0_a_plan_is_the_reference)
{
    EXPECT_EQ(method_of(planned(metal(0.5), 0)), "walk");
    const auto clear = planned(glass(0.5), 0);
    EXPECT_EQ(method_of(clear), "walk");
    EXPECT_EQ(clear.error, 0);
    EXPECT_TRUE(clear.is_within);
    // A coat does not walk.
    const auto coat = planned(glass(0.5, 1.5, ScatterMode::R), 0);
    EXPECT_EQ(method_of(coat), "tail");
    EXPECT_FALSE(coat.is_within);
    EXPECT_TRUE(coat.is_known);
}

TEST(Plans, glass_is_seen_from_both_sides_and_gets_the_shadowing_that_was_measured)
{
    const auto plan = planned(glass(0.5), 0.01);
    EXPECT_EQ(method_of(plan), "tail");
    EXPECT_TRUE(plan.called_for.transmission && plan.called_for.inside);
    EXPECT_EQ(std::get<InterfaceSurface>(facets(plan.surface).surface).shadowing,
              TransmissionShadowing::beta);
    ASSERT_EQ(plan.notes.size(), 1u);
    EXPECT_TRUE(says(plan.notes[0], "beta"));
    EXPECT_FALSE(plan.tables.empty());
    // The same interface from its other side.
    EXPECT_DOUBLE_EQ(planned(glass(0.5, 1 / 1.5), 0.01).error, plan.error);
}

TEST(Plans, what_was_not_measured_is_kept_and_said)
{
    MicrofacetMaterial sheet = glass(0.3);
    std::get<InterfaceSurface>(sheet.surface).thin_walled = true;
    MicrofacetMaterial tail = metal(0.3);
    tail.distribution = DistributionKind::gtr;
    tail.gamma = 1.1;
    for (const auto& [m, why] : {std::pair{sheet, "thin walls"},
                                 {glass(0.3, 1.5, ScatterMode::T), "transmission alone"},
                                 {glass(0.3, 1.02), "near 1"},
                                 {tail, "gamma below 1.5"}})
    {
        const auto plan = planned(m, 0.01);
        EXPECT_FALSE(plan.is_known) << why;
        EXPECT_FALSE(plan.is_within) << why;
        EXPECT_FALSE(plan.lobes[0].error) << why;
        EXPECT_TRUE(says(plan.lobes[0].why, why)) << plan.lobes[0].why;
    }
    // But what is flat loses nothing.
    sheet.alpha_x = sheet.alpha_y = 0;
    EXPECT_EQ(method_of(planned(sheet, 0)), "none");
    EXPECT_TRUE(planned(sheet, 0).is_known && planned(sheet, 0).is_within);
    // Without any numbers everything is.
    const MethodCosts nothing;
    VaryingTree surface;
    surface.tree = ClosureTree(metal(0.5));
    const auto scene = plan_scene({{"m", surface}}, {0.01, &nothing});
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_EQ(method_of(scene.materials[0]), "directional");
}

TEST(Plans, tails_between_measured_ones_are_as_bad_as_the_worse)
{
    MicrofacetMaterial m = metal(1);
    m.distribution = DistributionKind::gtr;
    m.gamma = 2;
    EXPECT_EQ(planned(m, 0.1).lobes[0].distribution, "ggx");
    m.gamma = 1.7;
    const auto plan = planned(m, 0.1);
    EXPECT_EQ(plan.lobes[0].distribution, "gtr");
    EXPECT_EQ(method_of(plan), "turquin");
    EXPECT_TRUE(plan.called_for.tail);
}

TEST(Plans, closures_of_no_weight_are_left_out)
{
    VaryingTree surface;
    ClosureTree& t = surface.tree;
    const auto black = t.lobe(PlainMaterial{OrenNayarSurface{ColorD(0.0)}}),
               gold = t.lobe(metal(0.5));
    t.set_root(t.layer(t.multiply(t.lobe(glass(0.3, 1.5, ScatterMode::R)), ColorD(0.0)),
                       t.add(black, gold)));
    const auto plan = planned(surface, 0.01);
    ASSERT_EQ(plan.surface.lobes(), 1);
    EXPECT_EQ(plan.surface.tree.node_of(0), gold);
    ASSERT_EQ(plan.lobes.size(), 3u);
    EXPECT_EQ(std::count_if(plan.lobes.begin(), plan.lobes.end(),
                            [](const PlannedLobe& l) { return l.left_out; }),
              2);
    EXPECT_FALSE(plan.called_for.layering);
}

TEST(Plans, several_closures_share_a_tolerance)
{
    VaryingTree surface;
    ClosureTree& t = surface.tree;
    t.set_root(t.mix(t.lobe(metal(1)), t.lobe(metal(1)), 0.9));
    // Alone, turquin errs by 0.06: of nine tenths by 0.054, of one by 0.006.
    const auto both = planned(surface, 0.061);
    EXPECT_EQ(method_of(both, 0), "turquin");
    EXPECT_EQ(method_of(both, 1), "turquin");
    // Something has to be better, and then the other may be worse.
    const auto one = planned(surface, 0.05);
    EXPECT_EQ(method_of(one, 0), "directional");
    EXPECT_EQ(method_of(one, 1), "turquin");
    const auto loose = planned(surface, 0.12);
    EXPECT_EQ(method_of(loose, 0), "turquin");
    EXPECT_EQ(method_of(loose, 1), "none");
    for (const auto* p : {&both, &one, &loose}) EXPECT_TRUE(p->is_within);
    // Methods that know their albedo by an integral alone are not for trees.
    for (const double tolerance : {0.02, 0.01, 0.003, 0.001})
        for (const PlannedLobe& l : planned(surface, tolerance).lobes)
            EXPECT_TRUE(l.method != "walk" && l.method != "balanced") << tolerance;
}

TEST(Plans, what_is_on_top_has_the_error_of_a_coat)
{
    VaryingTree surface;
    ClosureTree& t = surface.tree;
    t.set_root(t.layer(t.lobe(glass(1, 1.5, ScatterMode::R)),
                       t.lobe(PlainMaterial{OrenNayarSurface{ColorD(0.5)}})));
    // The base of measured plastic hides half of it.
    const auto plan = planned(surface, 0.1);
    EXPECT_EQ(method_of(plan), "none");
    EXPECT_NEAR(plan.error, 0.04, 1e-3);
    EXPECT_EQ(method_of(planned(surface, 0.03)), "turquin");
    EXPECT_TRUE(plan.called_for.layering);
    EXPECT_EQ(plan.lobes[1].error, 0);
}

// Metal of alpha = 0.05 + scale times the first component of `along`.
VaryingTree varying(double scale, Value (ValueProgram::*along)() = &ValueProgram::texcoord)
{
    VaryingTree surface;
    auto& p = surface.program;
    const Value u = p.apply(ValueOp::lane, {(p.*along)(), Value(0.0f)}, 1);
    const Value alpha = p.apply(
        ValueOp::add, {p.apply(ValueOp::multiply, {u, Value(float(scale))}, 1), Value(0.05f)}, 1);
    const auto lobe = surface.tree.lobe(metal(0.05));
    surface.vary(lobe, MaterialNumber::alpha, alpha);
    surface.tree.set_root(lobe);
    return surface;
}

TEST(Plans, numbers_that_vary_are_planned_over_their_range)
{
    EXPECT_EQ(method_of(planned(varying(0), 0.02)), "none");
    EXPECT_EQ(method_of(planned(varying(0.95), 0.02)), "balanced");
    EXPECT_NEAR(*planned(varying(0.95), 0.02).lobes[0].error, planned(metal(0.99), 0.02).error,
                3e-4);

    // Widths that are the same wherever they vary need no tables of two, whatever a document that
    // may have two of them begins with.
    VaryingTree two = varying(0.95);
    MicrofacetMaterial m = metal(0.05);
    m.alpha_y = 0.06;
    two.tree.set_material(two.tree.root(), m);
    EXPECT_EQ(planned(two, 0.02).tables.size(), planned(varying(0.95), 0.02).tables.size());

    // A weight that is 0 nowhere is not left out; one that is 0 everywhere is.
    for (const float most : {0.0f, 1.0f})
    {
        VaryingTree surface;
        auto& p = surface.program;
        const Value u = p.apply(ValueOp::lane, {p.texcoord(), Value(0.0f)}, 1);
        const Value w = p.apply(ValueOp::minimum, {u, Value(most)}, 1);
        surface.tree.set_root(surface.tree.add(
            surface.tree.multiply(surface.tree.lobe(metal(1)), surface.parameter(w)),
            surface.tree.lobe(PlainMaterial{OrenNayarSurface{}})));
        EXPECT_EQ(planned(surface, 0.1).lobes[0].left_out, most == 0);
    }
}

TEST(Plans, tiles_are_kept_where_they_pay)
{
    const auto plan = planned(varying(0.95), 0.03);
    const PlannedTiles& tiles = plan.tiles;
    ASSERT_EQ(tiles.across, 8);
    EXPECT_LE(plan.price(), 0.95 * tiles.price_of_one);
    EXPECT_TRUE(plan.is_within);
    // What is smooth is not compensated, what is rough is; v changes nothing.
    ASSERT_EQ(tiles.choice_of.size(), 64u);
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(tiles.choice_of[i], tiles.choice_of[i % 8]);
    EXPECT_EQ(tiles.choices[tiles.choice_of[0]], std::vector<std::string>{"none"});
    EXPECT_EQ(tiles.choices[tiles.choice_of[3]], std::vector<std::string>{"turquin"});
    EXPECT_EQ(tiles.choices[tiles.choice_of[7]], std::vector<std::string>{"balanced"});
    std::size_t all = 0;
    for (std::size_t i = 0; i < tiles.choices.size(); ++i) all += tiles.count(i);
    EXPECT_EQ(all, 64u);

    // Shaded, each place has its tile's method, and its own width; beyond the square
    // what goes everywhere.
    const auto at = [&](float u, float v) {
        V4f values[VaryingTree::most_values];
        plan.surface.values_at({{u, v}}, values);
        return std::get<MicrofacetMaterial>(plan.surface.material(0, values));
    };
    for (int i = 0; i < 8; ++i)
        for (const float v : {0.0f, 0.49f, std::nextafter(1.0f, 0.0f)})
        {
            const float u = (float(i) + 0.3f) / 8;
            const auto m = at(u, v);
            EXPECT_EQ(std::vector<std::string>{std::string(name(m.method))},
                      tiles.choices[tiles.choice_of[std::size_t(i)]]);
            EXPECT_NEAR(m.alpha_x, 0.05 + 0.95 * double(u), 1e-6);
        }
    for (const float u : {-0.1f, 1.0f, 2.5f}) EXPECT_EQ(name(at(u, 0.5f).method), "balanced") << u;

    // Not where all tiles want the same, what varies is not known by texture coordinates, or the
    // plan is the reference.
    EXPECT_EQ(planned(varying(0.01), 0.03).tiles.across, 0);
    EXPECT_EQ(planned(varying(0.95, &ValueProgram::position), 0.03).tiles.across, 0);
    EXPECT_EQ(planned(varying(0.95), 0).tiles.across, 0);
}

TEST(Plans, tiles_that_are_none_are_refused)
{
    VaryingTree surface = varying(0.95);
    const ClosureTree one = surface.tree;
    ClosureTree two = one;
    two.set_root(two.add(two.root(), two.lobe(metal(1))));
    EXPECT_THROW(surface.set_tiles(0, {}, {one}), std::invalid_argument);
    EXPECT_THROW(surface.set_tiles(2, {0, 0, 0}, {one}), std::invalid_argument);
    EXPECT_THROW(surface.set_tiles(1, {1}, {one}), std::invalid_argument);
    EXPECT_THROW(surface.set_tiles(1, {0}, {two}), std::invalid_argument);
    EXPECT_TRUE(surface.trees_of_tiles().empty());
    surface.set_tiles(1, {0}, {one});
    EXPECT_EQ(surface.trees_of_tiles().size(), 1u);
    // No number is 0.
    V4f values[VaryingTree::most_values];
    surface.values_at({{std::nanf(""), std::nanf("")}}, values);
    EXPECT_NEAR(std::get<MicrofacetMaterial>(surface.material(0, values)).alpha_x, 0.05, 1e-6);
}

TEST(Plans, the_error_of_tiles_is_that_of_their_widths)
{
    // Every tile keeps what was promised, also between the places that were looked at.
    const auto plan = planned(varying(0.95), 0.03);
    ASSERT_EQ(plan.tiles.across, 8);
    double worst = 0;
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k <= 100; ++k)
        {
            MicrofacetMaterial m = metal(0.05 + 0.95 * (i + 0.01 * k) / 8);
            const std::string method = plan.tiles.choices[plan.tiles.choice_of[std::size_t(i)]][0];
            // The error of that method alone, at any tolerance that lets it pass.
            for (const double tolerance : {1.0, 0.1, 0.05, 0.02, 0.015, 0.01, 0.005})
            {
                const auto alone = planned(m, tolerance);
                if (method_of(alone) == method) worst = std::max(worst, alone.error);
            }
        }
    EXPECT_GT(worst, 0);
    EXPECT_LE(worst, 1.001 * plan.error);
}

TEST(Plans, two_widths_count_as_the_worse)
{
    MicrofacetMaterial m = metal(1);
    m.alpha_y = 0.05;
    const auto plan = planned(m, 0.1);
    EXPECT_EQ(method_of(plan), "turquin");
    EXPECT_TRUE(plan.called_for.anisotropy);
    EXPECT_GT(plan.error, planned(metal(1), 0.1).error);
    EXPECT_TRUE(std::any_of(plan.tables.begin(), plan.tables.end(), [](const PlannedTable& t) {
        return t.name == "ggx_anisotropy" && t.bytes > 0 && !t.compiled_in;
    }));
}

TEST(Plans, a_scene_counts_each_table_once)
{
    std::vector<NamedMaterial> scene;
    for (const double alpha : {0.4, 0.6})
    {
        VaryingTree surface;
        surface.tree = ClosureTree(glass(alpha));
        scene.push_back({"glass", surface});
    }
    const auto plan = plan_scene(scene, {0.02, &prices()});
    EXPECT_FALSE(plan.tables.empty());
    EXPECT_EQ(plan.tables.size(), plan.materials[0].tables.size());
    std::size_t bytes = 0;
    for (const PlannedTable& t : plan.tables) bytes += t.bytes;
    EXPECT_EQ(plan.loaded_bytes() + plan.compiled_in_bytes(), bytes);
}

TEST(Plans, a_renderer_asks_as_the_page_about_them_shows)
{
    VaryingTree car, floor;
    car.tree = ClosureTree(metal(0.5));
    floor.tree = ClosureTree(PlainMaterial{OrenNayarSurface{}});
    std::vector<int> used;
    const auto use = [&](const VaryingTree& surface) { used.push_back(surface.lobes()); };
    // clang-format off
const shaders::ScenePlan plan = shaders::plan_scene({{"car", car}, {"floor", floor}}, {0.01});
for (const shaders::MaterialPlan& m : plan.materials) use(m.surface);  // tables are bound
    // clang-format on
    EXPECT_EQ(used, std::vector<int>(2, 1));

    const auto text_of = [](const char* file) {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    };
    const std::string page = text_of(REGAIN_DOCS "/planner.md"), source = text_of(REGAIN_PLANS);
    const std::string fence = "```cpp\n";
    const auto from = page.find(fence) + fence.size(), to = page.find("```", from);
    ASSERT_NE(to, page.npos);
    EXPECT_NE(source.find(page.substr(from, to - from)), source.npos);
}

TEST(Plans, wrong_numbers_are_refused)
{
    VaryingTree surface;
    surface.tree = ClosureTree(metal(0.5));
    for (const double wrong : {-0.1, 1.1, std::nan("")})
        EXPECT_THROW(plan_scene({{"m", surface}}, {wrong, &prices()}), std::invalid_argument);
    const auto complaint = [](std::string text, const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
        try
        {
            MethodCosts::parse(text);
        }
        catch (const std::runtime_error& e)
        {
            return std::string(e.what());
        }
        return std::string();
    };
    const std::string good = price_list();
    EXPECT_TRUE(says(complaint(good, "\"schema\":1", "\"schema\":2"), "accepted: 1"));
    EXPECT_TRUE(says(complaint(good, "\"beta\"", "\"correlated\""), "beta"));
    EXPECT_TRUE(says(complaint(good, "\"metal\"", "\"cheese\""), "cheese"));
    EXPECT_TRUE(says(complaint(good, "\"eval\":[1,", "\"eval\":[-1,"), "number"));
    EXPECT_TRUE(says(complaint(good, "\"eval\":[1,", "\"eval\":["), "widths"));
    EXPECT_TRUE(says(complaint(good, "[0.05,", "[0.5,"), "rising"));
    EXPECT_FALSE(complaint(good, "{", "").empty());
    EXPECT_TRUE(complaint(good, "{", " {").empty());
}

}  // namespace
