// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Documents that are none, that lead nowhere or back to themselves, that are too much: a clear
// error, with the place.

#include "documents.h"

#include "../support/temporary_folder.h"

#include <fstream>

using namespace regain;
using namespace regain::shaders;
using namespace regain::tests;

namespace {

const std::string diffuse =
    "<oren_nayar_diffuse_bsdf name='d' type='BSDF'>%</oren_nayar_diffuse_bsdf>";

std::string with_input(const std::string& input)
{
    return document(diffuse.substr(0, diffuse.find('%')) + input +
                    diffuse.substr(diffuse.find('%') + 1));
}

TEST(DocumentErrors, what_is_no_document)
{
    EXPECT_TRUE(
        says(error_of("<materialx version='1.39'><a></materialx>"), "test.mtlx:1: this is no XML"));
    EXPECT_TRUE(says(error_of(""), "this is no XML"));
    EXPECT_TRUE(says(error_of("<svg/>"), "its root is <svg>"));
    EXPECT_TRUE(says(error_of("<materialx/>"), "accepted: 1.38 and 1.39"));
    EXPECT_TRUE(says(error_of("<materialx version='2.0'/>"), "'2.0'"));
    EXPECT_TRUE(says(error_of("<materialx version='one'/>"), "'one'"));
    const std::string broken = "<materialx version='1.39'>\n\n<surface name='a'\n</materialx>";
    EXPECT_TRUE(says(error_of(broken), "test.mtlx:4:") || says(error_of(broken), "test.mtlx:3:"))
        << error_of(broken);
}

TEST(DocumentErrors, materials_of_old_are_told)
{
    const std::string old =
        "<materialx version='1.37'>\n<material name='m'><shaderref name='r' "
        "node='standard_surface'/>"
        "</material></materialx>";
    EXPECT_TRUE(says(error_of(old), "test.mtlx:2: m: materials as before MaterialX 1.38"));
}

TEST(DocumentErrors, what_is_not_there)
{
    EXPECT_TRUE(says(error_of(with_input("<input name='color' type='color3' nodename='x'/>")),
                     "test.mtlx:3: color: there is no node 'x'"));
    EXPECT_TRUE(
        says(error_of(with_input("<input name='color' type='color3' nodegraph='g' output='out'/>")),
             "there is no graph 'g'"));
    const std::string graph =
        "<nodegraph name='g'><output name='out' type='color3' "
        "nodename='n'/></nodegraph>";
    const auto to_graph = [&](const std::string& g, const std::string& output) {
        return error_of(document(
            g +
            "<oren_nayar_diffuse_bsdf name='d' type='BSDF'><input name='color' type='color3' "
            "nodegraph='g' output='" +
            output + "'/></oren_nayar_diffuse_bsdf>"));
    };
    EXPECT_TRUE(says(to_graph(graph, "out"), "the output leads to no node"));
    EXPECT_TRUE(says(to_graph(graph, "other"), "the graph has no output 'other'"));
    const auto d = MaterialDocument::parse(with_input(""), "test.mtlx", settings());
    std::vector<DocumentNote> notes;
    try
    {
        d.surface("steel", notes);
        FAIL();
    }
    catch (const DocumentError& e)
    {
        EXPECT_TRUE(says(e.what(), "'steel'") && says(e.what(), "accepted: d")) << e.what();
    }
    EXPECT_THROW(MaterialDocument::read("nowhere.mtlx", settings()), DocumentError);
    EXPECT_THROW(MaterialDocument::read("/", settings()), DocumentError);
}

TEST(DocumentErrors, numbers_that_are_none)
{
    for (const char* value :
         {"0.1, 0.2", "0.1, 0.2, x", "", "nan, 0, 0", "1e999, 0, 0", "1, 2, 3, 4", "red"})
        EXPECT_TRUE(says(error_of(with_input("<input name='color' type='color3' value='" +
                                             std::string(value) + "'/>")),
                         "is no color3"))
            << value;
    EXPECT_TRUE(says(
        error_of(with_input("<input name='energy_compensation' type='boolean' value='maybe'/>")),
        "neither true nor false"));
    EXPECT_TRUE(says(error_of(document(
                         "<swizzle name='s' type='color3'><input name='in' type='color3' value='1, "
                         "1, 1'/><input name='channels' type='string' value='rgq'/></swizzle>"
                         "<oren_nayar_diffuse_bsdf name='d' type='BSDF'><input name='color' "
                         "type='color3' nodename='s'/></oren_nayar_diffuse_bsdf>")),
                     "'rgq' is no choice of channels"));
}

TEST(DocumentErrors, what_leads_back_to_itself)
{
    const std::string cycle =
        "<add name='a' type='color3'><input name='in1' type='color3' nodename='b'/></add>"
        "<add name='b' type='color3'><input name='in1' type='color3' nodename='a'/></add>"
        "<oren_nayar_diffuse_bsdf name='d' type='BSDF'><input name='color' type='color3' "
        "nodename='a'/></oren_nayar_diffuse_bsdf>";
    EXPECT_TRUE(says(error_of(document(cycle)), "nodes lead back to themselves"));
    const std::string closures =
        "<layer name='a' type='BSDF'><input name='top' type='BSDF' nodename='b'/></layer>"
        "<layer name='b' type='BSDF'><input name='base' type='BSDF' nodename='a'/></layer>"
        "<surface name='s' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='a'/>"
        "</surface>";
    EXPECT_TRUE(says(error_of(document(closures)), "nodes lead back to themselves"));
    const std::string interface =
        "<nodegraph name='g'><input name='i' type='color3' interfacename='i'/>"
        "<dot name='n' type='color3'><input name='in' type='color3' interfacename='i'/></dot>"
        "<output name='out' type='color3' nodename='n'/></nodegraph>"
        "<oren_nayar_diffuse_bsdf name='d' type='BSDF'><input name='color' type='color3' "
        "nodegraph='g' output='out'/></oren_nayar_diffuse_bsdf>";
    // An interface that is its own is no connection at all.
    EXPECT_EQ(error_of(document(interface)), "");
    const std::string definition =
        "<nodedef name='ND' node='self'><output name='out' type='color3'/></nodedef>"
        "<nodegraph name='NG' nodedef='ND'><self name='n' type='color3'/>"
        "<output name='out' type='color3' nodename='n'/></nodegraph>"
        "<self name='last' type='color3'/><oren_nayar_diffuse_bsdf name='d' type='BSDF'><input "
        "name='color' type='color3' nodename='last'/></oren_nayar_diffuse_bsdf>";
    EXPECT_TRUE(says(error_of(document(definition)), "without end"))
        << error_of(document(definition));
}

TEST(DocumentErrors, includes_that_cannot_be)
{
    const test::TemporaryFolder folder;
    const auto read = [&](const std::filesystem::path& file) -> std::string {
        try
        {
            MaterialDocument::read(file, settings());
        }
        catch (const DocumentError& e)
        {
            return e.what();
        }
        return {};
    };
    const std::string include = "<xi:include href='other.mtlx'/>";
    const auto one = folder.write("one.mtlx", document(include));
    EXPECT_TRUE(says(read(one), "there is no document 'other.mtlx'")) << read(one);
    folder.write("other.mtlx", document("<xi:include href='one.mtlx'/>"));
    EXPECT_TRUE(says(read(one), "includes itself")) << read(one);
    folder.write("other.mtlx", "<materialx version='1.39'><broken</materialx>");
    EXPECT_TRUE(says(read(one), "other.mtlx:1: this is no XML")) << read(one);
    // Deeper than anybody means.
    for (int i = 0; i < 20; ++i)
        folder.write("deep" + std::to_string(i) + ".mtlx",
                     document("<xi:include href='deep" + std::to_string(i + 1) + ".mtlx'/>"));
    EXPECT_TRUE(says(read(folder.path() / "deep0.mtlx"), "more than 16 deep"));
}

TEST(DocumentErrors, too_much)
{
    // Elements in one another, without end.
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<nodegraph>";
    for (int i = 0; i < 100000; ++i) deep += "</nodegraph>";
    EXPECT_TRUE(says(error_of(document(deep)), "more than 64 deep"));
    std::string many;
    for (int i = 0; i < 200001; ++i) many += "<add/>";
    EXPECT_TRUE(says(error_of(document(many)), "more than 200000 elements"));
    // A chain of nodes, each of the one before.
    std::string chain = "<position name='n0' type='vector3'/>";
    for (int i = 1; i < 1000; ++i)
        chain += "<add name='n" + std::to_string(i) +
                 "' type='vector3'><input name='in1' type='vector3' nodename='n" +
                 std::to_string(i - 1) + "'/></add>";
    EXPECT_TRUE(says(error_of(document(chain + "<oren_nayar_diffuse_bsdf name='d' type='BSDF'>"
                                               "<input name='color' type='vector3' "
                                               "nodename='n999'/></oren_nayar_diffuse_bsdf>")),
                     "more than 400 nodes lead to one another"));
    // A tree that doubles at each node is no more than its nodes.
    std::string doubling = "<ramplr name='n0' type='color3'/>";
    for (int i = 1; i < 60; ++i)
        doubling += "<add name='n" + std::to_string(i) +
                    "' type='color3'><input name='in1' type='color3' nodename='n" +
                    std::to_string(i - 1) + "'/><input name='in2' type='color3' nodename='n" +
                    std::to_string(i - 1) + "'/></add>";
    EXPECT_EQ(error_of(document(doubling + "<oren_nayar_diffuse_bsdf name='d' type='BSDF'><input "
                                           "name='color' type='color3' nodename='n59'/>"
                                           "</oren_nayar_diffuse_bsdf>")),
              "");
    // As many nodes as there may be, and a definition that each might be of.
    std::string wide = "<nodedef name='ND' node='none'/>";
    for (int i = 0; i < 16384; ++i)
        wide += "<constant name='w0_" + std::to_string(i) + "' type='float'/>";
    for (int level = 1, n = 8192; n > 0; ++level, n /= 2)
        for (int i = 0; i < n; ++i)
        {
            const std::string below = "w" + std::to_string(level - 1) + "_";
            wide += "<add name='w" + std::to_string(level) + "_" + std::to_string(i) +
                    "' type='float'><input name='in1' type='float' nodename='" + below +
                    std::to_string(2 * i) + "'/><input name='in2' type='float' nodename='" + below +
                    std::to_string(2 * i + 1) + "'/></add>";
        }
    EXPECT_EQ(error_of(document(wide + "<oren_nayar_diffuse_bsdf name='d' type='BSDF'><input "
                                       "name='roughness' type='float' nodename='w14_0'/>"
                                       "</oren_nayar_diffuse_bsdf>")),
              "");
    // The same of closures has more of them than a material may.
    std::string closures = "<translucent_bsdf name='n0' type='BSDF'/>";
    for (int i = 1; i < 40; ++i)
        closures += "<add name='n" + std::to_string(i) +
                    "' type='BSDF'><input name='in1' type='BSDF' nodename='n" +
                    std::to_string(i - 1) + "'/><input name='in2' type='BSDF' nodename='n" +
                    std::to_string(i - 1) + "'/></add>";
    EXPECT_TRUE(says(error_of(document(closures)), "more than 16 closures"))
        << error_of(document(closures));
    // Entities expand to nothing.
    const std::string laughs =
        "<?xml version='1.0'?><!DOCTYPE l [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;'>]>"
        "<materialx version='1.39'><add name='&b;'/></materialx>";
    EXPECT_NO_THROW(MaterialDocument::parse(laughs, "test.mtlx", settings()));
}

TEST(DocumentErrors, random_bytes_are_survived)
{
    const std::string whole = with_input("<input name='color' type='color3' value='1, 0, 1'/>");
    unsigned state = 12345;
    const auto random = [&](unsigned n) {
        state = state * 1664525u + 1013904223u;
        return (state >> 8) % n;
    };
    int refused = 0, accepted = 0;
    for (int i = 0; i < 2000; ++i)
    {
        std::string text = whole;
        for (unsigned k = 0; k < 1 + random(4); ++k)
            text[random(static_cast<unsigned>(text.size()))] = static_cast<char>(random(256));
        try
        {
            std::vector<DocumentNote> notes;
            const auto d = MaterialDocument::parse(text, "test.mtlx", settings());
            for (const auto& name : d.materials()) d.surface(name, notes);
            ++accepted;
        }
        catch (const DocumentError&)
        {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(accepted, 100);
}

}  // namespace
