// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What a query refuses, and that it says what was given and what is accepted.

#include "query_answer.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace regain::tools;
using nlohmann::json;

namespace {

std::string refusal(const std::string& line)
{
    fmt::memory_buffer out;
    EXPECT_FALSE(answer_line(line, out)) << line;
    const json answer = json::parse(fmt::to_string(out));
    EXPECT_EQ(answer.size(), 1u);
    return answer.value("error", "");
}

// A query that is answered, with one field changed (null: left out).
std::string changed(json query, const std::string& field, const json& value)
{
    fmt::memory_buffer out;
    EXPECT_TRUE(answer_line(query.dump(), out)) << fmt::to_string(out);
    if (value.is_null())
        query.erase(field);
    else
        query[field] = value;
    return query.dump();
}

json eval() { return {{"op", "eval"}, {"closure", "conductor"}, {"mu", 0.5}, {"wi", {0, 0, 1}}}; }
json schlick() { return {{"op", "fresnel"}, {"closure", "generalized_schlick"}, {"mu", 0.5}}; }
json sample() { return {{"op", "sample"}, {"closure", "conductor"}, {"mu", 0.5}, {"u", {0, 0}}}; }
json samples() { return {{"op", "sample"}, {"closure", "conductor"}, {"mu", 0.5}, {"n", 2}}; }
json ndf() { return {{"op", "ndf"}, {"alpha", 0.5}, {"mu", 0.5}, {"wm", {0, 0, 1}}}; }
json glass()
{
    return {{"op", "eval"}, {"closure", "dielectric"}, {"mu", 0.5}, {"wi", {0, 0, -1}}};
}
json diffuse()
{
    return {{"op", "eval"}, {"closure", "oren_nayar_diffuse"}, {"mu", 0.5}, {"wi", {0, 0, 1}}};
}
json sheen() { return {{"op", "eval"}, {"closure", "sheen"}, {"mu", 0.5}, {"wi", {0, 0, 1}}}; }
json albedo() { return {{"op", "albedo"}, {"closure", "conductor"}, {"mu", 0.5}}; }

struct Case
{
    json query;
    std::string field;
    json value;
    std::vector<std::string> says;
};

void check(const std::vector<Case>& cases)
{
    for (const Case& c : cases)
    {
        const std::string message = refusal(changed(c.query, c.field, c.value));
        for (const std::string& part : c.says)
            EXPECT_NE(message.find(part), std::string::npos)
                << c.field << " = " << c.value << ": '" << message << "' lacks '" << part << "'";
    }
}

const json zero_to_one = {0.5, 0.5, 0.5};

}  // namespace

TEST(query_refusals, what_belongs_to_another_closure)
{
    const std::string dielectric = "belongs to the closure dielectric";
    check(
        {{eval(), "scatter_mode", "RT", {"there is no scatter_mode", "accepted: R"}},
         {eval(), "fresnel", {{"eta", 1.5}}, {"eta", dielectric}},
         {eval(), "transmission_shadowing", "beta", {dielectric}},
         {eval(), "thin_walled", true, {dielectric}},
         {eval(), "gamma", 2, {"'gamma'", "gtr and std"}},
         {eval(), "order", 2, {"'order'", "the op albedo"}},
         {albedo(), "order", 2, {"'order'", "the method walk"}},
         {glass(), "fresnel", {{"F0", zero_to_one}}, {"'fresnel' with eta"}},
         {glass(), "scatter_mode", "TR", {"there is no scatter_mode 'TR'", "R, T, RT"}},
         {glass(), "transmission_shadowing", "smith", {"correlated, beta"}},
         {glass(), "ior", 0, {"'ior' is 0", "from 0.01 to 100"}},
         {sheen(), "alpha", 0.5, {"'alpha'", "no microfacets"}},
         {sheen(), "roughness", 0.5, {"'roughness'", "conty_kulla and zeltner"}},
         {sheen(), "mode", "velvet", {"there is no mode 'velvet'", "burley, conty_kulla, zeltner"}},
         {diffuse(), "alpha", 0.5, {"'alpha'", "oren_nayar_diffuse has no microfacets"}},
         {diffuse(), "roughness", 1.5, {"'roughness' is 1.5", "from 0 to 1"}},
         {diffuse(), "mode", "zeltner", {"'mode'"}},
         {diffuse(), "method", "turquin", {"turquin", "oren_nayar_diffuse", "none"}},
         {sheen(), "fresnel", {{"constant", zero_to_one}}, {"no microfacets"}}});
}

TEST(query_refusals, what_combinations_of_closures_lack)
{
    const json part{{"closure", "translucent"}};
    const json layered{{"op", "eval"},    {"closure", "layer"}, {"mu", 0.5},
                       {"wi", {0, 0, 1}}, {"top", part},        {"base", part}};
    check({{layered, "base", nullptr, {"'base'"}},
           {layered, "base", 1, {"'base'"}},
           {layered, "base", {{"closure", "velvet"}}, {"there is no closure 'velvet'"}},
           {layered, "base", {{"color", zero_to_one}}, {"'closure'"}},
           {layered,
            "base",
            {{"closure", "sheen"}, {"precision", "double"}},
            {"'precision'", "whole"}},
           {layered, "base", {{"closure", "sheen"}, {"colour", zero_to_one}}, {"colour"}},
           {layered, "alpha", 0.5, {"'alpha'", "parts"}},
           {layered, "mix", 0.5, {"'mix'"}}});
    json gain = layered;
    gain["op"] = "gain";
    gain.erase("wi");
    EXPECT_NE(refusal(gain.dump()).find("ask for those of its parts"), std::string::npos);
    gain["op"] = "fresnel";
    EXPECT_NE(refusal(gain.dump()).find("the closure layer has no Fresnel term"),
              std::string::npos);
    const json mixed{{"op", "eval"}, {"closure", "mix"}, {"mu", 0.5}, {"wi", {0, 0, 1}},
                     {"fg", part},   {"bg", part},       {"mix", 0.5}};
    check({{mixed, "mix", 2, {"'mix' is 2", "from 0 to 1"}}, {mixed, "fg", 3, {"'fg'"}}});
    json scaled{
        {"op", "albedo"}, {"closure", "multiply"}, {"mu", 0.5}, {"in1", part}, {"in2", 0.5}};
    check({{scaled, "in2", {1, 2}, {"'in2'"}},
           {scaled, "in2", -1, {"'in2' is -1"}},
           {scaled, "how", "quadrature", {"quadrature", "monte-carlo"}}});
}

TEST(query_refusals, combinations_that_the_library_has_not)
{
    for (const char* method : {"turquin-eq12", "turquin-eq13", "turquin-eq14", "series",
                               "directional", "balanced", "burley-sheen"})
        check({{glass(), "method", method, {method, "does not go with dielectrics", "walk"}}});
    for (const char* method : {"turquin", "kulla-conty", "walk"})
        check({{sheen(), "method", method, {method, "does not go with sheen", "none"}}});
    json walk = glass();
    walk["method"] = "walk";
    json tail = glass();
    tail["method"] = "tail";
    check({{walk, "scatter_mode", "R", {"walk takes a dielectric of scatter mode RT"}},
           {walk, "transmission_shadowing", "correlated", {"walk needs", "beta"}},
           {tail, "transmission_shadowing", "correlated", {"tail needs", "beta"}},
           {walk, "strength", 0.5, {"'strength' is 0.5", "0 or 1"}},
           {walk, "n", 0, {"'n' is 0"}}});
    json walked = albedo();
    walked["method"] = "walk";
    check({{walked, "how", "quadrature", {"quadrature", "monte-carlo, table"}},
           {walked, "order", 0, {"'order' is 0"}}});
    json gain{{"op", "gain"}, {"closure", "conductor"}, {"mu", 0.5}};
    check({{gain, "method", "walk", {"walk replaces the lobe"}}});
}

TEST(query_refusals, ranges_of_gamma)
{
    json gtr = eval(), student = eval();
    gtr["distribution"] = "gtr";
    student["distribution"] = "std";
    check({{gtr, "gamma", 0, {"'gamma' is 0", "to 10"}},
           {gtr, "gamma", 10.5, {"'gamma' is 10.5", "to 10"}},
           {student, "gamma", 1.5, {"'gamma' is 1.5", "from 1.51"}}});
}

TEST(query_refusals, names_that_do_not_exist)
{
    check({{eval(), "op", "evil", {"there is no op 'evil'", "eval, pdf, sample"}},
           {eval(), "op", nullptr, {"'op' is missing", "given: closure, mu, wi"}},
           {eval(), "closure", nullptr, {"'closure' is missing"}},
           {eval(), "closure", "copper", {"there is no closure 'copper'", "conductor"}},
           {eval(), "distribution", "phong", {"there is no distribution 'phong'", "ggx"}},
           {eval(), "method", "turquin15", {"there is no method", "turquin-eq12"}},
           {eval(), "precision", "half", {"precision 'half'", "float, double"}},
           {eval(), "transport", "light", {"transport 'light'", "importance, radiance"}},
           {albedo(), "how", "guess", {"how 'guess'", "table, quadrature, monte-carlo"}}});
}

TEST(query_refusals, fields_that_nobody_asks_for)
{
    check({{eval(), "aplha", 0.5, {"no field 'aplha'", "accepted: op, closure", "alpha", "wi"}},
           {eval(), "u", {0, 0}, {"no field 'u'"}},
           {eval(), "color0", zero_to_one, {"no field 'color0'"}},
           {schlick(), "ior", zero_to_one, {"no field 'ior'", "color0"}},
           {schlick(), "wo", {0, 0, 1}, {"no field 'wo'"}},
           {albedo(), "n", 10, {"no field 'n'"}},
           {eval(), "fresnel", {{"F0", zero_to_one}, {"F90", zero_to_one}}, {"'F90'", "F0, F82"}}});
}

TEST(query_refusals, values_out_of_range)
{
    const std::string one = "from 0 to 1";
    check({{eval(), "alpha", 1.5, {"'alpha' is 1.5", one}},
           {eval(), "alpha", -1e-9, {"'alpha' is -1e-09", one}},
           {eval(), "alpha", {0.5, 2}, {"'alpha' is 2", one}},
           {eval(), "mu", 1.0000001, {"'mu' is 1.0000001", "from -1 to 1"}},
           {eval(), "strength", 2, {"'strength' is 2", one}},
           {eval(), "wi", {0, 0, 1.01}, {"'wi' is a vector of length 1.01", "within 0.001"}},
           {eval(), "wi", {0, 0, 0}, {"length 0", "unit"}},
           {eval(), "wi", {1e300, 1e300, 0}, {"'wi'", "unit"}},
           {eval(), "fresnel", {{"F0", {0.5, 1.5, 0.5}}}, {"'F0' is 1.5", one}},
           {eval(), "fresnel", {{"constant", {0, 0, -1}}}, {"'constant' is -1", one}},
           {eval(), "ior", {-1, 1, 1}, {"'ior' is -1", "from 0 to 10000"}},
           {schlick(), "exponent", 101, {"'exponent' is 101", "from 0 to 100"}},
           {schlick(), "mu", -0.5, {"'mu' is -0.5", one}},
           {sample(), "u", {0.5, 1}, {"'u' is 1", "from 0 to below 1"}},
           {samples(), "n", 0, {"'n' is 0", "from 1 to 1000000"}},
           {samples(), "n", 1000001, {"'n' is 1000001"}},
           {samples(), "seed", -1, {"'seed' is -1"}},
           {samples(), "seed", 0.5, {"'seed' is 0.5", "whole number"}}});
}

TEST(query_refusals, values_of_another_kind)
{
    check({{eval(), "op", 3, {"'op' is 3", "a text"}},
           {eval(), "alpha", "0.5", {"'alpha' is the text '0.5'", "a number"}},
           {eval(), "alpha", true, {"'alpha' is true"}},
           {eval(), "alpha", {0.1, 0.2, 0.3}, {"a list of 3", "a list of 2 numbers"}},
           {eval(), "alpha", {0.1, "b"}, {"the text 'b'"}},
           {eval(), "wi", {0, 1}, {"'wi' is a list of 2", "three numbers"}},
           {eval(), "wi", {0, 0, json::array()}, {"a list of 0"}},
           {eval(), "wi", {{"x", 1}}, {"an object"}},
           {eval(), "fresnel", 0.5, {"'fresnel' is 0.5", "an object"}},
           {eval(), "fresnel", {{"F0", 0.5}}, {"'F0' is 0.5", "a list of 3 numbers"}},
           {sample(), "u", 0.5, {"'u' is 0.5", "a list of 2 numbers"}},
           {sample(), "u", {0.1, 0.2, 0.3}, {"a list of 3"}}});
}

TEST(query_refusals, fields_that_are_missing_or_exclude_each_other)
{
    check({{eval(), "mu", nullptr, {"'wo' (or 'mu') is missing"}},
           {eval(), "wi", nullptr, {"'wi' is missing"}},
           {eval(), "wo", {0, 0, 1}, {"'wo' and 'mu' are both given"}},
           {sample(), "u", nullptr, {"'u' (or 'n') is missing"}},
           {sample(), "n", 3, {"accepted: 'u', or 'n' with 'seed'"}},
           {ndf(), "wm", nullptr, {"'wm' is missing"}},
           {schlick(), "mu", nullptr, {"'mu' is missing"}},
           {eval(), "fresnel", json::object(), {"holds one of"}},
           {eval(), "fresnel", {{"F0", zero_to_one}, {"constant", zero_to_one}}, {"one of"}},
           {eval(), "fresnel", {{"n", zero_to_one}}, {"'k' is missing", "given: n"}},
           {eval(), "fresnel", {{"F82", zero_to_one}}, {"'F0' is missing"}},
           {ndf(), "alpha", 0, {"alpha 0 makes a mirror", "above 1e-05"}},
           {ndf(), "mu", -0.5, {"'wo' is not above the surface"}}});
    json both = eval();
    both["ior"] = zero_to_one;
    check({{both, "fresnel", {{"F0", zero_to_one}}, {"'ior'", "one of the two"}}});
}

TEST(query_refusals, lines_that_are_no_query)
{
    const auto refused = [](const std::string& line, const std::string& part) {
        const std::string message = refusal(line);
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_LT(message.size(), 500u);
    };
    refused("nonsense", "no JSON");
    refused("{\"op\":\"eval\"", "no JSON");
    refused("{} {}", "no JSON");
    refused("{\"op\":\"eval\",}", "no JSON");
    refused("{\"op\":NaN}", "no JSON");
    refused("{\"alpha\":1e999}", "1e999");
    refused("{\"alpha\":-1e999}", "1e999");
    refused("3", "accepted: an object");
    refused("[]", "accepted: an object");
    refused("null", "accepted: an object");
    refused("{}", "'op' is missing in the query; given: nothing");
    refused(std::string("{\"op\":\"eval\"}\0", 14), "zero byte");
    refused("{\"op\":\"\xff\"}", "no JSON");
    refused("{\"mu\":1,\"mu\":2}", "'mu' is given twice");
    refused("{\"fresnel\":{\"F0\":1,\"F0\":2}}", "'F0' is given twice");
    refused(std::string(100000, '['), "nested too deep");
    std::string objects;
    for (int i = 0; i < 50000; ++i) objects += "{\"a\":";
    refused(objects, "nested too deep");
    refused("{\"" + std::string(100000, 'x') + "\":1}", "'op' is missing");
    refused("{\"op\":\"" + std::string(100000, 'x') + "\"}", "there is no op 'xxx");
    refused("{\"op\":\"" + std::string(100000, 'x'), "no JSON");
}

TEST(query_refusals, leave_nothing_of_an_answer)
{
    fmt::memory_buffer out;
    out.append(std::string_view("before"));
    EXPECT_FALSE(answer_line("{}", out));
    EXPECT_EQ(fmt::to_string(out).rfind("before{\"error\": \"", 0), 0u);
}
