// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "command.h"

#include <cmath>

using nlohmann::json;
using test::says;

namespace {

using AlbedoCommand = test::Command;

}  // namespace

TEST_F(AlbedoCommand, tells_what_a_rough_mirror_keeps)
{
    const auto o = run("albedo --alpha 1 --constant 1 --mu 0.5,1 --precision double --json");
    ASSERT_EQ(o.code, 0) << o.err;
    const json a = o.json();
    EXPECT_EQ(a["how"], "quadrature");
    ASSERT_EQ(a["directional"].size(), 2u);
    EXPECT_EQ(a["directional"][1]["mu"], 1);
    EXPECT_NEAR(a["directional"][1]["reflect"][0], 1 - std::log(2.0), 1e-9);
    // The slope integral of the tables.
    EXPECT_NEAR(a["average"]["reflect"][2], 0.409137, 1e-6);
    EXPECT_EQ(a["average"]["transmit"], json({0, 0, 0}));
}

TEST_F(AlbedoCommand, prints_a_table_with_errors)
{
    const auto o = run("albedo --alpha 1 --constant 1 --mu 1");
    EXPECT_EQ(o.code, 0);
    ASSERT_EQ(o.lines().size(), 4u) << o.out;
    EXPECT_TRUE(says(o.lines()[0], "conductor, ggx, alpha 1; method none"));
    EXPECT_TRUE(says(o.lines()[1], "error"));
    EXPECT_TRUE(says(o.lines()[2], "0.306853"));
    EXPECT_TRUE(says(o.lines()[3], "average"));
}

TEST_F(AlbedoCommand, lists_both_sides_of_a_dielectric)
{
    const auto o = run("albedo --eta 1.5 --alpha 0 --mu -0.5,1 --precision double --json");
    ASSERT_EQ(o.code, 0) << o.err;
    const json a = o.json();
    EXPECT_EQ(a["closure"]["closure"], "dielectric");
    // Beyond the critical angle everything is reflected; at normal incidence 4 %.
    EXPECT_NEAR(a["directional"][0]["reflect"][0], 1, 1e-9);
    EXPECT_NEAR(a["directional"][1]["reflect"][0], 0.04, 1e-9);
    EXPECT_NEAR(a["directional"][1]["transmit"][0], 0.96, 1e-9);
    // 1 - F_ss(1 / eta) = (1 - F_ss(eta)) / eta^2
    EXPECT_NEAR(a["inside"]["transmit"][0].get<double>(),
                a["average"]["transmit"][0].get<double>() / 2.25, 1e-3);
}

TEST_F(AlbedoCommand, f0_makes_the_closure_schlick_s)
{
    const json a = run("albedo --f0 1,0.5,0.25 --f82 0.5 --alpha 0.5,0.25 --method turquin --json "
                       "--how table")
                       .json();
    EXPECT_EQ(a["closure"]["closure"], "generalized_schlick");
    EXPECT_EQ(a["closure"]["fresnel"]["F0"], json({1, 0.5, 0.25}));
    EXPECT_EQ(a["closure"]["fresnel"]["F82"], json({0.5, 0.5, 0.5}));
    EXPECT_EQ(a["closure"]["alpha"], json({0.5, 0.25}));
    EXPECT_TRUE(a["average"]["stderr"].is_null());
}

TEST_F(AlbedoCommand, monte_carlo_is_reproducible)
{
    const std::string line = "albedo --alpha 0.5 --how monte-carlo --n-samples 1000 --json --seed ";
    EXPECT_EQ(run(line + "1").out, run(line + "1").out);
    EXPECT_NE(run(line + "1").out, run(line + "2").out);
}

TEST_F(AlbedoCommand, bad_input_is_named_and_gives_exit_code_2)
{
    for (const auto& [arguments, part] : std::vector<std::pair<std::string, std::string>>{
             {"--alpha 2", "'alpha' is 2"},
             {"--f0 1,2", "'F0' is a list of 2"},
             {"--f82 1", "'F0' is missing"},
             {"--n 1 --constant 1", "holds one of"},
             {"--mu 1.5", "--mu holds 1.5"},
             {"--mu nan", "--mu holds nan"},
             {"--alpha nan", "'alpha' is"},
             {"--strength inf", "'strength' is"},
             {"--closure velvet", "there is no closure 'velvet'"},
             {"--closure translucent --alpha 0.5", "has no microfacets"},
             {"--closure layer", "belongs to the parts"},
             {"--distribution phong", "there is no distribution"},
             {"--gamma 3", "'gamma' cannot be used"},
             {"--distribution std --gamma 1.5", "'gamma' is 1.5"},
             {"--thin-walled", "belongs to the closure dielectric"},
             {"--order 2", "--order belongs to the method walk"},
             {"--eta 0", "'eta' is 0"},
             {"--method kulla", "there is no method 'kulla'"},
             {"--how guess", "there is no how 'guess'"},
             {"--n-samples 1", "--n-samples is 1"},
             {"--seed -1", "seed"},
             {"--n-samples -1", "n-samples"},
             {"--alpha high", "high"},
             {"--aplha 1", "aplha"}})
    {
        const auto o = run("albedo " + arguments);
        EXPECT_EQ(o.code, 2) << arguments;
        EXPECT_TRUE(says(o.err, part)) << arguments << ": " << o.err;
        EXPECT_EQ(o.out, "") << arguments;
    }
}

TEST_F(AlbedoCommand, help_has_examples)
{
    const auto o = run("albedo --help");
    EXPECT_EQ(o.code, 0);
    EXPECT_TRUE(says(o.out, "examples:"));
}
