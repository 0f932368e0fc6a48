// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "command.h"

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>
#include <regain/luts/exr.h>

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

using nlohmann::json;
using test::says;

namespace {

class BakeCommand : public test::Command
{
protected:
    std::size_t files() const
    {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(folder / "tables"), {}));
    }
    // The exit code of baking these tables to FOLDER/tables, interrupted once a file is there. What
    // it says goes to FOLDER/stderr.
    int interrupted(const std::vector<std::string>& names, const std::filesystem::path& file) const
    {
        const std::string output = (folder / "tables").string(),
                          said = (folder / "stderr").string();
        std::vector<const char*> arguments{REGAIN_BINARY, "bake", "-o", output.c_str()};
        for (const std::string& name : names) arguments.push_back(name.c_str());
        arguments.push_back(nullptr);
        const pid_t child = ::fork();
        if (child == 0)
        {
            if (std::freopen(said.c_str(), "w", stderr) && std::freopen("/dev/null", "w", stdout))
                ::execv(REGAIN_BINARY, const_cast<char* const*>(arguments.data()));
            ::_exit(127);
        }
        for (int i = 0; i < 2000 && !std::filesystem::exists(file); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        ::kill(child, SIGINT);
        int status = -1;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    // The shipped table with one number changed.
    std::string tampered() const
    {
        const regain::luts::Table shipped =
            regain::luts::read_table(REGAIN_TABLES "/ggx_E_avg.exr");
        std::vector<float> values = shipped.values();
        values[7] += 1e-3f;
        const std::filesystem::path file = folder / "tampered.exr";
        regain::luts::write_table(file, regain::luts::Table(shipped.info(), shipped.width(),
                                                            shipped.height(), 1, values));
        return file.string();
    }
};

}  // namespace

TEST_F(BakeCommand, writes_the_table_that_is_shipped)
{
    const auto o = run("bake ggx_E_avg -o FOLDER/new/tables --embed FOLDER/embedded --json");
    ASSERT_EQ(o.code, 0) << o.err;
    const json report = o.json();
    ASSERT_EQ(report.size(), 1u);
    EXPECT_EQ(report[0]["table"], "ggx_E_avg");
    EXPECT_EQ(report[0]["width"], 32);
    EXPECT_LT(report[0]["error"], 1e-3);
    EXPECT_EQ(report[0]["files"].size(), 2u);

    const auto table = regain::luts::read_table(folder / "new/tables/ggx_E_avg.exr");
    const regain::TableView shipped = regain::luts::builtin_table("ggx_E_avg");
    for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(table.stored()[i], shipped.data[i]);
    EXPECT_TRUE(says(read("embedded/ggx_E_avg.inc"), "constexpr TableView ggx_E_avg"));
}

TEST_F(BakeCommand, verify_passes_what_is_shipped)
{
    const auto o = run("bake --verify ggx_E_avg " REGAIN_TABLES "/ggx_E_avg.exr --json");
    EXPECT_EQ(o.code, 0) << o.err;
    const json report = o.json();
    ASSERT_EQ(report.size(), 2u);
    for (const json& check : report) EXPECT_TRUE(check["passed"]) << check;
    EXPECT_EQ(report[0]["against"], "compiled in");
}

TEST_F(BakeCommand, verify_names_the_node_that_was_tampered_with)
{
    const auto o = run("bake --verify " + tampered());
    EXPECT_EQ(o.code, 1);
    EXPECT_TRUE(says(o.out, "same   ggx_E_avg")) << o.out;
    EXPECT_TRUE(says(o.out, "DIFFER ggx_E_avg")) << o.out;
    EXPECT_TRUE(says(o.out, "node (7, 0): shipped ")) << o.out;
    EXPECT_TRUE(says(o.err, "1 of 2 tables")) << o.err;
}

TEST_F(BakeCommand, spots_of_all_tables_are_quick)
{
    const auto o = run("bake --verify --spot 10 --json");
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.json().size(), regain::luts::compiled_in_tables().size());
    EXPECT_EQ(o.json()[0]["numbers"], 10);
}

TEST_F(BakeCommand, verify_finds_the_files_of_tables_that_are_not_compiled_in)
{
    const auto o =
        run("bake --verify beckmann_E_avg gtr_E_ss ggx_E_S_correlated_inside --spot 5 --json");
    EXPECT_EQ(o.code, 0) << o.err;
    const json report = o.json();
    ASSERT_EQ(report.size(), 3u);
    for (const json& check : report)
    {
        EXPECT_TRUE(check["passed"]) << check;
        EXPECT_TRUE(says(check["against"].get<std::string>(), ".exr"));
        EXPECT_EQ(check["numbers"], 5);
    }
}

TEST_F(BakeCommand, a_corrupt_file_is_bad_input)
{
    write("broken.exr", "no picture");
    const auto broken = run("bake --verify FOLDER/broken.exr");
    EXPECT_EQ(broken.code, 2);
    EXPECT_TRUE(says(broken.err, "broken.exr")) << broken.err;

    std::ifstream whole(REGAIN_TABLES "/ggx_E_ss.exr", std::ios::binary);
    std::ostringstream text;
    text << whole.rdbuf();
    write("cut.exr", text.str().substr(0, text.str().size() / 2));
    const auto cut = run("bake --verify FOLDER/cut.exr");
    EXPECT_EQ(cut.code, 2);
    EXPECT_TRUE(says(cut.err, "cannot use table")) << cut.err;
}

TEST_F(BakeCommand, a_file_that_is_not_there_is_bad_input)
{
    const auto o = run("bake --verify FOLDER/none.exr");
    EXPECT_EQ(o.code, 2);
    EXPECT_TRUE(says(o.err, "none.exr")) << o.err;
}

TEST_F(BakeCommand, an_output_that_cannot_be_written_is_told_before_baking)
{
    // Root may write anywhere, but not below a file.
    write("file", "");
    for (const char* option : {"-o", "--embed"})
    {
        const auto o = run(std::string("bake ") + option + " FOLDER/file/tables");
        EXPECT_EQ(o.code, 2);
        EXPECT_TRUE(says(o.err, "cannot write to the folder")) << o.err;
        EXPECT_EQ(o.out, "");
    }
    EXPECT_EQ(run("bake -o FOLDER/file").code, 2);
}

TEST_F(BakeCommand, wrong_arguments_are_bad_input)
{
    for (const auto& [arguments, part] : std::vector<std::pair<std::string, std::string>>{
             {"", "nothing to do"},
             {"ggx_E_sss -o FOLDER", "no table is called 'ggx_E_sss'"},
             {"gtr_0_E_S_beta_inside -o FOLDER", "its gamma is not within"},
             {"--gamma 2 -o FOLDER", "--gamma belongs to --distribution"},
             {"--distribution ggx --gamma 2 -o FOLDER", "ggx has no gamma"},
             {"--distribution phong -o FOLDER", "phong"},
             {"--verify gtr_1.3_E_S_beta_inside", "there is no file of the table"},
             {"-o FOLDER --spot 3", "--spot belongs to --verify"},
             {"--verify -o FOLDER", "--verify writes nothing"},
             {"--verify --spot 0", "spot"},
             {"--verfiy", "verfiy"}})
    {
        const auto o = run("bake " + arguments);
        EXPECT_EQ(o.code, 2) << arguments;
        EXPECT_TRUE(says(o.err, part)) << arguments << ": " << o.err;
    }
}

TEST_F(BakeCommand, exports_formulas_in_the_language_of_the_extension)
{
    for (const std::string language : {"glsl", "osl"})
    {
        const std::string file = "fits." + language;
        const auto o = run("bake --export FOLDER/" + file + " --json");
        ASSERT_EQ(o.code, 0) << o.err;
        EXPECT_EQ(o.json()["language"], language);
        const std::string text = read(file);
        for (const json& name : o.json()["functions"])
            EXPECT_TRUE(says(text, "\nfloat " + name.get<std::string>() + "(float ")) << name;
        EXPECT_TRUE(says(text, "SPDX-License-Identifier"));
    }
    EXPECT_TRUE(says(run("bake --export FOLDER/fits.glsl").out, "fits.glsl: 8 functions"));
}

TEST_F(BakeCommand, an_export_that_cannot_be_is_bad_input)
{
    for (const auto& [arguments, part] : std::vector<std::pair<std::string, std::string>>{
             {"--export FOLDER/fits.hlsl", "accepted: .glsl, .osl"},
             {"--export FOLDER/fits", "accepted: .glsl, .osl"},
             {"--export FOLDER/none/fits.osl", "there is no folder"},
             {"--export FOLDER/fits.osl ggx_E_ss", "no table"},
             {"--export FOLDER/fits.osl --verify", "no table"},
             {"--export FOLDER/fits.osl -o FOLDER", "no table"}})
    {
        const auto o = run("bake " + arguments);
        EXPECT_EQ(o.code, 2) << arguments;
        EXPECT_TRUE(says(o.err, part)) << arguments << ": " << o.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "fits.osl"));
}

TEST_F(BakeCommand, an_interrupt_leaves_nothing_behind)
{
    // Once there is the folder, it bakes.
    EXPECT_EQ(interrupted({"gtr_E_ss"}, folder / "tables"), 130);
    EXPECT_EQ(files(), 0u);
    EXPECT_TRUE(says(read("stderr"), "stopped, 0 of 1 tables were written")) << read("stderr");
}

TEST_F(BakeCommand, an_interrupt_leaves_the_tables_that_are_done)
{
    EXPECT_EQ(interrupted({"beckmann_E_avg", "gtr_E_ss"}, folder / "tables/beckmann_E_avg.exr"),
              130);
    EXPECT_EQ(files(), 1u);
    EXPECT_EQ(regain::luts::read_table(folder / "tables/beckmann_E_avg.exr").name(),
              "beckmann_E_avg");
    EXPECT_TRUE(says(read("stderr"), "stopped, 1 of 2 tables were written")) << read("stderr");
}

TEST_F(BakeCommand, help_has_examples)
{
    const auto o = run("bake --help");
    EXPECT_EQ(o.code, 0);
    EXPECT_TRUE(says(o.out, "examples:"));
}
