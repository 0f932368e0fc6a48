// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// `regain render` with documents and presets: what is shown, chosen, changed and compared, and what
// is refused.

#include "../support/price_list.h"
#include "render_fixture.h"

#include <unistd.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <thread>

namespace regain::tools { namespace {

class RenderDocuments : public RenderTest
{
protected:
    using Arguments = std::vector<std::string>;

    // Two materials: white metal of a width, and dull grey.
    std::string document() const
    {
        return temporary
            .write("two.mtlx",
                   "<materialx version='1.39'>\n"
                   "<generalized_schlick_bsdf name='m' type='BSDF'><input name='roughness' "
                   "type='vector2' value='0.4, 0.4'/></generalized_schlick_bsdf>\n"
                   "<surface name='sm' type='surfaceshader'><input name='bsdf' type='BSDF' "
                   "nodename='m'/></surface>\n"
                   "<surfacematerial name='Bright_Metal' type='material'><input "
                   "name='surfaceshader' type='surfaceshader' nodename='sm'/></surfacematerial>\n"
                   "<oren_nayar_diffuse_bsdf name='d' type='BSDF'><input name='color' "
                   "type='color3' value='0.5, 0.5, 0.5'/></oren_nayar_diffuse_bsdf>\n"
                   "<surface name='sd' type='surfaceshader'><input name='bsdf' type='BSDF' "
                   "nodename='d'/></surface>\n"
                   "<surfacematerial name='Dull' type='material'><input name='surfaceshader' "
                   "type='surfaceshader' nodename='sd'/></surfacematerial>\n"
                   "</materialx>\n")
            .string();
    }
    int quick(const std::string& name, const Arguments& more, const char* samples = "8",
              const char* size = "48x24")
    {
        Arguments all{"-o",    file(name), "--size", size,     "--spp",
                      samples, "--object", "sphere", "--quiet"};
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    }
    bool said(const std::string& what) const { return err.find(what) != std::string::npos; }
    // Of the columns from `from` to `to`, of all channels of the picture.
    std::vector<double> columns(const std::string& exr, const std::string& channel = "G") const
    {
        const auto in = OIIO::ImageInput::open(exr);
        if (!in) return {};
        const auto& spec = in->spec();
        const auto at = std::find(spec.channelnames.begin(), spec.channelnames.end(), channel) -
                        spec.channelnames.begin();
        std::vector<float> p(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
        in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, p.data());
        std::vector<double> sums(static_cast<std::size_t>(spec.width));
        for (int y = 0; y < spec.height; ++y)
            for (int x = 0; x < spec.width; ++x)
                sums[static_cast<std::size_t>(x)] +=
                    double(
                        p[static_cast<std::size_t>((y * spec.width + x) * spec.nchannels + at)]) /
                    spec.height;
        return sums;
    }
};

TEST_F(RenderDocuments, EachMaterialIsAnObject)
{
    for (const char* host : {"renderman", "clarisse", "osl"})
    {
        ASSERT_EQ(quick("a.exr", {document(), "--host", host}), kDone) << err;
        EXPECT_EQ(attribute(file("a.exr"), "regain:materials"), "Bright_Metal, Dull");
        EXPECT_EQ(attribute(file("a.exr"), "regain:documents"), document());
        EXPECT_EQ(attribute(file("a.exr"), "regain:method"), "recommended");
        EXPECT_EQ(attribute(file("a.exr"), "regain:host"), host);
    }
    ASSERT_EQ(quick("b.exr", {document(), "gold", "--select", "Dull", "--select", "gold_satin"}),
              kDone)
        << err;
    EXPECT_EQ(attribute(file("b.exr"), "regain:materials"), "Dull, gold_satin");
}

TEST_F(RenderDocuments, AFurnaceShowsWhatIsLost)
{
    const auto metal = [&](const char* method) {
        EXPECT_EQ(
            quick("a.exr",
                  {document(), "--select", "Bright_Metal", "--furnace", "--method", method}, "32"),
            kDone)
            << err;
        return mean(file("a.exr"));
    };
    EXPECT_NEAR(metal("directional"), 1, 5e-3);
    EXPECT_LT(metal("none"), 0.97);
    // The picture for the display is taller by its scale, and white where nothing is lost.
    const auto png = OIIO::ImageInput::open(file("a.png"));
    ASSERT_TRUE(png);
    EXPECT_GT(png->spec().height, 24);
    std::vector<unsigned char> p(
        static_cast<std::size_t>(png->spec().width * png->spec().height * 3));
    ASSERT_TRUE(png->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, p.data()));
    EXPECT_EQ(int(p[0]), 247);
    EXPECT_EQ(int(p[1]), 247);
    const std::size_t middle = static_cast<std::size_t>((12 * png->spec().width + 24) * 3);
    EXPECT_LT(int(p[middle]), int(p[middle + 2]) - 50) << "blue is less";
}

TEST_F(RenderDocuments, WedgesAndSettingsChangeInputs)
{
    // From black to white, three of them.
    ASSERT_EQ(
        quick("w.exr",
              {document(), "--select", "Dull", "--wedge", "color=0..1:3", "--environment", "white"},
              "8", "72x24"),
        kDone)
        << err;
    EXPECT_EQ(attribute(file("w.exr"), "regain:wedge"), "color=0..1:3");
    const auto c = columns(file("w.exr"));
    const auto part = [&](std::size_t k) {
        double sum = 0;
        for (std::size_t x = 24 * k; x < 24 * (k + 1); ++x) sum += c[x] / 24;
        return sum;
    };
    EXPECT_NEAR(part(2), 1, 0.02);
    EXPECT_LT(part(1), part(2) - 0.1);
    EXPECT_LT(part(0), part(1) - 0.1);
    EXPECT_NEAR(part(1), (part(0) + part(2)) / 2, 0.03);

    // Of one node among several.
    const Arguments furnace{document(), "--environment", "white", "--select", "Dull"};
    Arguments set = furnace;
    set.insert(set.end(), {"--set", "d.color=1"});
    ASSERT_EQ(quick("s.exr", set), kDone) << err;
    EXPECT_NEAR(mean(file("s.exr")), 1, 0.01);
    EXPECT_EQ(attribute(file("s.exr"), "regain:set"), "d.color=1");
    set.back() = "d.color=0.5,0.5,0.5";
    ASSERT_EQ(quick("t.exr", set), kDone) << err;
    ASSERT_EQ(quick("u.exr", furnace), kDone) << err;
    EXPECT_EQ(columns(file("t.exr")), columns(file("u.exr")));
}

TEST_F(RenderDocuments, MethodsAreRows)
{
    ASSERT_EQ(quick("m.exr",
                    {document(), "--select", "Bright_Metal", "--method", "none,turquin,tail",
                     "--wedge", "roughness=0.2..1:2"},
                    "8", "48x72"),
              kDone)
        << err;
    EXPECT_EQ(attribute(file("m.exr"), "regain:method"), "none,turquin,tail");
}

TEST_F(RenderDocuments, DifferencesAreMeasuredAndShown)
{
    ASSERT_EQ(quick("a.exr", {document()}), kDone) << err;
    ASSERT_EQ(quick("b.exr", {document(), "--json", "--difference", file("a.exr")}), kDone) << err;
    auto summary = nlohmann::json::parse(out);
    EXPECT_EQ(summary.at("largest_difference"), 0.0);
    EXPECT_TRUE(std::filesystem::exists(file("b.difference.png")));
    ASSERT_EQ(
        quick("c.exr", {document(), "--json", "--difference", file("a.exr"), "--set", "color=0.9"}),
        kDone)
        << err;
    summary = nlohmann::json::parse(out);
    EXPECT_GT(summary.at("largest_difference").get<double>(), 0.05);
    EXPECT_GT(summary.at("largest_difference").get<double>(),
              summary.at("rms_difference").get<double>());
    EXPECT_EQ(quick("d.exr", {document(), "--difference", file("a.exr")}, "8", "50x24"), kBadInput);
    EXPECT_TRUE(said("is 48 x 24, and the picture 50 x 24")) << err;
    EXPECT_FALSE(std::filesystem::exists(file("d.exr")));
    EXPECT_EQ(quick("e.exr", {document(), "--difference", file("none.exr")}), kBadInput) << err;
}

TEST_F(RenderDocuments, LayersSayWhatIsInView)
{
    ASSERT_EQ(quick("a.exr", {document(), "--aov", "albedo,gain,lobe,method", "--environment",
                              "white", "--method", "turquin"}),
              kDone)
        << err;
    const auto in = OIIO::ImageInput::open(file("a.exr"));
    ASSERT_TRUE(in);
    EXPECT_EQ(in->spec().channelnames,
              (std::vector<std::string>{"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "gain.R",
                                        "gain.G", "gain.B", "lobe.Y", "method.Y"}));
    EXPECT_EQ(in->spec().channelformats.at(0), OIIO::TypeDesc::HALF);
    EXPECT_EQ(in->spec().channelformats.at(3), OIIO::TypeDesc::FLOAT);
    const auto& spec = in->spec();
    std::vector<float> p(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
    ASSERT_TRUE(in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, p.data()));
    const auto at = [&](int x, int y, int c) {
        return p[static_cast<std::size_t>((y * spec.width + x) * spec.nchannels + c)];
    };
    // The middles of the spheres: metal and diffuse.
    EXPECT_NEAR(at(15, 12, 4), 1, 3e-3f);
    EXPECT_GT(at(15, 12, 7), 1.01f);
    EXPECT_NEAR(at(33, 12, 4), 0.5f, 1e-3f);
    EXPECT_NEAR(at(33, 12, 7), 1, 1e-6f);
    EXPECT_EQ(at(0, 0, 4), 0) << "nothing is there";
    const std::string lobes = attribute(file("a.exr"), "regain:lobes"),
                      methods = attribute(file("a.exr"), "regain:methods");
    const auto meaning = [](const std::string& list, float number) {
        const std::string key = std::to_string(static_cast<int>(number)) + " ";
        const auto from = list.find(key) + key.size();
        return list.substr(from, list.find(',', from) - from);
    };
    EXPECT_EQ(meaning(lobes, at(15, 12, 9)), "metal");
    EXPECT_EQ(meaning(lobes, at(33, 12, 9)), "diffuse");
    EXPECT_EQ(meaning(methods, at(15, 12, 10)), "turquin");
    EXPECT_EQ(at(33, 12, 10), 0);
}

TEST_F(RenderDocuments, TheEnvironmentTurns)
{
    const auto turned = [&](const char* name, const char* degrees) {
        EXPECT_EQ(quick(name, {document(), "--rotate", degrees}, "64"), kDone) << err;
        return columns(file(name));
    };
    const auto none = turned("a.exr", "0"), quarter = turned("b.exr", "90"),
               whole = turned("c.exr", "360");
    double apart = 0, same = 0;
    for (std::size_t x = 0; x < none.size(); ++x)
    {
        apart += std::abs(none[x] - quarter[x]) / double(none.size());
        same += std::abs(none[x] - whole[x]) / double(none.size());
    }
    EXPECT_GT(apart, 0.02);
    EXPECT_LT(same, apart / 4);
    EXPECT_EQ(attribute(file("b.exr"), "regain:rotate"), "90");
    EXPECT_EQ(attribute(file("a.exr"), "regain:rotate"), "");
}

// Textures turn with their object, and a turn is no turn of the light.
TEST_F(RenderDocuments, ObjectsTurn)
{
    const std::string halves =
        temporary
            .write("halves.mtlx",
                   "<materialx version='1.39'><splitlr name='s' type='color3'><input name='valuel' "
                   "type='color3' value='0, 0, 0'/><input name='valuer' type='color3' value='1, 1, "
                   "1'/></splitlr><oren_nayar_diffuse_bsdf name='d' type='BSDF'><input "
                   "name='color' type='color3' nodename='s'/></oren_nayar_diffuse_bsdf>"
                   "</materialx>")
            .string();
    const auto sides = [&](const std::string& name) {
        const auto c = columns(file(name));
        double left = 0, right = 0;
        for (std::size_t x = 0; x < 12; ++x) left += c[x], right += c[c.size() - 1 - x];
        return left - right;
    };
    ASSERT_EQ(quick("t.exr", {halves, "--turntable", "4", "--environment", "white"}, "8", "24x24"),
              kDone)
        << err;
    EXPECT_FALSE(std::filesystem::exists(file("t.exr")));
    // The dark half is on the left, behind, on the right, in front.
    EXPECT_LT(sides("t.0001.exr"), -1);
    EXPECT_GT(sides("t.0003.exr"), 1);
    EXPECT_LT(std::abs(sides("t.0002.exr")), 0.5);
    EXPECT_GT(std::abs(mean(file("t.0002.exr")) - mean(file("t.0004.exr"))), 0.1);
    EXPECT_EQ(attribute(file("t.0002.exr"), "regain:turn"), "90");
    // What is whole is left alone.
    const auto before = std::filesystem::last_write_time(file("t.0003.exr"));
    std::filesystem::remove(file("t.0002.exr"));
    ASSERT_EQ(quick("t.exr", {halves, "--turntable", "4", "--environment", "white", "--resume"},
                    "8", "24x24"),
              kDone);
    EXPECT_TRUE(std::filesystem::exists(file("t.0002.exr")));
    EXPECT_EQ(std::filesystem::last_write_time(file("t.0003.exr")), before);
}

TEST_F(RenderDocuments, ChangesAreWatched)
{
    const std::string watched = document();
    const auto wait = [](const auto& until) {
        for (int i = 0; i < 300 && !until(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return until();
    };
    bool rendered = false, again = false;
    std::thread user([&] {
        const auto there = [&] {
            return std::filesystem::exists(file("w.exr")) && std::filesystem::exists(file("w.png"));
        };
        rendered = wait(there);
        std::this_thread::sleep_for(std::chrono::milliseconds(400));
        std::filesystem::remove(file("w.png"));
        std::filesystem::remove(file("w.exr"));
        document();
        std::filesystem::last_write_time(watched, std::filesystem::file_time_type::clock::now());
        again = wait(there);
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        ::kill(::getpid(), SIGINT);
    });
    EXPECT_EQ(quick("w.exr", {watched, "--watch"}, "1", "16x16"), kInterrupted) << err;
    user.join();
    EXPECT_TRUE(rendered);
    EXPECT_TRUE(again);
}

TEST_F(RenderDocuments, EveryDocumentOfTheFolderIsRendered)
{
    int documents = 0;
    for (const auto& one : std::filesystem::directory_iterator(REGAIN_DOCUMENTS))
    {
        if (one.path().extension() != ".mtlx") continue;
        ++documents;
        EXPECT_EQ(quick("d.exr", {one.path().string()}, "1", "24x16"), kDone) << one.path() << err;
        EXPECT_GT(mean(file("d.exr")), 0.01) << one.path();
    }
    EXPECT_GE(documents, 30);
}

TEST_F(RenderDocuments, AToleranceChoosesTheMethodsAndTheFileSaysWhich)
{
    const std::string two = document(),
                      costs = temporary.write("costs.json", tests::price_list()).string();
    const auto planned = [&](const char* name, const char* tolerance) {
        EXPECT_EQ(quick(name, {two, "--costs", costs, "--tolerance", tolerance}), kDone) << err;
        return attribute(file(name), "regain:method");
    };
    EXPECT_EQ(planned("one.exr", "1"), "Bright Metal: metal none; Dull: diffuse none");
    EXPECT_EQ(planned("walk.exr", "0"), "Bright Metal: metal walk; Dull: diffuse none");
    EXPECT_EQ(attribute(file("walk.exr"), "regain:tolerance"), "0");
    // The same picture as by the method's name.
    EXPECT_EQ(quick("none.exr", {two, "--method", "none"}), kDone) << err;
    EXPECT_EQ(columns(file("one.exr")), columns(file("none.exr")));
    EXPECT_EQ(attribute(file("none.exr"), "regain:tolerance"), "");
}

TEST_F(RenderDocuments, WhatIsWrongIsSaidAndNothingIsWritten)
{
    const auto refused = [&](const Arguments& arguments, const std::string& message) {
        EXPECT_EQ(quick("no.exr", arguments), kBadInput) << message;
        EXPECT_TRUE(said(message)) << err;
        EXPECT_FALSE(std::filesystem::exists(file("no.exr")));
    };
    const std::string broken =
        temporary.write("broken.mtlx", "<materialx version='1.39'>").string();
    refused({broken}, "broken.mtlx:1: this is no XML");
    refused({"mithril"}, "there is neither a document nor a preset 'mithril'");
    refused({"no/such.mtlx"}, "cannot read 'no/such.mtlx'");
    refused({document(), "--select", "Steel"}, "--select Steel: no document has a material");
    refused({document(), "--metal", "gold"}, "--metal: does not go with documents");
    refused({document(), "--alpha", "0.5"}, "--alpha: does not go with documents");
    refused({document(), "--method", "magic"}, "--method magic: no such method");
    refused({document(), "--method", "none,magic"}, "--method magic: no such method");
    refused({document(), "--set", "colour=1"}, "'colour' is no input of any of its nodes");
    refused({document(), "--set", "color"}, "--set color: takes INPUT=VALUE");
    for (const char* wedge : {"color", "color=1", "color=0..1", "color=0..1:1", "color=0..1:17",
                              "color=0..x:3", "=0..1:3", "color=0..1:2.5"})
        refused({document(), "--wedge", wedge}, std::string("--wedge ") + wedge + ": takes");
    refused({"--wedge", "alpha=0..1:3"}, "goes with documents alone");
    refused({"--select", "Dull"}, "goes with documents alone");
    refused({"--set", "color=1"}, "goes with documents and --plugin alone");
    refused({document(), "--aov", "depth"}, "--aov depth: no such layer");
    refused({document(), "--columns", "0"}, "--columns 0: takes 1 to 16");
    refused({document(), "--furnace", "--environment", "a.exr"}, "does not go with --furnace");
    refused({document(), "--rotate", "nan"}, "--rotate");
    refused({document(), "--scale", "-1"}, "--scale");
    refused({document(), "--scale", "0"}, "--scale");
    refused({document(), "--turntable", "1"}, "--turntable 1: takes 2 to 9999");
    refused({document(), "--turn", "inf"}, "--turn");
    refused({document(), "--tolerance", "2"}, "--tolerance 2: takes numbers from 0 to 1");
    refused({document(), "--tolerance", "0.1", "--method", "walk"}, "does not go with --method");
    refused({document(), "--tolerance", "0.1", "--costs", "no/such.json"}, "cannot be read");
    refused({document(), "--costs", "no/such.json"}, "goes with --tolerance alone");
    refused({"--tolerance", "0.1"}, "goes with documents alone");
    refused({"--watch"}, "--watch: goes with documents alone");
}

}}  // namespace regain::tools
