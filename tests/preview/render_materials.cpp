// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What `regain render` can be told about its materials: each option changes the picture as it
// should and is told in the file, and what does not go together is refused.

#include "render_fixture.h"

#include <initializer_list>

namespace regain::tools { namespace {

class RenderMaterials : public RenderTest
{
protected:
    using Arguments = std::vector<std::string>;

    /// A sphere under a light of 1 from everywhere, small. The mean of what is seen.
    double furnace(const std::string& name, const Arguments& more, const char* samples = "16")
    {
        Arguments all{"-o",    file(name), "--size",   "24x24",  "--environment", "white",
                      "--spp", samples,    "--object", "sphere", "--quiet"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(run(all), kDone) << err;
        return mean(file(name));
    }
    void expect_told(const std::string& name,
                     std::initializer_list<std::pair<const char*, const char*>> told) const
    {
        for (const auto& [what, value] : told)
            EXPECT_EQ(attribute(file(name), std::string("regain:") + what), value) << what;
    }
};

TEST_F(RenderMaterials, AThinWalledSphereVanishesInAFurnace)
{
    const Arguments sheet{"--material", "glass", "--thin-walled", "--alpha", "0.8", "--ior", "1.4"};
    const auto with = [&](const char* method) {
        Arguments all = sheet;
        all.insert(all.end(), {"--method", method});
        return all;
    };
    EXPECT_NEAR(furnace("a.exr", with("turquin"), "256"), 1, 0.01);
    expect_told("a.exr", {{"material", "glass"},
                          {"thin_walled", "1"},
                          {"scatter_mode", "RT"},
                          {"ior", "1.4"},
                          {"transmission_shadowing", ""}});
    EXPECT_LT(furnace("b.exr", with("none")), 0.9);
}

TEST_F(RenderMaterials, EachScatterModeIsPartOfBoth)
{
    const auto of_mode = [&](const std::string& mode, bool thin) {
        Arguments all{"--material", "glass", "--alpha",        "0.2",
                      "--method",   "none",  "--scatter-mode", mode};
        if (thin) all.push_back("--thin-walled");
        const double seen = furnace(mode + ".exr", all);
        expect_told(mode + ".exr",
                    {{"scatter_mode", mode.c_str()}, {"thin_walled", thin ? "1" : "0"}});
        return seen;
    };
    for (const bool thin : {false, true})
    {
        const double R = of_mode("R", thin), T = of_mode("T", thin), both = of_mode("RT", thin);
        EXPECT_LT(R, T);
        EXPECT_LT(T, both);
    }
}

TEST_F(RenderMaterials, TransmissionShadowingIsCorrelatedUnlessToldOrWalking)
{
    const auto glass = [&](const char* name, const Arguments& more) {
        Arguments all{"--material", "glass", "--alpha", "1", "--method", "none"};
        all.insert(all.end(), more.begin(), more.end());
        furnace(name, all);
        return bytes(file(name));
    };
    const auto told = glass("told.exr", {"--transmission-shadowing", "correlated"});
    EXPECT_EQ(told, glass("untold.exr", {}));
    expect_told("untold.exr", {{"transmission_shadowing", "correlated"}});
    EXPECT_NE(told, glass("beta.exr", {"--transmission-shadowing", "beta"}));
    expect_told("beta.exr", {{"transmission_shadowing", "beta"}});
    furnace("walk.exr", {"--material", "glass", "--alpha", "1", "--method", "walk"});
    expect_told("walk.exr", {{"method", "walk"}, {"transmission_shadowing", "beta"}});
}

// The base is what is seen where sheen adds nothing; sheen adds 0.0116 of a white light on average.
TEST_F(RenderMaterials, SheenGlowsOverItsBase)
{
    const auto cloth = [&](const char* base, const char* weight) {
        // With nothing but the sphere in the frame's middle the corners see the light itself.
        return 1 -
               furnace("a.exr", {"--material", "sheen", "--base", base, "--weight", weight}, "64");
    };
    const double covered = cloth("0", "0");  // black
    expect_told("a.exr", {{"material", "sheen"},
                          {"base", "0"},
                          {"weight", "0"},
                          {"method", "none"},
                          {"alpha", ""},
                          {"distribution", ""}});
    EXPECT_GT(covered, 0.3);
    EXPECT_NEAR(cloth("0.25", "0"), 0.75 * covered, 1e-3);
    EXPECT_LT(cloth("0", "1"), 0.995 * covered);
    EXPECT_LT(cloth("0.25", "1"), 0.745 * covered);

    ASSERT_EQ(run({"-o", file("row.exr"), "--material", "sheen", "--size", "80x32", "--spp", "1",
                   "--host", "clarisse", "--quiet"}),
              kDone)
        << err;
    expect_told("row.exr", {{"weight", "0, 0.25, 0.5, 0.75, 1"}, {"base", "0.05"}});
}

TEST_F(RenderMaterials, AlphaRatioWidensOneWay)
{
    const auto metal = [&](const Arguments& more) {
        Arguments all{"-o",      file("a.exr"), "--size",   "32x32",  "--spp",  "2",
                      "--alpha", "0.4",         "--object", "sphere", "--quiet"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(run(all), kDone) << err;
        return bytes(file("a.png"));
    };
    const auto round = metal({});
    expect_told("a.exr", {{"alpha_ratio", "1"}});
    const auto flat = metal({"--alpha-ratio", "8"});
    expect_told("a.exr", {{"alpha_ratio", "8"}, {"alpha", "0.4"}});
    EXPECT_NE(round, flat);
    EXPECT_NE(flat, metal({"--alpha-ratio", "0.125"}));
    EXPECT_EQ(round, metal({"--alpha-ratio", "1"}));
}

TEST_F(RenderMaterials, WhatDoesNotGoTogetherIsRefused)
{
    const std::string glass = "glass", sheen = "sheen";
    const struct
    {
        std::vector<std::string> arguments;
        const char* says;
    } cases[] = {
        {{"--material", "jelly"}, "no such material; there are metal, glass, sheen"},
        {{"--thin-walled"}, "--thin-walled: does not go with --material metal; accepted: glass"},
        {{"--scatter-mode", "T"}, "--scatter-mode T: does not go with --material metal"},
        {{"--transmission-shadowing", "beta"}, "--transmission-shadowing beta: does not go with"},
        {{"--ior", "1.3"}, "--ior 1.3: does not go with --material metal; accepted: glass"},
        {{"--weight", "0.5"}, "--weight 0.5: does not go with --material metal; accepted: sheen"},
        {{"--base", "0.5"}, "--base 0.5: does not go with --material metal; accepted: sheen"},
        {{"--gamma", "1.5"}, "--gamma 1.5: does not go with --distribution ggx; accepted: gtr"},
        {{"--alpha-ratio", "0"}, "--alpha-ratio 0: takes numbers from 0.01 to 100"},
        {{"--alpha-ratio", "nan"}, "--alpha-ratio nan: takes"},

        {{"--material", glass, "--metal", "gold"}, "--metal gold: does not go with --material gl"},
        {{"--material", glass, "--scatter-mode", "TR"}, "no such mode; there are R, T, RT"},
        {{"--material", glass, "--transmission-shadowing", "smith"},
         "--transmission-shadowing smith: no such form; there are correlated, beta"},
        {{"--material", glass, "--thin-walled", "--transmission-shadowing", "beta"},
         "--transmission-shadowing beta: does not go with --thin-walled"},
        {{"--material", glass, "--scatter-mode", "R", "--transmission-shadowing", "beta"},
         "--transmission-shadowing beta: does not go with --scatter-mode R"},
        {{"--material", glass, "--method", "walk", "--transmission-shadowing", "correlated"},
         "--transmission-shadowing correlated: does not go with --method walk; accepted: beta"},
        {{"--material", glass, "--method", "walk", "--scatter-mode", "T"},
         "--method walk: the method walk takes a dielectric of scatter mode RT"},
        {{"--material", glass, "--method", "walk", "--thin-walled"}, "that is not thin-walled"},
        {{"--material", glass, "--method", "kulla-conty", "--thin-walled"},
         "does not go with thin-walled dielectrics; accepted: none, normalise, turquin"},

        {{"--material", sheen, "--weight", "1.5"}, "--weight 1.5: takes numbers from 0 to 1"},
        {{"--material", sheen, "--base", "-1"}, "--base -1: takes numbers from 0 to 1"},
        {{"--material", sheen, "--method", "turquin"},
         "--method turquin: the method turquin does not go with sheen"},
        {{"--material", sheen, "--alpha", "0.1,0.2"},
         "--alpha 0.1,0.2: does not go with --material sheen; accepted: metal, glass"},
        {{"--material", sheen, "--distribution", "ggx"}, "--distribution ggx: does not go with"},
        {{"--material", sheen, "--thin-walled"}, "--thin-walled: does not go with --material sh"},
    };
    for (const auto& c : cases)
    {
        auto arguments = c.arguments;
        arguments.insert(arguments.end(), {"-o", file("bad.exr")});
        EXPECT_EQ(run(arguments), kBadInput) << c.says;
        EXPECT_NE(err.find(c.says), std::string::npos) << c.says << "\nbut: " << err;
        EXPECT_FALSE(std::filesystem::exists(file("bad.exr")));
    }
}

// kulla-conty, and the gain, have a part for each mode.
TEST_F(RenderMaterials, ModesGoWithWhatHasAPartForThem)
{
    for (const char* method : {"none", "turquin", "kulla-conty"})
        for (const char* mode : {"R", "T"})
            furnace("a.exr",
                    {"--material", "glass", "--alpha", "0.5", "--scatter-mode", mode, "--method",
                     method},
                    "1");
}

}}  // namespace regain::tools
