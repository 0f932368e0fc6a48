// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Numbers of a document: inputs, the nodes of stdlib, graphs and definitions, by the colour that
// they give a diffuse.

#include "documents.h"

#include <cmath>

using namespace regain;
using namespace regain::shaders;
using namespace regain::tests;

namespace {

// The colour that `nodes` end in, the last of them called "last".
ColorD color(const std::string& nodes, const SurfacePoint& point = {},
             std::vector<DocumentNote>* notes = nullptr)
{
    const VaryingTree surface =
        surface_of(document(nodes + "<oren_nayar_diffuse_bsdf name='d' type='BSDF'>"
                                    "<input name='color' type='color3' nodename='last'/>"
                                    "</oren_nayar_diffuse_bsdf>"),
                   notes);
    if (surface.lobes() == 0) return ColorD(0.0);
    Imath::V4f values[VaryingTree::most_values];
    surface.values_at(point, values);
    const auto material = surface.material(0, values);
    return std::get<OrenNayarSurface>(std::get<PlainMaterial>(material).surface).color;
}

std::string node(const std::string& category, const std::string& inputs,
                 const std::string& name = "last", const std::string& type = "color3")
{
    return "<" + category + " name='" + name + "' type='" + type + "'>" + inputs + "</" + category +
           ">";
}
std::string in(const std::string& name, const std::string& value,
               const std::string& type = "color3")
{
    return "<input name='" + name + "' type='" + type + "' value='" + value + "'/>";
}
std::string from(const std::string& name, const std::string& node,
                 const std::string& type = "color3")
{
    return "<input name='" + name + "' type='" + type + "' nodename='" + node + "'/>";
}

TEST(DocumentValues, mathematics_is_by_component)
{
    const std::string a = in("in1", "0.5, 0.25, 0.8"), b = in("in2", "0.25, 0.5, 0.5");
    expect_color(color(node("add", a + b)), 0.75, 0.75, 1.3);
    expect_color(color(node("subtract", a + b)), 0.25, -0.25, 0.3);
    expect_color(color(node("multiply", a + b)), 0.125, 0.125, 0.4);
    expect_color(color(node("divide", a + b)), 2, 0.5, 1.6);
    expect_color(color(node("divide", a + in("in2", "0, 1, 1"))), 0, 0.25, 0.8);
    expect_color(color(node("modulo", a + in("in2", "0.3, 0.2, 0.3"))), 0.2, 0.05, 0.2);
    expect_color(color(node("power", a + in("in2", "2", "float"))), 0.25, 0.0625, 0.64);
    expect_color(color(node("min", a + b)), 0.25, 0.25, 0.5);
    expect_color(color(node("max", a + b)), 0.5, 0.5, 0.8);
    const std::string x = in("in", "-0.5, 0.25, 1.8");
    expect_color(color(node("absval", x)), 0.5, 0.25, 1.8);
    expect_color(color(node("sign", x)), -1, 1, 1);
    expect_color(color(node("floor", x)), -1, 0, 1);
    expect_color(color(node("ceil", x)), 0, 1, 2);
    expect_color(color(node("round", x)), -1, 0, 2, 0.51);
    expect_color(color(node("sqrt", x)), 0, 0.5, std::sqrt(1.8));
    expect_color(color(node("exp", x)), std::exp(-0.5), std::exp(0.25), std::exp(1.8), 1e-4);
    expect_color(color(node("ln", x)), 0, std::log(0.25), std::log(1.8));
    expect_color(color(node("sin", x)), std::sin(-0.5), std::sin(0.25), std::sin(1.8));
    expect_color(color(node("acos", x)), std::acos(-0.5), std::acos(0.25), 0);
    expect_color(color(node("clamp", x)), 0, 0.25, 1);
    expect_color(color(node("invert", x)), 1.5, 0.75, -0.8);
    expect_color(color(node("smoothstep", x)), 0, 0.15625, 1);
    expect_color(color(node("remap", x + in("outlow", "1, 1, 1") + in("outhigh", "3, 3, 3"))), 0,
                 1.5, 4.6);
    expect_color(color(node("contrast", x + in("amount", "2", "float"))), -1.5, 0, 3.1);
    expect_color(
        color(node("mix", in("bg", "0, 0, 1") + in("fg", "1, 1, 0") + in("mix", "0.25", "float"))),
        0.25, 0.25, 0.75);
}

TEST(DocumentValues, colours_are_adjusted)
{
    expect_color(color(node("luminance", in("in", "1, 0, 0"))), 0.2126729, 0.2126729, 0.2126729);
    expect_color(color(node("luminance", in("in", "0, 1, 0") + in("lumacoeffs", "0.3, 0.6, 0.1"))),
                 0.6, 0.6, 0.6);
    expect_color(color(node("saturate", in("in", "0, 1, 0") + in("amount", "0", "float"))),
                 0.7151522, 0.7151522, 0.7151522);
    // Red by a third of a turn is green.
    expect_color(color(node("hsvadjust", in("in", "0.8, 0.2, 0.2") +
                                             in("amount", "0.33333333, 1, 1", "vector3"))),
                 0.2, 0.8, 0.2);
    for (const char* c : {"0.3, 0.7, 0.1", "0.9, 0.1, 0.5", "0.2, 0.2, 0.2", "0.1, 0.6, 0.9"})
    {
        const auto there =
            color(node("rgbtohsv", in("in", c), "hsv") + node("hsvtorgb", from("in", "hsv")));
        const auto same = color(node("constant", in("value", c)));
        expect_color(there, same.x, same.y, same.z, 1e-5);
    }
}

TEST(DocumentValues, channels_are_put_together_and_taken_apart)
{
    expect_color(color(node("combine3", in("in1", "0.1", "float") + in("in2", "0.2", "float") +
                                            in("in3", "0.3", "float"))),
                 0.1, 0.2, 0.3);
    const std::string c = node("constant", in("value", "0.1, 0.2, 0.3"), "c");
    expect_color(color(c + node("separate3", from("in", "c"), "s", "multioutput") +
                       node("combine3",
                            "<input name='in1' type='float' nodename='s' output='outb'/>"
                            "<input name='in3' type='float' nodename='s' output='outr'/>")),
                 0.3, 0, 0.1);
    expect_color(color(c + node("swizzle", from("in", "c") + in("channels", "bgr", "string"))), 0.3,
                 0.2, 0.1);
    expect_color(
        color(c + node("extract", from("in", "c") + in("index", "1", "integer"), "last", "float")),
        0.2, 0.2, 0.2);
    // One number is meant for all, where a colour is asked for.
    expect_color(color(node("constant", in("value", "0.4", "float"), "last", "float")), 0.4, 0.4,
                 0.4);
    expect_color(color(node("convert", in("in", "0.4", "float"))), 0.4, 0.4, 0.4);
    expect_color(color(node("dotproduct",
                            in("in1", "1, 2, 3", "vector3") + in("in2", "0.1, 0.1, 0.1", "vector3"),
                            "last", "float")),
                 0.6, 0.6, 0.6);
    expect_color(color(node("magnitude", in("in", "3, 4", "vector2"), "last", "float")), 5, 5, 5);
    expect_color(color(node("crossproduct",
                            in("in1", "1, 0, 0", "vector3") + in("in2", "0, 1, 0", "vector3"),
                            "last", "vector3")),
                 0, 0, 1);
}

TEST(DocumentValues, conditions_choose)
{
    const std::string both = in("in1", "1, 0, 0") + in("in2", "0, 1, 0");
    const auto chosen = [&](const char* category, const char* a, const char* b) {
        return color(node(category, in("value1", a, "float") + in("value2", b, "float") + both)).x;
    };
    EXPECT_EQ(chosen("ifgreater", "2", "1"), 1);
    EXPECT_EQ(chosen("ifgreater", "1", "1"), 0);
    EXPECT_EQ(chosen("ifgreatereq", "1", "1"), 1);
    EXPECT_EQ(chosen("ifequal", "1", "1"), 1);
    EXPECT_EQ(chosen("ifequal", "1", "1.5"), 0);
    for (int k = 0; k < 3; ++k)
        EXPECT_EQ(
            color(node("switch", in("which", std::to_string(k), "integer") + in("in1", "1, 1, 1") +
                                     in("in2", "2, 2, 2") + in("in3", "3, 3, 3")))
                .x,
            k + 1);
}

TEST(DocumentValues, points_differ)
{
    SurfacePoint point;
    point.uv = {0.25f, 0.75f};
    point.P = {1, 2, 3};
    point.N = {0, 1, 0};
    expect_color(color(node("ramplr", in("valuel", "0, 0, 0") + in("valuer", "1, 2, 4")), point),
                 0.25, 0.5, 1);
    expect_color(color(node("ramptb", in("valuet", "1, 1, 1") + in("valueb", "0, 0, 0")), point),
                 0.75, 0.75, 0.75);
    EXPECT_EQ(color(node("splitlr", in("valuel", "1, 1, 1") + in("valuer", "0, 0, 0")), point).x,
              1);
    EXPECT_EQ(color(node("splittb", in("valuet", "1, 1, 1") + in("valueb", "0, 0, 0")), point).x,
              1);
    expect_color(color(node("position", "", "last", "vector3"), point), 1, 2, 3);
    expect_color(color(node("normal", "", "last", "vector3"), point), 0, 1, 0);
    // Eight squares: 2 and 6 from the corner, which is a light one.
    EXPECT_EQ(color(node("checkerboard", ""), point).x, 1);
    point.uv.x += 1.0f / 8;
    EXPECT_EQ(color(node("checkerboard", ""), point).x, 0);
    // Turned by a quarter about the middle.
    point.uv = {0.25f, 0.5f};
    const auto turned =
        color(node("place2d", in("rotate", "90", "float") + in("pivot", "0.5, 0.5", "vector2"), "p",
                   "vector2") +
                  node("ramptb", in("valuet", "1, 1, 1") + from("texcoord", "p", "vector2")),
              point);
    EXPECT_NEAR(turned.x, 0.75, 1e-5);
}

TEST(DocumentValues, graphs_and_definitions_have_interfaces)
{
    const std::string graph =
        "<nodegraph name='g'><input name='amount' type='float' value='0.25'/>"
        "<multiply name='m' type='color3'><input name='in1' type='color3' value='1, 0.5, 0.2'/>"
        "<input name='in2' type='float' interfacename='amount'/></multiply>"
        "<output name='out' type='color3' nodename='m'/></nodegraph>";
    expect_color(color(graph + node("dot",
                                    "<input name='in' type='color3' nodegraph='g' "
                                    "output='out'/>")),
                 0.25, 0.125, 0.05);
    const std::string definition =
        "<nodedef name='ND_dim' node='dim'><input name='amount' type='float' value='0.5'/>"
        "<input name='of' type='color3' value='1, 1, 1'/><output name='out' type='color3'/>"
        "</nodedef><nodegraph name='NG_dim' nodedef='ND_dim'><multiply name='m' type='color3'>"
        "<input name='in1' type='color3' interfacename='of'/>"
        "<input name='in2' type='float' interfacename='amount'/></multiply>"
        "<output name='out' type='color3' nodename='m'/></nodegraph>";
    expect_color(color(definition + node("dim", in("of", "0.8, 0.4, 0.2"))), 0.4, 0.2, 0.1);
    // By an implementation, and of several the one of the type.
    std::string other = definition;
    other.replace(other.find(" nodedef='ND_dim'"), 17, "");
    EXPECT_EQ(other.find(" nodedef='ND_dim'"), other.npos);
    other +=
        "<implementation name='IM' nodedef='ND_dim' nodegraph='NG_dim'/>"
        "<nodedef name='ND_dim_float' node='dim'><output name='out' type='float'/></nodedef>";
    expect_color(color(other + node("dim", in("of", "0.8, 0.4, 0.2"))), 0.4, 0.2, 0.1);
    // Of itself.
    expect_color(color(definition + node("dim", in("of", "0.8, 0.4, 0.2"), "once") +
                       node("dim", from("of", "once") + in("amount", "0.25", "float"))),
                 0.1, 0.05, 0.025);
}

TEST(DocumentValues, nodes_may_be_written_by_their_type)
{
    expect_color(color("<node name='last' nodetype='constant' type='color3'>" +
                       in("value", "0.1, 0.2, 0.3") + "</node>"),
                 0.1, 0.2, 0.3);
}

TEST(DocumentValues, what_is_not_known_is_noted_and_stood_in_for)
{
    std::vector<DocumentNote> notes;
    expect_color(color(node("noise3d", ""), {}, &notes), 0, 0, 0);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(says(notes[0].message(), "test.mtlx:3: last: the node 'noise3d' is not supported"));
    notes.clear();
    expect_color(color(node("blur", in("in", "0.1, 0.2, 0.3")), {}, &notes), 0.1, 0.2, 0.3);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(says(notes[0].text, "'in' was used instead"));
    notes.clear();
    expect_color(color(node("image", in("file", "a.png", "filename") + in("default", "1, 0, 1")),
                       {}, &notes),
                 1, 0, 1);
    EXPECT_TRUE(says(notes.at(0).text, "pictures are not read here"));
}

TEST(DocumentValues, constants_make_no_program)
{
    const auto folded = surface_of(
        document("<add name='a' type='float'><input name='in1' type='float' value='0.1'/>"
                 "<input name='in2' type='float' value='0.2'/></add>"
                 "<oren_nayar_diffuse_bsdf name='d' type='BSDF'>"
                 "<input name='roughness' type='float' nodename='a'/>"
                 "</oren_nayar_diffuse_bsdf>"));
    EXPECT_FALSE(folded.varies());
    EXPECT_EQ(folded.values(), 0);
    EXPECT_NEAR(plain<OrenNayarSurface>(folded).roughness, 0.3, 1e-6);
    // What a weight of 0 takes away is not run either.
    const auto unused = surface_of(document(
        "<ramplr name='r' type='color3'><input name='valuer' type='color3' value='1, 1, "
        "1'/></ramplr>"
        "<standard_surface name='s' type='surfaceshader'><input name='metalness' type='float' "
        "value='1'/><input name='subsurface_color' type='color3' nodename='r'/>"
        "</standard_surface>"));
    EXPECT_FALSE(unused.varies());
}

TEST(DocumentValues, results_are_numbers_whatever_goes_in)
{
    const auto huge = color(node("power", in("in1", "1e30, 2, 0") + in("in2", "40, 2, -1")));
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(huge[c])) << c;
    EXPECT_EQ(huge.y, 4);
}

}  // namespace
