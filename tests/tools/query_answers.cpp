// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Each operation answers what the library does, number for number.

#include "query_answer.h"
#include "random_numbers.h"

#include <regain/closures/compensated.h>
#include <regain/closures/conductor.h>
#include <regain/closures/generalized_schlick.h>
#include <regain/luts/builtin.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace regain;
using namespace regain::tools;
using nlohmann::json;

namespace {

json answer(const json& query)
{
    fmt::memory_buffer out;
    const bool answered = answer_line(query.dump(), out);
    const json a = json::parse(fmt::to_string(out));
    EXPECT_EQ(answered, !a.contains("error")) << a;
    return a;
}

template <class Real>
void expect_equal(const json& list, const Imath::Vec3<Real>& v)
{
    ASSERT_EQ(list.size(), 3u) << list;
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(static_cast<Real>(list[static_cast<std::size_t>(i)].get<double>()), v[i]) << list;
}

// Directions that are exact in both precisions.
const Imath::V3d wo(0.5, -0.5, 0.70703125), wi(0.5, 0.5, 0.70703125);

json query(const std::string& op, const std::string& precision)
{
    return {{"op", op},
            {"closure", "generalized_schlick"},
            {"alpha", {0.25, 0.5}},
            {"fresnel", {{"F0", {0.5, 0.25, 0.125}}, {"F82", {0.5, 1, 0.75}}}},
            {"method", "turquin"},
            {"strength", 0.75},
            {"precision", precision},
            {"wo", {wo.x, wo.y, wo.z}}};
}

template <class Real>
auto closure()
{
    using Color = Color3<Real>;
    const GeneralizedSchlick<Real> lobe(
        GGX<Real>(Real(0.25), Real(0.5)),
        SchlickFresnel<Real>(Color(Real(0.5), Real(0.25), Real(0.125)),
                             Color(Real(0.5), Real(1), Real(0.75))));
    MicrofacetTables tables = luts::ggx_tables();
    luts::add_anisotropy(tables, "ggx");
    return compensated(lobe, Method::turquin, tables, Real(0.75));
}

template <class Real>
class query_answers : public testing::Test
{
protected:
    using Vec = Vec3<Real>;
    const std::string precision = sizeof(Real) == 4 ? "float" : "double";
    const Vec o{Real(wo.x), Real(wo.y), Real(wo.z)}, i{Real(wi.x), Real(wi.y), Real(wi.z)};
};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(query_answers, Precisions);

}  // namespace

TYPED_TEST(query_answers, eval_and_pdf_are_the_closures_to_the_bit)
{
    json q = query("eval", this->precision);
    q["wi"] = {wi.x, wi.y, wi.z};
    expect_equal(answer(q)["value"], closure<TypeParam>().eval(this->o, this->i));
    q["op"] = "pdf";
    EXPECT_EQ(answer(q)["pdf"].template get<TypeParam>(),
              closure<TypeParam>().pdf(this->o, this->i));
}

TYPED_TEST(query_answers, sample_is_the_closures_to_the_bit)
{
    json q = query("sample", this->precision);
    q["u"] = {0.25, 0.125};
    const json a = answer(q);
    const auto s = closure<TypeParam>().sample(this->o, {TypeParam(0.25), TypeParam(0.125)});
    expect_equal(a["wi"], s.wi);
    expect_equal(a["weight"], s.weight);
    EXPECT_EQ(a["pdf"].template get<TypeParam>(), s.pdf);
    EXPECT_EQ(a["event"], "reflect");
    EXPECT_EQ(a["measure"], "continuous");
}

TYPED_TEST(query_answers, samples_follow_the_documented_generator)
{
    json q = query("sample", this->precision);
    q["n"] = 50;
    q["seed"] = 7;
    const json samples = answer(q)["samples"];
    ASSERT_EQ(samples.size(), 50u);
    RandomNumbers random(7);
    for (const json& a : samples)
    {
        const TypeParam u = random.next<TypeParam>(), v = random.next<TypeParam>();
        const auto s = closure<TypeParam>().sample(this->o, {u, v});
        ASSERT_EQ(a["event"], s.valid ? "reflect" : "none");
        if (s.valid) expect_equal(a["wi"], s.wi);
    }
}

TYPED_TEST(query_answers, gain_and_table_albedo_are_the_closures)
{
    json q = query("gain", this->precision);
    const json gain = answer(q);
    expect_equal(gain["gain"], closure<TypeParam>().gain().at(this->o));
    EXPECT_EQ(gain["form"], "gain(wo)");
    q["op"] = "albedo";
    q["how"] = "table";
    const json albedo = answer(q);
    expect_equal(albedo["reflect"], closure<TypeParam>().albedo(this->o).reflect);
    EXPECT_EQ(albedo["transmit"], json({0, 0, 0}));
    EXPECT_EQ(albedo["how"], "table");
    EXPECT_TRUE(albedo["stderr"].is_null());
}

TYPED_TEST(query_answers, fresnel_is_the_library_s)
{
    const json a = answer({{"op", "fresnel"},
                           {"fresnel", {{"n", {0.25, 0.5, 1.5}}, {"k", {3, 2, 1}}}},
                           {"mu", 0.25},
                           {"precision", this->precision}});
    using Color = Color3<TypeParam>;
    const ConductorFresnel<TypeParam> F(Color(TypeParam(0.25), TypeParam(0.5), TypeParam(1.5)),
                                        Color(3, 2, 1));
    expect_equal(a["value"], F.at(TypeParam(0.25)));
    expect_equal(a["average"], F.average());
}

TYPED_TEST(query_answers, ndf_is_the_library_s)
{
    const json a = answer({{"op", "ndf"},
                           {"alpha", {0.25, 0.5}},
                           {"wo", {wo.x, wo.y, wo.z}},
                           {"wm", {wi.x, wi.y, wi.z}},
                           {"precision", this->precision}});
    const GGX<TypeParam> ggx(TypeParam(0.25), TypeParam(0.5));
    EXPECT_EQ(a["D"].template get<TypeParam>(), ggx.D(this->i));
    EXPECT_EQ(a["lambda"].template get<TypeParam>(), ggx.lambda(this->o));
    EXPECT_EQ(a["G1"].template get<TypeParam>(), ggx.G1(this->o));
    const TypeParam facing = detail::dot(this->o, this->i);
    EXPECT_NEAR(a["D_visible"].template get<TypeParam>(),
                facing * ggx.D(this->i) * ggx.G1(this->o) / this->o.z, 1e-6);
}

TEST(query_answers_of_ndf, hidden_and_buried_normals_are_not_visible)
{
    const json q{{"op", "ndf"}, {"alpha", 0.5}, {"wo", {0.8, 0, 0.6}}, {"wm", {-0.8, 0, 0.6}}};
    EXPECT_GT(answer(q)["D"], 0);
    EXPECT_EQ(answer(q)["D_visible"], 0);
    json below = q;
    below["wm"] = {0.8, 0, -0.6};
    EXPECT_EQ(answer(below)["D"], 0);
}

TEST(query_defaults, are_materialx_s)
{
    json q{{"op", "fresnel"}, {"closure", "conductor"}, {"mu", 1}};
    json explicitly = q;
    explicitly["ior"] = {0.183, 0.421, 1.373};
    explicitly["extinction"] = {3.424, 2.346, 1.770};
    EXPECT_EQ(answer(q), answer(explicitly));

    q["closure"] = "generalized_schlick";
    EXPECT_EQ(answer(q)["value"], json({1, 1, 1}));
    q["color0"] = {0.5, 0.25, 0};
    EXPECT_EQ(answer(q)["value"], json({0.5, 0.25, 0}));
    q["mu"] = 0;
    q["color90"] = {0.5, 1, 0.75};
    EXPECT_EQ(answer(q)["value"], json({0.5, 1, 0.75}));

    json eval{{"op", "eval"}, {"closure", "conductor"}, {"mu", 1}, {"wi", {0, 0, 1}}};
    const json without = answer(eval);
    eval["alpha"] = 0.05;
    eval["method"] = "none";
    eval["strength"] = 1;
    eval["precision"] = "float";
    eval["transport"] = "importance";
    eval["distribution"] = "ggx";
    EXPECT_EQ(answer(eval), without);
}

TEST(query_defaults, radiance_and_importance_are_the_same_for_reflection)
{
    json q = query("eval", "double");
    q["wi"] = {wi.x, wi.y, wi.z};
    const json importance = answer(q);
    q["transport"] = "radiance";
    EXPECT_EQ(answer(q), importance);
}

TEST(query_answers_of_mirrors, are_delta_samples_and_black_values)
{
    json q{{"op", "sample"},       {"closure", "conductor"},
           {"alpha", 0},           {"mu", 0.6},
           {"u", {0, 0}},          {"fresnel", {{"constant", {0.5, 0.5, 0.5}}}},
           {"precision", "double"}};
    const json s = answer(q);
    EXPECT_EQ(s["measure"], "delta");
    EXPECT_EQ(s["weight"], json({0.5, 0.5, 0.5}));
    EXPECT_DOUBLE_EQ(s["wi"][0], -0.8);
    q.erase("u");
    q["wi"] = s["wi"];
    q["op"] = "eval";
    EXPECT_EQ(answer(q)["value"], json({0, 0, 0}));
    q["op"] = "pdf";
    EXPECT_EQ(answer(q)["pdf"], 0);
    q.erase("wi");
    q["op"] = "albedo";
    EXPECT_EQ(answer(q)["reflect"], json({0.5, 0.5, 0.5}));
}

TEST(query_answers_below_the_horizon, are_black_and_have_no_samples)
{
    json q{{"op", "sample"},
           {"closure", "conductor"},
           {"alpha", 0.5},
           {"mu", -0.5},
           {"u", {0.5, 0.5}}};
    EXPECT_EQ(answer(q), json({{"event", "none"}}));
    q.erase("u");
    q["op"] = "gain";
    q["method"] = "turquin";
    EXPECT_EQ(answer(q)["gain"], json({1, 1, 1}));
}

TEST(query_answers_of_gain, without_a_method_is_1)
{
    const json a = answer({{"op", "gain"}, {"closure", "conductor"}, {"alpha", 0.5}, {"mu", 0.5}});
    EXPECT_EQ(a, json({{"gain", {1, 1, 1}}, {"form", "none"}}));
}

TEST(query_answers_of_albedo, three_ways_agree)
{
    json q{{"op", "albedo"}, {"closure", "conductor"},
           {"alpha", 0.5},   {"method", "turquin"},
           {"mu", 0.3},      {"fresnel", {{"constant", {1, 1, 1}}}}};
    const json quadrature = answer(q);
    EXPECT_EQ(quadrature["how"], "quadrature");
    EXPECT_LT(quadrature["stderr"], 1e-6);
    q["how"] = "monte-carlo";
    q["n"] = 20000;
    q["seed"] = 3;
    const json mc = answer(q);
    EXPECT_NEAR(mc["reflect"][0], quadrature["reflect"][0], 5 * mc["stderr"].get<double>());
    EXPECT_EQ(answer(q), mc) << "the same seed gives the same number";
    q["seed"] = 4;
    EXPECT_NE(answer(q), mc);
}

TEST(query_answers_of_sample, u_below_1_is_so_in_float_too)
{
    json q{{"op", "sample"},
           {"closure", "conductor"},
           {"alpha", 0.5},
           {"mu", 0.5},
           {"u", {0.9999999999999999, 0.9999999999999999}}};
    EXPECT_FALSE(answer(q).contains("error"));
}
