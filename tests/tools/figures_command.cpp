// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain figures` makes every figure of the paper, says what it claims and what was measured, and
// refuses what it does not know. Numbers that do not depend on noise are compared with those of
// docs and literature.

#include "command.h"

#include <algorithm>
#include <cmath>

using nlohmann::json;
using test::says;

namespace {

using FiguresCommand = test::Command;

constexpr const char* quick = " --size 0.05 --spp 1 --precision 0.001 --quiet -o FOLDER/figures";

const json& figure(const json& all, const std::string& name)
{
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const json& f) { return f["name"] == name; });
    if (at == all.end()) throw std::runtime_error("no figure " + name);
    return *at;
}

}  // namespace

TEST_F(FiguresCommand, makes_pictures_plots_captions_and_numbers)
{
    const auto o = run("figures 1 3 4 5 6 7 8 9 table1 --json" + std::string(quick));
    ASSERT_EQ(o.code, 0) << o.err;
    const json all = o.json();
    ASSERT_EQ(all.size(), 9u);
    EXPECT_EQ(json::parse(read("figures/figures.json")), all);
    const std::string page = read("figures/index.html");
    for (const json& f : all)
    {
        EXPECT_FALSE(f["findings"].empty()) << f["name"];
        for (const json& finding : f["findings"])
        {
            EXPECT_FALSE(finding["paper"].get<std::string>().empty());
            EXPECT_FALSE(finding["measured"].get<std::string>().empty());
        }
        for (const json& picture : f["pictures"])
        {
            const std::filesystem::path file(picture.get<std::string>());
            EXPECT_GT(std::filesystem::file_size(file), 100u) << file;
            EXPECT_TRUE(says(page, file.filename().string())) << file;
        }
    }
    // What the table has to show of every method.
    const json& numbers = figure(all, "table1")["numbers"];
    for (const char* method : {"none", "normalise", "turquin", "turquin-eq12", "turquin-eq13",
                               "turquin-eq14", "series", "directional", "balanced", "kulla-conty",
                               "kulla-conty-series", "tail", "walk", "walk-bounded"})
        for (const char* what :
             {"energy_worst", "tint_worst", "tint_rms", "shape_mean", "reciprocity_worst",
              "weight_variance", "eval_ns", "sample_ns", "table_bytes"})
            EXPECT_TRUE(numbers[method][what].is_number()) << method << ", " << what;
    for (const char* method : {"none", "turquin", "kulla-conty", "walk"})
        EXPECT_TRUE(numbers["glass"][method]["reflected_leaving_worst"].is_number()) << method;
    // Single scattering of GGX at alpha 1 and normal incidence keeps 1 - ln 2.
    EXPECT_NEAR(numbers["none"]["energy_worst"].get<double>(), std::log(2.0), 0.03);
    EXPECT_LT(numbers["turquin"]["energy_worst"].get<double>(), 0.03);
    EXPECT_GT(numbers["turquin"]["reciprocity_worst"].get<double>(), 0.1);
    EXPECT_LT(numbers["kulla-conty"]["reciprocity_worst"].get<double>(), 1e-9);
    // A page of E_ss: 32 x 32 values, 1 where alpha is 0.
    const json& values = figure(all, "5")["numbers"]["GGX"]["values"];
    ASSERT_EQ(values.size(), 1024u);
    EXPECT_NEAR(values[31].get<double>(), 1, 1e-3);
    EXPECT_NEAR(values[1023].get<double>(), 1 - std::log(2.0), 1e-4);
}

TEST_F(FiguresCommand, measures_what_each_distribution_loses)
{
    const auto o = run("figures 2 --json" + std::string(quick));
    ASSERT_EQ(o.code, 0) << o.err;
    const json numbers = o.json()[0]["numbers"];
    // Averages at alpha 1, by quadrature elsewhere: Beckmann .66368, GGX and GTR .40914, STD 1.55
    // .09454 are kept.
    EXPECT_NEAR(numbers["Beckmann"]["lost_on_average_at_alpha_1"].get<double>(), 1 - 0.66368, 2e-5);
    EXPECT_NEAR(numbers["GGX"]["lost_on_average_at_alpha_1"].get<double>(), 1 - 0.40914, 2e-5);
    EXPECT_NEAR(numbers["GTR gamma 1"]["lost_on_average_at_alpha_1"].get<double>(), 1 - 0.40914,
                2e-5);
    EXPECT_NEAR(numbers["STD gamma 1.55"]["lost_on_average_at_alpha_1"].get<double>(), 1 - 0.09454,
                5e-5);
    EXPECT_LT(numbers["Beckmann"]["compensated_worst"].get<double>(), 2e-3);
    EXPECT_LT(numbers["GGX"]["compensated_worst"].get<double>(), 2e-3);
    EXPECT_LT(numbers["GTR gamma 1"]["compensated_worst"].get<double>(), 5e-3);
    EXPECT_LT(numbers["STD gamma 1.55"]["compensated_worst"].get<double>(), 5e-3);
}

TEST_F(FiguresCommand, refuses_what_it_does_not_know)
{
    const auto unknown = run("figures 10 -o FOLDER/figures");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_TRUE(says(unknown.err, "no figure '10'; there are 1, 2, 3")) << unknown.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "figures"));
    for (const char* bad : {"--spp 0", "--size 100", "--precision nan", "--seed -1", "--spp x"})
        EXPECT_EQ(run(fmt::format("figures 7 {} -o FOLDER/figures", bad)).code, 2) << bad;
    write("file", "");
    const auto taken = run("figures 7 -o FOLDER/file");
    EXPECT_EQ(taken.code, 2);
    EXPECT_TRUE(says(taken.err, "cannot make the folder")) << taken.err;
}
