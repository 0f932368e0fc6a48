// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain cost` writes tables and a page that agree, measures errors that are known by other means,
// says what it refuses, and leaves nothing behind where it is stopped.

#include "command.h"

#include "cost/pareto.h"

#include <signal.h>
#include <unistd.h>
#include <pugixml.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <thread>

using nlohmann::json;
using test::says;

namespace {

class CostCommand : public test::Command
{
protected:
    static constexpr const char* small =
        "cost --quick --quiet --samples 4096 --seconds-per-picture 0 -o FOLDER/cost ";

    std::vector<std::map<std::string, std::string>> csv(const std::string& name) const
    {
        std::istringstream text(read(name));
        std::vector<std::string> columns;
        std::vector<std::map<std::string, std::string>> rows;
        for (std::string line; std::getline(text, line);)
        {
            const std::vector<std::string> values = cells(line);
            if (columns.empty())
            {
                columns = values;
                continue;
            }
            EXPECT_EQ(values.size(), columns.size()) << line;
            rows.emplace_back();
            for (std::size_t i = 0; i < std::min(values.size(), columns.size()); ++i)
                rows.back()[columns[i]] = values[i];
        }
        return rows;
    }

    // The first row of a method at alpha 1.
    static json row(const json& all, const std::string& method, const std::string& material = "")
    {
        for (const json& r : all["rows"])
            if (r["method"] == method && r["alpha"] == 1 &&
                (material.empty() || r["material"] == material))
                return r;
        ADD_FAILURE() << "no row of " << method;
        return {};
    }

    // Runs it, interrupts it as soon as it has made its folder, and returns the exit code.
    int interrupted() const
    {
        const std::string output = (folder / "cost").string(), plan = (folder / "plan").string();
        const pid_t child = ::fork();
        if (child == 0)
        {
            if (std::freopen("/dev/null", "w", stderr) && std::freopen("/dev/null", "w", stdout))
                ::execl(REGAIN_BINARY, REGAIN_BINARY, "cost", "-o", output.c_str(),
                        "--planner-data", plan.c_str(), nullptr);
            ::_exit(127);
        }
        for (int i = 0; i < 2000 && !std::filesystem::exists(output); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        // The handler is set after the folder is made.
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        ::kill(child, SIGINT);
        int status = -1;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    static std::vector<std::string> cells(const std::string& line)
    {
        std::vector<std::string> all(1);
        bool quoted = false;
        for (const char c : line)
            if (c == '"')
                quoted = !quoted;
            else if (c == ',' && !quoted)
                all.emplace_back();
            else
                all.back() += c;
        return all;
    }
};

}  // namespace

TEST_F(CostCommand, tables_and_page_agree)
{
    const auto o = run(std::string(small) +
                       "--class metal,glass-inside --distribution ggx --method none,directional "
                       "--planner-data FOLDER/plan.json");
    ASSERT_EQ(o.code, 0) << o.err;
    const json all = json::parse(read("cost/cost.json"));
    const auto table = csv("cost/cost.csv");
    // Two methods, three widths; six greys of metal, one glass.
    ASSERT_EQ(all["rows"].size(), 2u * 3u * 7u);
    ASSERT_EQ(table.size(), all["rows"].size());
    for (std::size_t i = 0; i < table.size(); ++i)
        for (const auto& [field, value] : all["rows"][i].items())
        {
            ASSERT_TRUE(table[i].count(field)) << field;
            const std::string& cell = table[i].at(field);
            if (value.is_null())
                EXPECT_EQ(cell, "") << field;
            else if (value.is_string())
                EXPECT_EQ(cell, value.get<std::string>()) << field;
            else
                EXPECT_EQ(std::stod(cell), value.get<double>()) << field;
        }

    pugi::xml_document page;
    const auto parsed = page.load_file((folder / "cost/cost.html").c_str());
    ASSERT_TRUE(parsed) << parsed.description() << " at " << parsed.offset;
    // Each front's sentence stands in the page, which has a plot for each class.
    ASSERT_FALSE(all["fronts"].empty());
    std::string paragraphs;
    for (const auto& p : page.select_nodes("//p")) paragraphs += p.node().text().get();
    for (const json& front : all["fronts"])
        EXPECT_TRUE(says(paragraphs, front["sentence"].get<std::string>())) << front["sentence"];
    EXPECT_EQ(page.select_nodes("//svg").size(), 2u);
    for (const char* file : {"cost/pareto-metal-ggx.svg", "cost/pareto-glass-inside-ggx.svg"})
        EXPECT_TRUE(pugi::xml_document().load_file((folder / file).c_str())) << file;
    // So it does in the page for those who read documentation, and what is on the front is in its
    // table.
    const std::string fronts = read("cost/cost-fronts.md");
    for (const json& front : all["fronts"])
    {
        EXPECT_TRUE(says(fronts, "\n" + front["sentence"].get<std::string>() + "\n"));
        for (const json& point : front["points"])
        {
            const auto& on = front["front"];
            if (std::find(on.begin(), on.end(), point["method"]) == on.end()) continue;
            const double error = point["error"];
            EXPECT_TRUE(says(
                fronts, fmt::format("`{}` {}{:.2g} / {:.2f}", point["method"].get<std::string>(),
                                    error > front["floor"] ? "" : "< ", error,
                                    point["time"].get<double>())))
                << point;
        }
    }
    // Nothing is outside of it.
    EXPECT_TRUE(page.select_nodes("//script | //link | //a | //iframe | //object").empty());
    for (const auto& image : page.select_nodes("//img"))
        EXPECT_EQ(std::string(image.node().attribute("src").value()).rfind("data:image/png;", 0),
                  0u);
    EXPECT_FALSE(page.select_nodes("//img").empty());

    // What a plan reads are the same numbers, to three digits.
    const json plan = json::parse(read("plan.json"));
    for (const json& entry : plan["entries"])
    {
        if (entry.contains("refused")) continue;
        ASSERT_EQ(entry["error"].size(), entry["alpha"].size());
        const std::string method = entry["method"];
        if (entry["class"] == "metal")
        {
            EXPECT_EQ(entry["F0"], json({0.04, 0.2, 0.5, 0.8, 0.95, 1.0}));
            const double told = entry["error"][2][5], full = row(all, method, "F0 1")["error"];
            EXPECT_NEAR(told, full, 0.005 * full + 1e-12) << method;
        }
    }
}

TEST_F(CostCommand, errors_are_those_that_are_known)
{
    const auto o = run(std::string(small) +
                       "--class metal --distribution ggx --method none,directional,walk --json");
    ASSERT_EQ(o.code, 0) << o.err;
    const json all = o.json();
    for (const json& r : all["rows"])
    {
        if (r["method"] != "walk") continue;
        // Five sigma: of sixteen chances a row.
        EXPECT_LE(r["error"].get<double>(), 5 * r["noise"].get<double>() + 1e-6) << r;
    }
    const json none = row(all, "none", "F0 1"), directional = row(all, "directional", "F0 1"),
               walk = row(all, "walk", "F0 1");
    // GGX of alpha 1 keeps 1 - ln 2 along the normal, and loses no more elsewhere.
    EXPECT_NEAR(none["error"].get<double>(), std::log(2.0), 0.01);
    EXPECT_LT(directional["error"].get<double>(), 0.1 * none["error"].get<double>());
    EXPECT_LT(walk["shape"].get<double>(), directional["shape"].get<double>());
    EXPECT_EQ(none["eval_ratio"], 1);
    EXPECT_GT(walk["sample_ratio"].get<double>(), 1);
    EXPECT_EQ(none["table_bytes"], 0);
    EXPECT_GT(directional["table_bytes"].get<int>(), 0);
    // A single grey has no colour.
    EXPECT_TRUE(none["tint"].is_null());
}

TEST_F(CostCommand, errors_do_not_depend_on_threads)
{
    const std::string what =
        std::string(small) + "--class plastic --distribution ggx --method none,tail --json ";
    const json one = run(what + "--threads 1").json(), two = run(what + "--threads 2").json();
    ASSERT_EQ(one["rows"].size(), two["rows"].size());
    for (std::size_t i = 0; i < one["rows"].size(); ++i)
        for (const char* field : {"error", "error_mean", "shape", "variance", "stderr"})
            EXPECT_EQ(one["rows"][i][field], two["rows"][i][field]) << field;
}

TEST_F(CostCommand, parts_that_are_merged_are_one_run)
{
    const std::string what =
        std::string(small) +
        "--class metal,plastic --distribution ggx --method none,directional,walk ";
    const json whole = run(what + "--json").json();
    const std::string page = read("cost/cost.html");
    for (const int k : {3, 1, 2})
    {
        const auto o = run(what + fmt::format("--json --part {}/3", k));
        ASSERT_EQ(o.code, 0) << o.err;
        EXPECT_EQ(o.json()["kind"], "cases");
    }
    const std::string parts = "--merge FOLDER/cost/cost.part-*-of-3";
    const auto merged = run(what + parts + " --json --planner-data FOLDER/plan.json");
    ASSERT_EQ(merged.code, 0) << merged.err;
    const json rows = merged.json()["rows"];
    ASSERT_EQ(rows.size(), whole["rows"].size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (const auto& [field, value] : whole["rows"][i].items())
        {
            if (says(field, "_ns") || says(field, "eval_") || says(field, "sample_")) continue;
            EXPECT_EQ(rows[i][field], value) << field;
        }
    // The lobes that are shown came along.
    const auto strips = [](const std::string& html) {
        std::size_t n = 0;
        for (auto at = html.find("data:image/png"); at != html.npos;
             at = html.find("data:image/png", at + 1))
            ++n;
        return n;
    };
    EXPECT_GT(strips(page), 0u);
    EXPECT_EQ(strips(read("cost/cost.html")), strips(page));
    EXPECT_FALSE(read("plan.json").empty());

    const auto refused = [&](const std::string& options) {
        const auto o = run(what + options);
        EXPECT_EQ(o.code, 2) << options;
        return o.err;
    };
    EXPECT_TRUE(says(refused("--seed 2 " + parts), "is of another job: seed: '1' there, '2' here"));
    EXPECT_TRUE(
        says(refused("--merge FOLDER/cost/cost.part-1-of-3"), "of 3 parts 2 are not given"));
    EXPECT_TRUE(says(refused("--part 1/3 --planner-data FOLDER/p"), "give it to --merge"));
    EXPECT_TRUE(says(refused("--part 4/3"), "1 <= K <= N"));
}

TEST_F(CostCommand, refused_combinations_are_told_with_the_reason)
{
    const auto o = run(std::string(small) +
                       "--class glass-outside --distribution ggx --method directional --json");
    ASSERT_EQ(o.code, 0) << o.err;
    for (const json& r : o.json()["rows"])
        EXPECT_TRUE(says(r["refused"], "does not go with dielectrics")) << r;
    EXPECT_TRUE(says(read("cost/cost.html"), "does not go with dielectrics"));
}

TEST_F(CostCommand, pictures_of_equal_time_are_of_equal_time)
{
    const auto o =
        run("cost --quick --quiet --samples 64 --seconds-per-picture 0.3 --class coloured-metal "
            "--distribution ggx --method none,walk -o FOLDER/cost --json");
    ASSERT_EQ(o.code, 0) << o.err;
    const json scene = o.json()["equal_time"].at(0);
    ASSERT_EQ(scene["pictures"].size(), 2u);
    for (const json& picture : scene["pictures"])
    {
        EXPECT_GE(picture["seconds"].get<double>(), 0.29);
        EXPECT_GE(picture["samples_per_pixel"].get<double>(), 1);
        EXPECT_GT(picture["rmse"].get<double>(), 0);
    }
    // Rough gold without compensation is too dark; the walk is only noisy.
    EXPECT_LT(scene["pictures"][1]["block_rmse"].get<double>(),
              scene["pictures"][0]["block_rmse"].get<double>());
}

TEST_F(CostCommand, refuses_what_it_does_not_know)
{
    for (const char* option : {"class", "distribution", "method"})
    {
        const auto o = run(fmt::format("cost --{} nonsense -o FOLDER/cost", option));
        EXPECT_EQ(o.code, 2) << option;
        EXPECT_TRUE(says(o.err, fmt::format("there is no {} 'nonsense'; accepted: ", option)))
            << o.err;
    }
    for (const char* bad :
         {"--samples 3", "--samples x", "--seconds-per-picture -2", "--seconds-per-picture nan",
          "--seed -1", "--threads -1", "--planner-data FOLDER/not/there"})
        EXPECT_EQ(run(fmt::format("cost --quick {} -o FOLDER/cost", bad)).code, 2) << bad;
    EXPECT_FALSE(std::filesystem::exists(folder / "cost"));
    write("file", "");
    const auto taken = run("cost --quick -o FOLDER/file");
    EXPECT_EQ(taken.code, 2);
    EXPECT_TRUE(says(taken.err, "cannot make the folder")) << taken.err;
}

TEST_F(CostCommand, interrupted_it_leaves_no_file)
{
    EXPECT_EQ(interrupted(), 130);
    EXPECT_TRUE(std::filesystem::is_empty(folder / "cost"));
    EXPECT_FALSE(std::filesystem::exists(folder / "plan"));
}

TEST(Fronts, of_the_readme_are_those_of_the_page)
{
    const auto text_of = [](const std::string& file) {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    };
    const std::string page = text_of(REGAIN_DOCS "/cost-fronts.md"), heading = "\n## ggx\n\n";
    const auto from = page.find(heading) + heading.size(), to = page.find("\n\n", from);
    ASSERT_TRUE(from < to && to != page.npos);
    const std::string table = page.substr(from, to - from);
    // A row for each class.
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 6);
    EXPECT_TRUE(says(text_of(REGAIN_DOCS "/../README.md"), table));
}

TEST(ParetoFront, is_what_nothing_else_betters)
{
    using regain::tools::cost::pareto_front;
    using regain::tools::cost::Point;
    using Places = std::vector<std::size_t>;
    EXPECT_EQ(pareto_front({}), Places());
    EXPECT_EQ(pareto_front({{"a", 1, 1}}), Places{0});
    // b is slower and no nearer than a; d is as near as c and slower; e is as fast as a and worse.
    const std::vector<Point> points{{"c", 0.1, 2}, {"a", 0.5, 1}, {"b", 0.5, 1.5},
                                    {"d", 0.1, 3}, {"e", 0.6, 1}, {"f", 0, 9}};
    EXPECT_EQ(pareto_front(points), (Places{1, 0, 5}));
    // Of equal points the first.
    EXPECT_EQ(pareto_front({{"a", 1, 1}, {"b", 1, 1}}), Places{0});
}
