// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Queries about every closure there is: distributions, dielectrics, walks, added lobes.

#include "query_answer.h"

#include <regain/luts/dielectric_integral.h>
#include <regain/shaders/microfacet_material.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace regain;
using namespace regain::tools;
using nlohmann::json;

namespace {

json ask(const json& query)
{
    fmt::memory_buffer out;
    answer_line(query.dump(), out);
    return json::parse(fmt::to_string(out));
}
json answer(const json& query)
{
    json a = ask(query);
    EXPECT_FALSE(a.contains("error")) << query << a;
    return a;
}

double red(const json& color) { return color.at(0).get<double>(); }
double total(const json& albedo) { return red(albedo["reflect"]) + red(albedo["transmit"]); }

json with(json query, const json& changes)
{
    query.update(changes);
    return query;
}

const json glass{{"closure", "dielectric"}, {"alpha", 0.4}, {"precision", "double"}};
const json white{{"closure", "conductor"},
                 {"alpha", 0.6},
                 {"precision", "double"},
                 {"fresnel", {{"constant", {1, 1, 1}}}}};

}  // namespace

// Whatever is asked for is answered in numbers, or refused by name.
TEST(query_closures, every_combination_is_answered_or_refused_by_name)
{
    int answered = 0;
    for (const char* closure : {"conductor", "generalized_schlick", "dielectric", "sheen"})
        for (const char* distribution : {"ggx", "beckmann", "gtr", "std"})
            for (const std::string_view method : shaders::compensation_names())
                for (const char* precision : {"float", "double"})
                {
                    json q{{"closure", closure}, {"method", method}, {"precision", precision}};
                    if (closure != std::string("sheen"))
                        q.update({{"distribution", distribution}, {"alpha", {0.3, 0.6}}});
                    const json eval =
                        ask(with(q, {{"op", "eval"}, {"mu", 0.7}, {"wi", {0.28, 0, 0.96}}}));
                    const json samples = ask(with(q, {{"op", "sample"}, {"mu", 0.3}, {"n", 5}}));
                    if (!eval.contains("error"))
                    {
                        ++answered;
                        EXPECT_GE(red(eval["value"]), 0) << q;
                        EXPECT_EQ(samples["samples"].size(), 5u) << q << samples;
                        continue;
                    }
                    const std::string why = eval["error"];
                    EXPECT_EQ(samples["error"], why);
                    EXPECT_TRUE(why.find("does not go with") != std::string::npos ||
                                why.find("table") != std::string::npos)
                        << why;
                }
    // Each distribution at least without compensation and by its walk, of three lobes, and sheen.
    EXPECT_GE(answered, 2 * (4 * 3 * 2 + 4));
}

// The parts, put together by hand.
TEST(query_closures, combinations_are_what_their_parts_make)
{
    const json metal{{"closure", "generalized_schlick"},
                     {"alpha", 0.4},
                     {"method", "turquin"},
                     {"color0", {0.9, 0.5, 0.1}}};
    const json chalk{{"closure", "oren_nayar_diffuse"}, {"color", {1, 1, 1}}, {"roughness", 0.5}};
    const json at{{"op", "eval"}, {"mu", 0.6}, {"wi", {0.28, 0, 0.96}}, {"precision", "double"}};
    const double f = red(answer(with(metal, at))["value"]),
                 g = red(answer(with(chalk, at))["value"]);
    json how = at;
    how.erase("wi");
    how.update({{"op", "albedo"}, {"how", "table"}});
    const double E = red(answer(with(metal, how))["reflect"]);

    const auto value = [&](const json& combination) {
        return red(answer(with(combination, at))["value"]);
    };
    EXPECT_NEAR(value({{"closure", "layer"}, {"top", metal}, {"base", chalk}}), f + (1 - E) * g,
                1e-9);
    EXPECT_NEAR(value({{"closure", "mix"}, {"fg", metal}, {"bg", chalk}, {"mix", 0.3}}),
                0.3 * f + 0.7 * g, 1e-9);
    EXPECT_NEAR(value({{"closure", "add"}, {"in1", metal}, {"in2", chalk}}), f + g, 1e-9);
    EXPECT_NEAR(value({{"closure", "multiply"}, {"in1", chalk}, {"in2", {0.5, 1, 1}}}), 0.5 * g,
                1e-9);

    const json layered{{"closure", "layer"},
                       {"top", metal},
                       {"base", {{"closure", "mix"}, {"fg", chalk}, {"bg", metal}, {"mix", 0.9}}}};
    const json mean = answer(with(with(layered, how), {{"how", "monte-carlo"}, {"n", 100000}})),
               told = answer(with(layered, how));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean["reflect"][c], told["reflect"][c], 4 * double(mean["stderr"]) + 3e-3);
}

// What stands in for another says so.
TEST(query_closures, subsurface_says_that_it_is_diffuse)
{
    const json q{{"op", "eval"}, {"closure", "subsurface"}, {"mu", 0.5}, {"wi", {0, 0, 1}}};
    const std::string note = answer(q)["note"];
    EXPECT_NE(note.find("diffuse"), std::string::npos);
    EXPECT_NEAR(red(answer(q)["value"]), 0.18 / std::acos(-1.0), 1e-6);
}

// MaterialX's films are accepted and left out, which the answer names; a film of no thickness is
// none.
TEST(query_closures, thin_films_are_left_out_and_named)
{
    const json plain{{"op", "albedo"}, {"closure", "conductor"}, {"mu", 0.5}, {"how", "table"}};
    const json film = with(plain, {{"thinfilm_thickness", 350}, {"thinfilm_ior", 1.4}});
    const std::string note = answer(film)["note"];
    EXPECT_NE(note.find("thinfilm_thickness 350"), std::string::npos) << note;
    EXPECT_EQ(answer(film)["reflect"], answer(plain)["reflect"]);
    EXPECT_FALSE(answer(with(plain, {{"thinfilm_thickness", 0}})).contains("note"));

    // Of parts, each once.
    json part = film;
    for (const char* whole : {"op", "mu", "how"}) part.erase(whole);
    const json both{{"op", "eval"}, {"closure", "layer"}, {"top", part},
                    {"base", part}, {"mu", 0.5},          {"wi", {0, 0, 1}}};
    EXPECT_EQ(answer(both)["note"], note);

    const auto error = [](const json& q) { return ask(q).value("error", ""); };
    EXPECT_NE(error(with(film, {{"thinfilm_thickness", -1}})).find("thinfilm_thickness"),
              std::string::npos);
    EXPECT_NE(error({{"op", "eval"}, {"closure", "burley_diffuse"}, {"thinfilm_ior", 1.4}})
                  .find("thinfilm_ior"),
              std::string::npos);
}

TEST(query_closures, transmitted_radiance_holds_the_ratio_of_indices)
{
    for (const double mu : {0.8, -0.8})
    {
        const double factor = mu > 0 ? 1 / (1.5 * 1.5) : 1.5 * 1.5;
        for (const double side : {1.0, -1.0})
        {
            json q = with(glass, {{"op", "eval"}, {"mu", mu}, {"wi", {-0.28, 0, 0.96 * side}}});
            const double energy = red(answer(q)["value"]);
            q["transport"] = "radiance";
            EXPECT_GT(energy, 0);
            EXPECT_NEAR(red(answer(q)["value"]), energy * (mu * side < 0 ? factor : 1), 1e-12);
        }
        json q = with(glass, {{"op", "sample"}, {"mu", mu}, {"n", 64}});
        const json energy = answer(q);
        q["transport"] = "radiance";
        const json radiance = answer(q);
        int transmitted = 0;
        for (std::size_t i = 0; i < 64; ++i)
        {
            const json &a = energy["samples"][i], &b = radiance["samples"][i];
            if (a["event"] == "none") continue;
            const bool through = a["event"] == "transmit";
            transmitted += through;
            EXPECT_EQ(a["wi"], b["wi"]);
            EXPECT_NEAR(red(b["weight"]), red(a["weight"]) * (through ? factor : 1), 1e-12);
        }
        EXPECT_GT(transmitted, 10);
        // Albedos are energies.
        q = with(glass, {{"op", "albedo"}, {"mu", mu}});
        const json albedo = answer(q);
        q["transport"] = "radiance";
        EXPECT_EQ(answer(q), albedo);
    }
}

TEST(query_closures, albedo_of_a_dielectric_is_the_facet_integral_s)
{
    for (const char* shadowing : {"correlated", "beta"})
        for (const double eta : {1.5, 1 / 1.5})
            for (const double mu : {0.9, 0.3})
            {
                const auto exact = luts::dielectric_albedo(luts::SlopeLaw::beckmann(0.4), mu, eta);
                // Seen from inside, the index is the other way round.
                for (const double side : {1.0, -1.0})
                {
                    const json a = answer(with(glass, {{"op", "albedo"},
                                                       {"distribution", "beckmann"},
                                                       {"transmission_shadowing", shadowing},
                                                       {"mu", side * mu},
                                                       {"ior", side > 0 ? eta : 1 / eta}}));
                    EXPECT_NEAR(red(a["reflect"]), exact.reflected, 1e-5);
                    EXPECT_NEAR(
                        red(a["transmit"]),
                        shadowing[0] == 'b' ? exact.transmitted_beta : exact.transmitted_correlated,
                        1e-5);
                    EXPECT_LT(a["stderr"], 1e-3);
                }
            }
}

TEST(query_closures, albedo_by_quadrature_is_the_mean_of_samples)
{
    const json cases[] = {
        with(glass, {{"mu", -0.4}, {"distribution", "gtr"}, {"gamma", 1.2}}),
        with(glass, {{"mu", 0.4}, {"alpha", {0.2, 0.6}}}),
        with(glass, {{"mu", 0.4}, {"thin_walled", true}, {"distribution", "std"}}),
        with(glass, {{"mu", 0.7}, {"scatter_mode", "T"}}),
        with(white, {{"mu", 0.2}, {"distribution", "std"}, {"gamma", 3}}),
        with(white, {{"mu", 0.2}, {"method", "kulla-conty"}}),
        with(white, {{"mu", 0.2}, {"method", "burley-sheen"}}),
        json{{"closure", "sheen"}, {"mu", 0.2}, {"precision", "double"}},
        json{{"closure", "sheen"}, {"mode", "zeltner"}, {"mu", 0.2}, {"precision", "double"}},
        json{{"closure", "sheen"}, {"mode", "conty_kulla"}, {"mu", 0.7}, {"precision", "double"}},
        json{{"closure", "oren_nayar_diffuse"}, {"roughness", 0.7}, {"mu", 0.2}},
        json{{"closure", "burley_diffuse"}, {"roughness", 0.7}, {"mu", 0.2}},
        json{{"closure", "translucent"}, {"mu", -0.2}, {"precision", "double"}},
        json{{"closure", "transparent"}, {"mu", -0.2}},
    };
    for (const json& q : cases)
    {
        const json exact = answer(with(q, {{"op", "albedo"}}));
        const json mean = answer(with(q, {{"op", "albedo"}, {"how", "monte-carlo"}, {"n", 40000}}));
        EXPECT_EQ(exact["how"], "quadrature");
        EXPECT_LT(exact["stderr"], 1e-3) << q;
        const double bound = 5 * mean["stderr"].get<double>() + exact["stderr"].get<double>();
        EXPECT_NEAR(total(exact), total(mean), bound + 1e-12) << q;
    }
}

// The added lobe goes where no facet refracts to, which facets' quadrature does not see.
TEST(query_closures, albedo_of_glass_with_a_tail_has_all_its_light)
{
    for (const double mu : {0.5, -0.9})
    {
        const json q = with(glass, {{"op", "albedo"}, {"mu", mu}, {"method", "tail"}});
        const json a = answer(q);
        EXPECT_NEAR(red(a["reflect"]) + red(a["transmit"]), 1, 5 * double(a["stderr"]) + 3e-3);
        const std::string refused = ask(with(q, {{"how", "quadrature"}}))["error"];
        EXPECT_NE(refused.find("tail"), std::string::npos) << refused;
    }
}

TEST(query_closures, kulla_conty_keeps_all_energy)
{
    const json q = with(white, {{"op", "albedo"}, {"mu", 0.4}, {"method", "kulla-conty"}});
    EXPECT_NEAR(total(answer(q)), 1, 2e-3);
    const json gain = answer(with(q, {{"op", "gain"}}));
    const json single = answer(with(q, {{"method", "none"}}));
    EXPECT_EQ(gain["form"], "added lobe");
    EXPECT_NEAR(red(gain["gain"]) * total(single), 1, 2e-3);
}

TEST(query_closures, a_walk_answers_estimates)
{
    json q = with(white, {{"op", "eval"}, {"mu", 0.7}, {"wi", {0, 0, 1}}, {"method", "walk"}});
    const json mean = answer(with(q, {{"n", 20000}, {"seed", 5}}));
    EXPECT_GT(mean["stderr"], 0);
    EXPECT_EQ(mean, answer(with(q, {{"n", 20000}, {"seed", 5}})));
    const json other = answer(with(q, {{"n", 20000}, {"seed", 6}}));
    EXPECT_NE(mean, other);
    EXPECT_NEAR(red(mean["value"]), red(other["value"]), 5 * 1.5 * mean["stderr"].get<double>());
    // More than the first bounce.
    EXPECT_GT(red(mean["value"]), red(answer(with(q, {{"method", "none"}}))["value"]));
    const json one = answer(with(q, {{"u", {0.1, 0.2, 0.3}}}));
    EXPECT_FALSE(one.contains("stderr"));
    // Without compensation there is nothing to walk for.
    q["strength"] = 0;
    EXPECT_EQ(answer(q), answer(with(q, {{"method", "none"}})));
}

TEST(query_closures, the_first_bounce_of_a_walk_is_single_scattering)
{
    for (const char* distribution : {"ggx", "beckmann", "gtr", "std"})
        for (const json& closure : {white, with(glass, {{"transmission_shadowing", "beta"}})})
        {
            const json q =
                with(closure, {{"op", "albedo"}, {"distribution", distribution}, {"mu", 0.5}});
            const json exact = answer(q);
            const json walk = with(q, {{"method", "walk"}, {"n", 40000}});
            const json first = answer(with(walk, {{"order", 1}}));
            EXPECT_EQ(first["how"], "monte-carlo");
            EXPECT_NEAR(total(first), total(exact), 5 * first["stderr"].get<double>()) << q;
            EXPECT_NEAR(total(answer(walk)), 1, 1e-6) << "nothing is lost";
        }
}

TEST(query_closures, fresnel_of_a_dielectric_has_two_sides)
{
    const json q{{"op", "fresnel"}, {"fresnel", {{"eta", 1.5}}}, {"precision", "double"}};
    EXPECT_NEAR(red(answer(with(q, {{"mu", 1}}))["value"]), 0.04, 1e-12);
    EXPECT_NEAR(red(answer(with(q, {{"mu", -1}}))["value"]), 0.04, 1e-12);
    EXPECT_EQ(red(answer(with(q, {{"mu", -0.5}}))["value"]), 1);
    const double outside = red(answer(with(q, {{"mu", 1}}))["average"]),
                 inside = red(answer(with(q, {{"mu", -1}}))["average"]);
    EXPECT_NEAR(1 - inside, (1 - outside) / 2.25, 1e-9);
}

TEST(query_closures, ndf_is_the_distribution_s)
{
    const auto check = [](const char* name, double gamma, const auto& distribution) {
        json q{{"op", "ndf"},           {"alpha", {0.25, 0.5}},  {"mu", 0.6},
               {"wm", {0, 0.28, 0.96}}, {"precision", "double"}, {"distribution", name}};
        if (gamma > 0) q["gamma"] = gamma;
        const json a = answer(q);
        // A compiler may compute constants more exactly than the processor does.
        EXPECT_DOUBLE_EQ(a["D"].get<double>(), distribution.D({0, 0.28, 0.96}));
        EXPECT_DOUBLE_EQ(a["lambda"].get<double>(), distribution.lambda({0.8, 0, 0.6}));
    };
    check("beckmann", 0, Beckmann<double>(0.25, 0.5));
    check("gtr", 1.5, GTR<double>(0.25, 0.5, 1.5));
    check("std", 3, STD<double>(0.25, 0.5, 3));
}
