// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Tables that are baked in parts are the tables that one run bakes, to the bit.

#include "command.h"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

using test::says;

namespace {

class BakeParts : public test::Command
{
protected:
    void bake_parts(const std::string& options, int of) const
    {
        for (int k = of; k >= 1; --k)
        {
            const auto o = run(fmt::format("bake {} -o FOLDER/parts --part {}/{}", options, k, of));
            ASSERT_EQ(o.code, 0) << o.err;
        }
    }
    // The exit code of a part that takes minutes, and gets a signal; -1 of one that it killed.
    int stopped(int signal) const
    {
        const std::string output = (folder / "long").string();
        const pid_t child = ::fork();
        if (child == 0)
        {
            if (std::freopen((folder / "stderr").c_str(), "w", stderr))
                ::execl(REGAIN_BINARY, REGAIN_BINARY, "bake", "gtr_E_ss", "gtr_balance", "-o",
                        output.c_str(), "--part", "2/3", nullptr);
            ::_exit(127);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        ::kill(child, signal);
        int status = -1;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
};

}  // namespace

TEST_F(BakeParts, merged_are_one_run_s_tables)
{
    // E_ss and dip are made of the same integrals, E_avg of a single row of them.
    const std::string tables = "ggx_E_ss ggx_E_avg ggx_dip";
    ASSERT_EQ(run("bake " + tables + " -o FOLDER/whole --embed FOLDER/whole").code, 0);
    bake_parts(tables, 7);
    EXPECT_FALSE(std::filesystem::exists(folder / "parts/ggx_E_ss.exr"));
    const auto merged = run("bake " + tables +
                            " -o FOLDER/parts --embed FOLDER/parts --json --merge "
                            "FOLDER/parts/ggx_E_ss.part-*-of-7");
    ASSERT_EQ(merged.code, 0) << merged.err;
    EXPECT_EQ(merged.json().size(), 3u);
    for (const char* name : {"ggx_E_ss", "ggx_E_avg", "ggx_dip"})
        for (const char* form : {".exr", ".inc"})
        {
            const std::string file = std::string(name) + form;
            ASSERT_FALSE(read("whole/" + file).empty()) << file;
            EXPECT_TRUE(read("parts/" + file) == read("whole/" + file)) << file;
        }
}

TEST_F(BakeParts, more_parts_than_rows_are_merged_all_the_same)
{
    ASSERT_EQ(run("bake ggx_E_avg -o FOLDER/whole").code, 0);
    bake_parts("ggx_E_avg", 4);
    ASSERT_EQ(run("bake ggx_E_avg -o FOLDER/parts --merge FOLDER/parts/ggx_E_avg.part-*").code, 0);
    EXPECT_TRUE(read("parts/ggx_E_avg.exr") == read("whole/ggx_E_avg.exr"));
}

TEST_F(BakeParts, what_does_not_belong_together_is_refused)
{
    bake_parts("ggx_E_avg", 2);
    const auto refused = [&](const std::string& tables, const std::string& files) {
        const auto o = run("bake " + tables + " -o FOLDER/parts --merge " + files);
        EXPECT_EQ(o.code, 2) << o.err;
        return o.err;
    };
    const std::string all = "FOLDER/parts/ggx_E_avg.part-1-of-2 FOLDER/parts/ggx_E_avg.part-2-of-2";
    EXPECT_TRUE(says(refused("ggx_E_avg", "FOLDER/parts/ggx_E_avg.part-2-of-2"),
                     "of 2 parts 1 is not given: 1"));
    EXPECT_TRUE(
        says(refused("ggx_E_avg", all + " FOLDER/parts/ggx_E_avg.part-2-of-2"), "is part 2/2"));
    EXPECT_TRUE(says(refused("beckmann_E_avg", all),
                     "is of another job: tables: 'ggx_E_avg' there, 'beckmann_E_avg' here"));
    EXPECT_TRUE(says(refused("ggx_E_avg ggx_E_ss", all), "is of another job: tables: "));
    EXPECT_FALSE(std::filesystem::exists(folder / "parts/ggx_E_avg.exr"));
}

TEST_F(BakeParts, bad_values_and_what_does_not_go_with_them_are_bad_input)
{
    for (const char* part : {"0/7", "8/7", "7", "x/7", "''"})
    {
        const auto o = run(std::string("bake ggx_E_avg -o FOLDER/a --part ") + part);
        EXPECT_EQ(o.code, 2) << part;
        EXPECT_TRUE(says(o.err, "1 <= K <= N <= 100000")) << o.err;
    }
    for (const char* other : {"-o FOLDER/a --merge FOLDER/b", "--verify", "--export FOLDER/a.osl"})
    {
        const auto o = run(std::string("bake --part 1/2 ") + other);
        EXPECT_EQ(o.code, 2) << other;
        EXPECT_TRUE(says(o.err, "does not go with")) << o.err;
    }
    EXPECT_EQ(run("bake ggx_E_avg --part 1/2").code, 2);
}

TEST_F(BakeParts, one_that_is_stopped_leaves_nothing)
{
    EXPECT_EQ(stopped(SIGINT), 130);
    EXPECT_TRUE(says(read("stderr"), "gtr_E_ss.part-2-of-3' was not written: run the part again"))
        << read("stderr");
    EXPECT_TRUE(std::filesystem::is_empty(folder / "long"));
    EXPECT_EQ(stopped(SIGKILL), -1);
    EXPECT_TRUE(std::filesystem::is_empty(folder / "long"));
}
