// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Subjects that are held to their promises in parts: the reports are one run's, but for times.

#include "command.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <regex>
#include <thread>

using test::says;

namespace {

std::string without_times(const std::string& text)
{
    static const std::regex times(R"(( time="[^"]*")|("seconds": [^,\n]*)|(; [0-9.e+-]+ s\n))");
    return std::regex_replace(text, times, "");
}

class ConformParts : public test::Command
{
protected:
    std::string reports(const std::string& name) const
    {
        return fmt::format(
            "--junit FOLDER/{0}.xml --json=FOLDER/{0}.json --markdown FOLDER/{0}.md "
            "--histograms FOLDER/{0}_histograms",
            name);
    }
    void expect_whole(const std::string& options, int of, int code) const
    {
        const auto whole = run("conform " + options + " " + reports("whole"));
        ASSERT_EQ(whole.code, code) << whole.err;
        for (int k = 1; k <= of; ++k)
        {
            const auto o =
                run(fmt::format("conform {} {} --part {}/{}", options, reports("parts"), k, of));
            // What failed is said when they are merged.
            ASSERT_EQ(o.code, 0) << o.err;
            EXPECT_FALSE(std::filesystem::exists(folder / "parts.xml"));
        }
        const auto merged = run(fmt::format("conform {} {} --merge FOLDER/parts.part-*-of-{}",
                                            options, reports("parts"), of));
        EXPECT_EQ(merged.code, code) << merged.err;
        EXPECT_EQ(without_times(merged.out), without_times(whole.out));
        for (const char* form : {".xml", ".json", ".md"})
        {
            const std::string one = read(std::string("whole") + form);
            ASSERT_FALSE(one.empty()) << form;
            EXPECT_EQ(without_times(read(std::string("parts") + form)), without_times(one));
        }
        std::size_t histograms = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "whole_histograms"))
        {
            const std::string name = entry.path().filename().string();
            ++histograms;
            EXPECT_TRUE(read("parts_histograms/" + name) == read("whole_histograms/" + name))
                << name;
        }
        EXPECT_EQ(histograms > 0, code == 1);
    }
};

const std::string wrong_pdf = "'" REGAIN_OBJECTS "/wrong_pdf.so'";

}  // namespace

TEST_F(ConformParts, merged_are_one_run_s_reports)
{
    expect_whole("--subject conductor.ggx.t --check C1 C4 C6", 3, 0);
}

// With failures and their histograms; a part without a subject of its own.
TEST_F(ConformParts, failures_are_all_there)
{
    expect_whole(wrong_pdf + " --check C1 C5 --seed-salt 3", 3, 1);
}

TEST_F(ConformParts, what_does_not_belong_together_is_refused)
{
    const std::string base = "conform " + wrong_pdf + " --check C4 ";
    for (const int k : {1, 2})
        ASSERT_EQ(run(fmt::format("{} --markdown FOLDER/a.md --part {}/2", base, k)).code, 0);
    const auto refused = [&](const std::string& options, const std::string& files) {
        const auto o = run(base + options + " --merge " + files);
        EXPECT_EQ(o.code, 2) << o.err;
        EXPECT_TRUE(o.out.empty()) << o.out;
        return o.err;
    };
    const std::string all = "FOLDER/a.part-1-of-2 FOLDER/a.part-2-of-2";
    EXPECT_TRUE(says(refused("", "FOLDER/a.part-2-of-2"), "1 is not given: 1"));
    EXPECT_TRUE(says(refused("", all + " FOLDER/a.part-2-of-2"), "is part 2/2, as is"));
    EXPECT_TRUE(says(refused("--seed-salt 5", all), "seed-salt: '0' there, '5' here"));
    EXPECT_TRUE(says(refused("--tier thorough", all), "tier: 'commit' there, 'thorough' here"));
}

TEST_F(ConformParts, bad_values_and_what_does_not_go_with_them_are_bad_input)
{
    for (const char* part : {"0/7", "8/7", "7", "x/7", "''"})
    {
        const auto o = run(std::string("conform --part ") + part);
        EXPECT_EQ(o.code, 2) << part;
        EXPECT_TRUE(says(o.err, "1 <= K <= N <= 100000")) << o.err;
    }
    for (const char* other : {"--repeat 3", "--list", "--list-checks", "--merge FOLDER/a"})
    {
        const auto o = run(std::string("conform --part 1/2 ") + other);
        EXPECT_EQ(o.code, 2) << other;
        EXPECT_TRUE(says(o.err, "does not go with")) << o.err;
    }
    const auto nobody = run("conform --subject nobody --part 1/2");
    EXPECT_EQ(nobody.code, 2);
    EXPECT_TRUE(says(nobody.err, "nothing to run")) << nobody.err;
}

TEST_F(ConformParts, one_that_is_stopped_leaves_nothing)
{
    const std::string report = (folder / "a.md").string();
    for (const int signal : {SIGINT, SIGKILL})
    {
        const pid_t child = ::fork();
        if (child == 0)
        {
            if (std::freopen((folder / "stderr").c_str(), "w", stderr))
                ::execl(REGAIN_BINARY, REGAIN_BINARY, "conform", "--tier", "thorough", "--markdown",
                        report.c_str(), "--part", "1/2", nullptr);
            ::_exit(127);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        ::kill(child, signal);
        int status = -1;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, signal == SIGINT ? 130 : -1);
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            EXPECT_EQ(entry.path().filename(), "stderr");
    }
}
