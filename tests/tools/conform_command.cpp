// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "command.h"

#include "conform_subjects.h"

#include <regain/conformance/run.h>

#include <OpenImageIO/imageio.h>
#include <signal.h>
#include <unistd.h>
#include <pugixml.hpp>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

using nlohmann::json;
using test::says;

namespace {

class ConformCommand : public test::Command
{
protected:
    // Of an object, alone and so quick.
    static std::string object(const std::string& name)
    {
        return std::string("'" REGAIN_OBJECTS "/") + name + ".so'";
    }
    // Runs what a failure says, which calls the program by its name alone.
    int reproduce(std::string command) const
    {
        const std::string name = "regain conform ";
        EXPECT_EQ(command.find(name), 0u) << command;
        return run(command.substr(std::string("regain ").size())).code;
    }
    std::vector<std::string> names_in(const std::string& name) const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder / name))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }
};

}  // namespace

TEST_F(ConformCommand, a_good_shared_object_passes)
{
    const auto o = run("conform " + object("good"));
    EXPECT_EQ(o.code, 0) << o.out << o.err;
    EXPECT_TRUE(says(o.out, "2 subjects, tier commit: ")) << o.out;
    EXPECT_TRUE(says(o.out, "\nlambert   passed ")) << o.out;
}

TEST_F(ConformCommand, a_failure_comes_with_a_command_that_fails_again)
{
    const auto o = run("conform " + object("wrong_pdf") + " --check C4 --json --seed-salt 7");
    EXPECT_EQ(o.code, 1) << o.err;
    const json report = o.json();
    std::size_t failures = 0;
    for (const json& verdict : report["verdicts"])
    {
        EXPECT_EQ(verdict["result"], verdict["subject"] == "lambert" ? "failed" : "passed");
        for (const json& failure : verdict["failures"])
        {
            const std::string command = failure["reproduce"];
            EXPECT_TRUE(says(command, "wrong_pdf.so")) << command;
            EXPECT_TRUE(says(command, "--seed-salt 7")) << command;
            EXPECT_NEAR(failure["measured"].get<double>(), 0.1, 1e-6) << failure;
            // One stands for all: each takes a second look.
            if (failures++ > 0) continue;
            EXPECT_EQ(reproduce(command), 1) << command;
        }
    }
    EXPECT_GT(failures, 0u);
}

TEST_F(ConformCommand, a_closure_that_cannot_be_made_fails)
{
    const auto o = run("conform " + object("not_finite") + " --check C3 C13");
    EXPECT_EQ(o.code, 1) << o.err;
    EXPECT_TRUE(says(o.out, "lambert2  FAILED")) << o.out;
}

TEST_F(ConformCommand, all_reports_agree)
{
    const auto o = run("conform " + object("wrong_pdf") +
                       " --check C3 C4 --json=FOLDER/r.json --junit FOLDER/r.xml "
                       "--markdown FOLDER/r.md");
    EXPECT_EQ(o.code, 1) << o.err;
    const json j = json::parse(read("r.json"));
    pugi::xml_document xml;
    ASSERT_TRUE(xml.load_file((folder / "r.xml").c_str()));
    ASSERT_EQ(j["verdicts"].size(), 4u);
    for (const json& v : j["verdicts"])
    {
        const std::string check = v["check"], subject = v["subject"];
        const std::string path =
            "//testcase[@classname='" + subject + "'][starts-with(@name, '" + check + " ')]";
        const pugi::xml_node node = xml.select_node(path.c_str()).node();
        ASSERT_FALSE(node.empty()) << path;
        EXPECT_EQ(!node.child("failure").empty(), v["result"] == "failed") << path;
        EXPECT_TRUE(says(read("r.md"), "| `" + subject + "` |"));
    }
    EXPECT_TRUE(says(read("r.md"), "**FAILED**"));
}

TEST_F(ConformCommand, histograms_of_what_does_not_follow_the_pdf_are_written)
{
    const auto o = run("conform " + object("wrong_pdf") +
                       " --check C5 --setting double,mu=0.7 --histograms FOLDER/new/h");
    EXPECT_EQ(o.code, 1) << o.err;
    const std::string base = "lambert_C5_double,mu=0.7";
    EXPECT_EQ(names_in("new/h"), (std::vector<std::string>{base + ".exr", base + ".png"}));
    const auto exr = OIIO::ImageInput::open((folder / "new/h" / (base + ".exr")).string());
    ASSERT_TRUE(exr);
    const auto png = OIIO::ImageInput::open((folder / "new/h" / (base + ".png")).string());
    ASSERT_TRUE(png);
    // Three panels of three pixels a cell, and two gaps.
    EXPECT_EQ(png->spec().width, 9 * exr->spec().width + 12);
    EXPECT_EQ(png->spec().height, 3 * exr->spec().height);

    // Where the closure reflects, too few were found; below the horizon none, and none expected.
    const auto pixels = [&](int x, int y) {
        std::vector<std::uint8_t> all(
            static_cast<std::size_t>(3 * png->spec().width * png->spec().height));
        EXPECT_TRUE(png->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, all.data()));
        const auto at = static_cast<std::size_t>(3 * (y * png->spec().width + x));
        return std::array<int, 3>{all[at], all[at + 1], all[at + 2]};
    };
    const int last_x = png->spec().width - 1, last_y = png->spec().height - 1;
    EXPECT_GT(pixels(last_x, 0)[2], pixels(last_x, 0)[0]) << "blue";
    EXPECT_EQ(pixels(last_x, last_y), (std::array<int, 3>{247, 247, 247}));
    EXPECT_EQ(pixels(0, last_y), (std::array<int, 3>{68, 1, 84})) << "none, of viridis";
}

TEST_F(ConformCommand, repetition_counts_false_alarms)
{
    const auto good = run("conform " + object("good") + " --check C4 C7 --repeat 5 --json");
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_EQ(good.json()["runs"], 5);
    EXPECT_EQ(good.json()["runs_with_alarm"], 0);
    const auto wrong = run("conform " + object("wrong_pdf") + " --check C4 --repeat 2");
    EXPECT_EQ(wrong.code, 1) << wrong.err;
    EXPECT_TRUE(says(wrong.out, "2 of 2 runs raised an alarm; 0.002 expected")) << wrong.out;
    EXPECT_TRUE(says(wrong.out, "--seed-salt 2")) << wrong.out;
}

TEST_F(ConformCommand, the_same_run_says_the_same)
{
    const std::string line = "conform " + object("good") + " --check C4 C6 --markdown FOLDER/";
    ASSERT_EQ(run(line + "one.md --threads 1").code, 0);
    ASSERT_EQ(run(line + "two.md --threads 4").code, 0);
    ASSERT_EQ(run(line + "other.md --seed-salt 1").code, 0);
    EXPECT_EQ(read("one.md"), read("two.md"));
    EXPECT_NE(read("one.md"), read("other.md"));
}

TEST_F(ConformCommand, lists_subjects_and_checks)
{
    const auto own = run("conform --list");
    EXPECT_EQ(own.code, 0);
    EXPECT_EQ(own.lines().size(), regain::tools::built_in_subjects().size());
    EXPECT_TRUE(says(own.out, "conductor.ggx.turquin\n"));
    EXPECT_EQ(run("conform --list " + object("good")).out, "lambert\nlambert2\n");
    const auto checks = run("conform --list-checks");
    EXPECT_EQ(checks.code, 0);
    EXPECT_EQ(checks.lines().size(), regain::conformance::all_checks().size());
}

TEST_F(ConformCommand, a_broken_table_hides_no_subject)
{
    write("beckmann_E_ss.exr", "no picture");
    ::setenv("REGAIN_LUTS", folder.c_str(), 1);
    const auto o = run("conform --list");
    ::unsetenv("REGAIN_LUTS");
    EXPECT_EQ(o.code, 2);
    EXPECT_EQ(o.out, "");
    EXPECT_TRUE(says(o.err, (folder / "beckmann_E_ss.exr").string())) << o.err;
}

TEST_F(ConformCommand, a_whole_name_means_one_subject)
{
    const auto one = run("conform " + object("good") + " --subject lambert --check C3 --json");
    EXPECT_EQ(one.json()["verdicts"].size(), 1u);
    const auto part = run("conform " + object("good") + " --subject lamb --check C3 --json");
    EXPECT_EQ(part.json()["verdicts"].size(), 2u);
}

TEST_F(ConformCommand, wrong_arguments_are_bad_input_and_write_nothing)
{
    write("file", "");
    write("text.so", "no object");
    for (const auto& [arguments, part] : std::vector<std::pair<std::string, std::string>>{
             {"FOLDER/none.so", "none.so': there is no such file"},
             {"FOLDER/text.so", "cannot be loaded as a shared object"},
             {object("newer"), "this kit knows 1 to 1"},
             {object("good") + " " + object("good"), "two subjects are called 'lambert'"},
             {"FOLDER/report.json", "--json=FOLDER/report.json"},
             {"--subject nothing", "no subject's name has 'nothing' in it"},
             {object("good") + " --check C99", "no check is called 'C99'; there are C"},
             {object("good") + " --setting double,mu=2", "'double,mu=2'"},
             {object("good") + " --tier nightly", "nightly"},
             {object("good") + " --seed-salt -1", "seed-salt"},
             {object("good") + " --threads 0", "threads"},
             {object("good") + " --repeat 0", "repeat"},
             {object("good") + " --repeat 2 --check C3", "C3 is not decided by chance"},
             {object("good") + " --repeat 2 --junit FOLDER/out", "--repeat writes no files"},
             {object("good") + " --repeat 2 --seed-salt 3", "leave out --seed-salt"},
             {object("good") + " --junit FOLDER/none/out", "there is no folder"},
             {object("good") + " --markdown FOLDER", "it is a folder"},
             {object("good") + " --json=FOLDER/out --junit FOLDER/./out", "two reports"},
             {object("good") + " --histograms FOLDER/file", "cannot write to the folder"},
             {object("good") + " --chekc C4", "chekc"}})
    {
        const auto o = run("conform " + arguments);
        EXPECT_EQ(o.code, 2) << arguments;
        std::string expected = part;
        if (const auto at = expected.find("FOLDER"); at != std::string::npos)
            expected.replace(at, 6, folder.string());
        EXPECT_TRUE(says(o.err, expected)) << arguments << ": " << o.err;
        EXPECT_EQ(o.out, "") << arguments;
    }
    std::vector<std::string> left = names_in(".");
    EXPECT_EQ(left, (std::vector<std::string>{"file", "stderr", "stdin", "stdout", "text.so"}));
}

TEST_F(ConformCommand, an_interrupt_leaves_a_partial_report)
{
    const std::string file = "--json=" + (folder / "r.json").string();
    const std::string shown = (folder / "shown").string();
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
    {
        if (!std::freopen(shown.c_str(), "w", stderr)) ::_exit(126);
        ::execl(REGAIN_BINARY, REGAIN_BINARY, "conform", "--tier", "thorough", "--subject",
                "conductor.ggx.none", file.c_str(), "--threads", "1", static_cast<char*>(nullptr));
        ::_exit(127);
    }
    // Once it tells of progress, it listens.
    for (int i = 0; i < 3000 && !says(read("shown"), "conform: "); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::kill(child, SIGINT);
    int status = -1;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 130);
    const json report = json::parse(read("r.json"));
    EXPECT_EQ(report["interrupted"], true);
    for (const json& v : report["verdicts"])
    {
        if (v["result"] != "not applicable") continue;
        EXPECT_NE(v["reason"], "") << v;
    }
}

// docs/conformance.md has what `regain conform --markdown` wrote last; a closure
// that has come since is missing in it.
TEST_F(ConformCommand, the_documented_results_have_every_closure_and_no_failure)
{
    std::ifstream in(REGAIN_DOCS "/conformance.md");
    const std::string results{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_GT(regain::tools::built_in_subjects().size(), 130u);
    for (const auto* subject : regain::tools::built_in_subjects())
        EXPECT_TRUE(says(results, "| `" + subject->name() + "` |")) << subject->name();
    EXPECT_FALSE(says(results, "**FAILED**"));
}

TEST_F(ConformCommand, help_has_examples_and_the_guide_every_check)
{
    const auto o = run("conform --help");
    EXPECT_EQ(o.code, 0);
    EXPECT_TRUE(says(o.out, "examples:"));
    std::ostringstream guide;
    guide << std::ifstream(REGAIN_DOCS "/conformance-kit.md").rdbuf();
    for (const auto& c : regain::conformance::all_checks())
        EXPECT_TRUE(says(guide.str(), "\n| " + c.id + " | "))
            << "docs/conformance-kit.md says nothing of " << c.id << ": " << c.title;
}
