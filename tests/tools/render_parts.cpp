// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A picture that is rendered in parts is the picture that one run renders, to the bit.

#include "command.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

using test::says;

namespace {

class RenderParts : public test::Command
{
protected:
    void render_parts(const std::string& options, int of) const
    {
        for (int k = of; k >= 1; --k)
        {
            const auto o =
                run(fmt::format("render {} -o FOLDER/parts.exr --part {}/{} --quiet "
                                "--threads {}",
                                options, k, of, 1 + k % 2));
            ASSERT_EQ(o.code, 0) << o.err;
        }
    }
    void expect_whole(const std::string& options, int of) const
    {
        const auto whole = run("render " + options + " -o FOLDER/whole.exr --quiet");
        ASSERT_EQ(whole.code, 0) << whole.err;
        render_parts(options, of);
        const auto merged = run(
            fmt::format("render {} -o FOLDER/parts.exr --quiet --merge FOLDER/parts.part-*-of-{}",
                        options, of));
        ASSERT_EQ(merged.code, 0) << merged.err;
        // The files hold no date: attributes and pixels are the same where the bytes are.
        ASSERT_FALSE(read("whole.exr").empty());
        EXPECT_TRUE(read("parts.exr") == read("whole.exr")) << options;
        EXPECT_TRUE(read("parts.png") == read("whole.png")) << options;
    }
    // The exit code of a part that takes long, and gets a signal after a moment of work; -1 of one
    // that it killed.
    int stopped(int signal) const
    {
        const std::string output = (folder / "long.exr").string();
        const pid_t child = ::fork();
        if (child == 0)
        {
            if (std::freopen((folder / "stderr").c_str(), "w", stderr))
                ::execl(REGAIN_BINARY, REGAIN_BINARY, "render", "--size", "400x300", "--spp",
                        "65536", "-o", output.c_str(), "--part", "2/3", nullptr);
            ::_exit(127);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        ::kill(child, signal);
        int status = -1;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::vector<std::string> files() const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            names.push_back(entry.path().filename().string());
        return names;
    }
};

const std::string small = "--size 160x96 --spp 4 --alpha 0.2,0.6";

}  // namespace

TEST_F(RenderParts, merged_are_one_run_s_picture) { expect_whole(small, 7); }

TEST_F(RenderParts, the_same_by_each_host_with_layers_and_labels)
{
    expect_whole(small + " --host clarisse --aov albedo,method --labels", 3);
    expect_whole(small + " --host osl --method walk --seed 5", 2);
}

// Glass and documents.
TEST_F(RenderParts, the_same_of_other_materials)
{
    expect_whole("--size 96x96 --spp 4 --material glass --alpha 0.3 --furnace", 4);
    expect_whole("gold --select gold_satin --size 96x96 --spp 4 --difference FOLDER/whole.exr", 3);
}

TEST_F(RenderParts, more_parts_than_tiles_are_merged_all_the_same)
{
    expect_whole("--size 32x32 --spp 2 --alpha 0.5 --method none", 6);
}

TEST_F(RenderParts, a_part_is_the_same_whenever_it_is_run)
{
    render_parts(small, 2);
    const std::string first = read("parts.part-2-of-2");
    render_parts(small, 2);
    EXPECT_FALSE(first.empty());
    EXPECT_TRUE(read("parts.part-2-of-2") == first);
}

TEST_F(RenderParts, what_does_not_belong_together_is_refused)
{
    render_parts(small, 2);
    const auto refused = [&](const std::string& options, const std::string& files) {
        const auto o = run("render " + options + " -o FOLDER/parts.exr --quiet --merge " + files);
        EXPECT_EQ(o.code, 2) << o.err;
        return o.err;
    };
    const std::string all = "FOLDER/parts.part-1-of-2 FOLDER/parts.part-2-of-2";
    EXPECT_TRUE(says(refused(small, "FOLDER/parts.part-1-of-2"), "1 is not given: 2"));
    EXPECT_TRUE(says(refused(small, all + " FOLDER/parts.part-1-of-2"), "is part 1/2, as is"));
    EXPECT_TRUE(says(refused(small + " --seed 2", all), "seed: '1' there, '2' here"));
    EXPECT_TRUE(says(refused(small + " --bounces 3", all), "bounces: '16' there, '3' here"));
    const auto fewer = refused("--size 160x96 --spp 3 --alpha 0.2,0.6", all);
    EXPECT_TRUE(says(fewer, "spp: '4' there, '3' here")) << fewer;
    EXPECT_TRUE(says(refused(small, "FOLDER/none"), "none' cannot be read"));
    EXPECT_FALSE(std::filesystem::exists(folder / "parts.exr"));
}

TEST_F(RenderParts, a_document_that_was_changed_is_another_job)
{
    const auto document = [](double roughness) {
        return fmt::format(R"(<?xml version="1.0"?><materialx version="1.38">
  <conductor_bsdf name="b" type="BSDF"><input name="roughness" type="vector2" value="{0}, {0}"/></conductor_bsdf>
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
</materialx>)",
                           roughness);
    };
    const std::string options = "FOLDER/a.mtlx --size 64x64 --spp 1";
    write("a.mtlx", document(0.2));
    render_parts(options, 1);
    write("a.mtlx", document(0.3));
    const auto o =
        run("render " + options + " -o FOLDER/parts.exr --merge FOLDER/parts.part-1-of-1");
    EXPECT_EQ(o.code, 2);
    EXPECT_TRUE(says(o.err, "is of another job: contents of ")) << o.err;
}

TEST_F(RenderParts, bad_values_and_what_does_not_go_with_them_are_bad_input)
{
    for (const char* part : {"0/7", "8/7", "7", "1/100001", "x/7", "''", "-1/7"})
    {
        const auto o = run(std::string("render -o FOLDER/a.exr --part ") + part);
        EXPECT_EQ(o.code, 2) << part;
        EXPECT_TRUE(says(o.err, "1 <= K <= N <= 100000")) << o.err;
    }
    for (const char* other : {"--resume", "--turntable 4", "--watch", "--merge FOLDER/a"})
    {
        const auto o = run(std::string("render -o FOLDER/a.exr --part 1/2 ") + other);
        EXPECT_EQ(o.code, 2) << other;
        EXPECT_TRUE(says(o.err, "does not go with")) << o.err;
    }
    EXPECT_EQ(run("render -o FOLDER/a.exr --merge").code, 2);
    EXPECT_EQ(run("render -o FOLDER/none/a.exr --part 1/2").code, 2);
}

TEST_F(RenderParts, one_that_is_stopped_leaves_nothing)
{
    EXPECT_EQ(stopped(SIGTERM), 130);
    EXPECT_TRUE(says(read("stderr"), "long.part-2-of-3' was not written: run the part again"))
        << read("stderr");
    EXPECT_EQ(files(), std::vector<std::string>{"stderr"});
}

TEST_F(RenderParts, one_that_is_killed_leaves_nothing)
{
    EXPECT_EQ(stopped(SIGKILL), -1);
    EXPECT_EQ(files(), std::vector<std::string>{"stderr"});
}

TEST_F(RenderParts, a_part_says_what_it_is_of)
{
    const auto o = run("render " + small + " -o FOLDER/a.exr --part 2/7 --quiet --json");
    ASSERT_EQ(o.code, 0) << o.err;
    const auto json = o.json();
    EXPECT_EQ(json["part"], 2);
    EXPECT_EQ(json["parts"], 7);
    // 10 x 3 tiles, twice, by seven.
    EXPECT_EQ(json["of"], 60);
    EXPECT_GE(json["pieces"], 8);
    EXPECT_LE(json["pieces"], 9);
    EXPECT_TRUE(std::filesystem::exists(json["file"].get<std::string>()));
}
