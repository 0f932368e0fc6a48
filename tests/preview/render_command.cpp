// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The command as a user meets it: what it writes, what it refuses and how, and what an interrupt
// leaves.

#include "render_fixture.h"

#include <regain/shaders/color_config.h>

#include <unistd.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace regain::tools { namespace {

namespace fs = std::filesystem;

class RenderCommand : public RenderTest
{};

TEST_F(RenderCommand, WritesPicturesAndSaysHow)
{
    ASSERT_EQ(run({"-o", file("a.exr"), "--size", "64x48", "--spp", "2", "--alpha", "0.25,1",
                   "--seed", "7", "--metal", "copper", "--json", "--quiet"}),
              kDone)
        << err;
    const auto summary = nlohmann::json::parse(out);
    EXPECT_EQ(summary.at("exr"), file("a.exr"));
    EXPECT_EQ(summary.at("spp"), 2.0);
    EXPECT_EQ(summary.at("partial"), false);
    EXPECT_EQ(summary.at("non_finite"), 0);

    const auto exr = OIIO::ImageInput::open(file("a.exr"));
    ASSERT_TRUE(exr);
    EXPECT_EQ(exr->spec().width, 64);
    EXPECT_EQ(exr->spec().height, 48);
    EXPECT_EQ(exr->spec().format, OIIO::TypeDesc::HALF);
    EXPECT_EQ(attribute(file("a.exr"), "regain:method"), "none, directional");
    EXPECT_EQ(attribute(file("a.exr"), "regain:alpha"), "0.25, 1");
    EXPECT_EQ(attribute(file("a.exr"), "regain:metal"), "copper");
    EXPECT_EQ(attribute(file("a.exr"), "regain:seed"), "7");
    EXPECT_EQ(attribute(file("a.exr"), "regain:spp"), "2");
    EXPECT_EQ(attribute(file("a.exr"), "regain:partial"), "0");
    const auto png = OIIO::ImageInput::open(file("a.png"));
    ASSERT_TRUE(png);
    EXPECT_EQ(png->spec().width, 64);
}

TEST_F(RenderCommand, RendersGlassAndSaysSo)
{
    ASSERT_EQ(run({"-o",       file("a.exr"), "--size",         "32x32", "--spp",   "2",
                   "--alpha",  "0.3",         "--material",     "glass", "--ior",   "1.33",
                   "--object", "nested",      "--distribution", "gtr",   "--gamma", "1.5",
                   "--method", "walk",        "--environment",  "white", "--quiet"}),
              kDone)
        << err;
    for (const auto& [name, value] :
         std::vector<std::pair<const char*, const char*>>{{"regain:material", "glass"},
                                                          {"regain:ior", "1.33"},
                                                          {"regain:object", "nested"},
                                                          {"regain:distribution", "gtr"},
                                                          {"regain:gamma", "1.5"},
                                                          {"regain:method", "walk"},
                                                          {"regain:environment", "white"},
                                                          {"regain:bounces", "64"}})
        EXPECT_EQ(attribute(file("a.exr"), name), value) << name;
}

TEST_F(RenderCommand, FilesDoNotDependOnThreads)
{
    for (const std::string threads : {"1", "2"})
        ASSERT_EQ(run({"--size", "80x60", "--spp", "3", "--quiet", "-o", file(threads + ".exr"),
                       "--threads", threads}),
                  kDone)
            << err;
    EXPECT_EQ(bytes(file("1.exr")), bytes(file("2.exr")));
    EXPECT_EQ(bytes(file("1.png")), bytes(file("2.png")));
}

TEST_F(RenderCommand, RefusesBadInputBeforeItStarts)
{
    fs::create_directories(folder / "folder.exr");
    const struct
    {
        std::vector<std::string> arguments;
        const char* says;
    } cases[] = {
        {{"--spp", "0"}, "--spp 0: takes 1 to 65536"},
        {{"--spp", "many"}, "--spp"},
        {{"--seed", "-1"}, "--seed -1: takes 0 to 4294967295"},
        {{"--threads", "5000"}, "--threads 5000: takes 0 to 1024"},
        {{"--alpha", "0.5,1.5"}, "--alpha 1.5: takes"},
        {{"--alpha", "nan"}, "--alpha nan: takes"},
        {{"--alpha", "0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1"},
         "17 values"},
        {{"--metal", "mithril"}, "--metal mithril: "},
        {{"--method", "magic"}, "--method magic: no such method; there are none"},
        {{"--material", "jelly"}, "--material jelly: no such material"},
        {{"--material", "glass", "--ior", "0"}, "--ior 0: takes"},
        {{"--material", "glass", "--method", "series"}, "does not go with dielectrics"},
        {{"--distribution", "phong"}, "--distribution phong: no such distribution"},
        {{"--distribution", "std", "--gamma", "1.5"}, "--gamma 1.5: std takes"},
        {{"--object", "teapot"}, "--object teapot: no such object"},
        {{"--bounces", "5000"}, "--bounces 5000: takes"},
        {{"--host", "abacus"}, "--host abacus: no such host"},
        {{"--size", "0x10"}, "--size 0x10: takes WIDTHxHEIGHT"},
        {{"--size", "64x64x"}, "--size 64x64x: takes"},
        {{"--size", "99999x64"}, "--size 99999x64: takes"},
        {{"--display", "wall"}, "--display wall: no such display"},
        {{"--view", "sea"}, "--view sea: no such view"},
        {{"--environment", "nowhere.exr"}, "nowhere.exr: no such file"},
        {{"-o", file("a.png")}, "must end in .exr"},
        {{"-o", file("none/a.exr")}, "there is no folder"},
        // Where a superuser is let in, too, and yet no file can be made.
        {{"-o", "/proc/a.exr"}, "takes no file"},
        {{"-o", file("folder.exr")}, "is a folder"},
    };
    for (const auto& c : cases)
    {
        auto arguments = c.arguments;
        if (arguments.front() != "-o") arguments.insert(arguments.end(), {"-o", file("bad.exr")});
        EXPECT_EQ(run(arguments), kBadInput) << c.says;
        EXPECT_NE(err.find(c.says), std::string::npos) << c.says << "\nbut: " << err;
        EXPECT_FALSE(fs::exists(file("bad.exr")));
    }
}

// Gold is redder than Rec. 709 can say: 1.04 in the red channel.
TEST_F(RenderCommand, SaysWhenAMetalDoesNotFitTheWorkingSpace)
{
    const auto with_working_space = [&](const std::string& space) {
        std::string text = shaders::ColorConfig::builtin().text();
        const std::string role = "scene_linear: ACEScg";
        text.replace(text.find(role), role.size(), "scene_linear: " + space);
        std::ofstream(file("config.ocio")) << text;
        ::setenv("OCIO", file("config.ocio").c_str(), 1);
        EXPECT_EQ(run({"--size", "16x16", "--alpha", "0.5", "--method", "none", "--spp", "1",
                       "--quiet", "-o", file("a.exr")}),
                  kDone);
        ::unsetenv("OCIO");
        return err;
    };
    EXPECT_NE(with_working_space("lin_rec709").find("outside the working space"),
              std::string::npos);
    EXPECT_EQ(with_working_space("ACEScg"), "");
}

TEST_F(RenderCommand, InterruptLeavesAMarkedPicture)
{
    std::thread user([] {
        // Not before the command listens: the default action would end this program.
        struct sigaction now = {};
        do
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(300));
            ::sigaction(SIGINT, nullptr, &now);
        } while (now.sa_handler == SIG_DFL);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        ::kill(::getpid(), SIGINT);
    });
    const int exit_code = run({"-o", file("stopped.exr"), "--size", "64x48", "--spp", "65536"});
    user.join();
    EXPECT_EQ(exit_code, kInterrupted) << err;
    EXPECT_EQ(attribute(file("stopped.exr"), "regain:partial"), "1");
    EXPECT_TRUE(fs::exists(file("stopped.png")));
    EXPECT_NE(out.find("interrupted"), std::string::npos) << out;

    // And what to go on from.
    ASSERT_TRUE(fs::exists(file("stopped.resume.exr")));
    EXPECT_EQ(run({"-o", file("stopped.exr"), "--size", "64x48", "--resume", "--seed", "2"}),
              kBadInput);
    EXPECT_NE(err.find("it is of another render"), std::string::npos) << err;
    EXPECT_TRUE(fs::exists(file("stopped.resume.exr")));
    EXPECT_EQ(run({"-o", file("stopped.exr"), "--size", "64x48", "--spp", "2", "--resume"}), kDone)
        << err;
    EXPECT_EQ(attribute(file("stopped.exr"), "regain:partial"), "0");
    EXPECT_FALSE(fs::exists(file("stopped.resume.exr")));
}

TEST_F(RenderCommand, HelpHasExamples)
{
    EXPECT_EQ(run({"--help"}), kDone);
    EXPECT_NE(out.find("Examples:"), std::string::npos);
}

}}  // namespace regain::tools
