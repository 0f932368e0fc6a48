// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain plan`: the table for people, JSON for machines, and what is refused.

#include "../support/price_list.h"
#include "command.h"
#include "plan_check.h"

#include <algorithm>

namespace {

using test::says;

class PlanCommand : public test::Command
{
protected:
    test::Outcome plan(const std::string& arguments) const
    {
        write("costs.json", regain::tests::price_list());
        return run("plan --costs FOLDER/costs.json " + arguments);
    }
};

TEST_F(PlanCommand, says_of_each_material_what_was_chosen_and_why)
{
    const auto rough = plan("gold --select gold_rough --tolerance 0.02 --json");
    ASSERT_EQ(rough.code, 0) << rough.err;
    const auto j = rough.json();
    EXPECT_EQ(j["tolerance"], 0.02);
    ASSERT_EQ(j["materials"].size(), 1u);
    const auto& m = j["materials"][0];
    EXPECT_EQ(m["material"], "gold_rough");
    EXPECT_EQ(m["within"], true);
    EXPECT_LE(m["error"], 0.02);
    EXPECT_DOUBLE_EQ(m["price"], m["eval"].get<double>() + m["sample"].get<double>());
    ASSERT_EQ(m["closures"].size(), 1u);
    const auto& c = m["closures"][0];
    EXPECT_EQ(c["closure"], "conductor");
    EXPECT_EQ(c["distribution"], "ggx");
    EXPECT_NE(c["method"], "none");
    EXPECT_GT(c["error_without"], 0.02);
    EXPECT_FALSE(c["why"].get<std::string>().empty());
    const auto effects = m["called_for"].get<std::vector<std::string>>();
    for (const char* effect : {"tint", "multiple scattering"})
        EXPECT_TRUE(std::count(effects.begin(), effects.end(), effect)) << effect;
    std::size_t bytes = 0;
    for (const auto& t : j["tables"]) bytes += t["bytes"].get<std::size_t>();
    EXPECT_EQ(j["loaded_bytes"].get<std::size_t>() + j["compiled_in_bytes"].get<std::size_t>(),
              bytes);

    const auto text = plan("gold --select gold_rough --tolerance 0.02");
    for (const std::string part : {"gold_rough: error", "calls for tint", "keeps the tolerance",
                                   "tables in memory: 0 bytes loaded", "ggx_E_ss"})
        EXPECT_TRUE(says(text.out, part)) << part << " in " << text.out;
    EXPECT_TRUE(says(text.out, c["method"].get<std::string>()));
}

TEST_F(PlanCommand, a_tolerance_of_0_is_the_reference_and_of_1_nothing_at_all)
{
    for (const auto& [tolerance, method] : {std::pair{"0", "walk"}, {"1", "none"}})
    {
        const auto j =
            plan(fmt::format("gold --select gold_rough --tolerance {} --json", tolerance)).json();
        EXPECT_EQ(j["materials"][0]["closures"][0]["method"], method);
        EXPECT_EQ(j["loaded_bytes"], 0);
    }
}

TEST_F(PlanCommand, all_presets_of_a_call_are_one_scene)
{
    const auto j = plan("gold glass-crown cotton-white --json").json();
    EXPECT_GE(j["materials"].size(), 5u);
    const auto& tables = j["tables"];
    for (std::size_t i = 0; i < tables.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) EXPECT_NE(tables[i]["name"], tables[k]["name"]);
}

TEST_F(PlanCommand, inputs_can_be_set)
{
    const auto smooth = plan("gold --select gold_rough --set roughness=0.001 --json").json();
    EXPECT_EQ(smooth["materials"][0]["closures"][0]["method"], "none");
}

TEST_F(PlanCommand, bad_input_is_named_with_what_is_accepted)
{
    const std::pair<const char*, const char*> wrong[] = {
        {"gold --tolerance 2", "--tolerance 2: takes numbers from 0 to 1"},
        {"gold --tolerance -1", "takes numbers from 0 to 1"},
        {"gold --tolerance nan", "takes numbers from 0 to 1"},
        {"gold --tolerance x", "--tolerance"},
        {"", "DOCUMENT"},
        {"no-such-preset", "no-such-preset"},
        {"gold --select copper_rough", "gold_rough"},
        {"gold --set roughness", "INPUT=VALUE"},
        {"gold --set colour=1", "'colour' is no input"},
        {"gold --costs FOLDER/none.json", "cannot be read"},
        {"gold --costs FOLDER/stdin", "cannot be read"},
    };
    for (const auto& [arguments, message] : wrong)
    {
        const auto outcome =
            says(arguments, "--costs") ? run(std::string("plan ") + arguments) : plan(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_TRUE(says(outcome.err, message)) << arguments << ": " << outcome.err;
        EXPECT_EQ(outcome.out, "") << arguments;
    }
    EXPECT_TRUE(says(run("plan --help").out, "Examples:"));
}

// bench/plan_error asks 200 of them.
TEST(PlanCheck, of_random_materials_few_are_further_off_than_predicted)
{
    const auto& costs = regain::shaders::MethodCosts::shipped();
    if (costs.empty()) GTEST_SKIP() << "no measured costs are compiled in";
    regain::tools::PlanCheck settings;
    settings.materials = 40;
    settings.samples = 16384;
    std::string worse;
    int count = 0;
    for (const auto& c : regain::tools::checked_plans(costs, settings))
    {
        // What chance may add in so short a run is no error of the plan's.
        if (c.measured - 2 * c.noise <= c.predicted) continue;
        ++count;
        worse += fmt::format("{}: {}, predicted {:.4f}, measured {:.4f}\n", c.material, c.methods,
                             c.predicted, c.measured);
    }
    EXPECT_LE(count, 2) << worse;
}

}  // namespace
