// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What an adapter is told of a closure: its parameters as they were given, however it is wrapped.

#include "../support/closures.h"
#include "../support/interfaces.h"

#include <regain/closures/dielectric_kulla_conty.h>
#include <regain/closures/diffuse.h>
#include <regain/closures/host_queries.h>
#include <regain/closures/sheen.h>
#include <regain/closures/sum.h>
#include <regain/closures/thin_dielectric.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

const Diffuse<double> paint(Color3<double>(0.5));
const Sheen<double> cloth(0.5);
const GGX<double> wide(0.2, 0.6), narrow(0.1, 0.3), flat(0);

Dielectric<GGX<double>> glass(const GGX<double>& distribution) { return {distribution, 1.5}; }
auto metal(const GGX<double>& distribution)
{
    return WhiteMirror<double>(distribution, ConstantFresnel<double>());
}

TEST(HostQueries, the_index_is_that_of_the_interface_inside)
{
    EXPECT_EQ(relative_index(glass(wide)), 1.5);
    EXPECT_EQ(relative_index(compensated(glass(wide), Method::turquin, DielectricTables())), 1.5);
    EXPECT_EQ(relative_index(sum(glass(wide), paint)), 1.5);
    EXPECT_EQ(relative_index(kulla_conty(glass(wide), DielectricTables())), 1.5);
    // One medium is on both sides of a sheet, and of what has no index.
    EXPECT_EQ(relative_index(ThinDielectric<GGX<double>>(wide, 1.5)), 1);
    EXPECT_EQ(relative_index(metal(wide)), 1);
    EXPECT_EQ(relative_index(paint), 1);
}

TEST(HostQueries, the_width_is_the_widest_of_all_there_are)
{
    EXPECT_EQ(widest_alpha(metal(wide)), 0.6);
    EXPECT_EQ(widest_alpha(metal(GGX<double>(0.7, 0.2))), 0.7);
    EXPECT_EQ(widest_alpha(ThinDielectric<GGX<double>>(wide, 1.5)), 0.6);
    EXPECT_EQ(widest_alpha(compensated(metal(narrow), Method::none, MicrofacetTables())), 0.3);
    EXPECT_EQ(widest_alpha(sum(metal(narrow), metal(wide))), 0.6);
    EXPECT_EQ(widest_alpha(sum(metal(wide), metal(narrow))), 0.6);
    EXPECT_EQ(widest_alpha(paint), 1);
    EXPECT_EQ(widest_alpha(sum(metal(wide), paint)), 1);
}

TEST(HostQueries, only_what_scatters_nowhere_else_is_delta)
{
    EXPECT_TRUE(is_delta(metal(flat)));
    EXPECT_TRUE(is_delta(glass(flat)));
    EXPECT_TRUE(is_delta(compensated(metal(flat), Method::none, MicrofacetTables())));
    EXPECT_TRUE(is_delta(sum(metal(flat), glass(flat))));
    EXPECT_FALSE(is_delta(metal(wide)));
    EXPECT_FALSE(is_delta(paint));
    EXPECT_FALSE(is_delta(sum(metal(flat), paint)));
    EXPECT_FALSE(is_delta(sum(metal(wide), metal(flat))));
    EXPECT_FALSE(is_delta(LambertInterface<double>(1.5, 0.8, Discrete::transmitted)));
}

TEST(HostQueries, an_interface_is_what_transmits_or_has_an_index)
{
    EXPECT_TRUE(is_interface(glass(wide)));
    EXPECT_TRUE(is_interface(ThinDielectric<GGX<double>>(wide, 1.5)));
    EXPECT_TRUE(is_interface(Dielectric<GGX<double>>(wide, 1.5, ScatterMode::R)));
    EXPECT_FALSE(is_interface(metal(wide)));
    EXPECT_FALSE(is_interface(sum(metal(wide), cloth)));
}

// There and back again radiance is what it was.
TEST(HostQueries, radiance_is_scaled_by_the_square_of_the_indices_across_only)
{
    const auto up = direction<double>(0.8), down = direction<double>(-0.3);
    EXPECT_EQ(radiance_factor(glass(wide), up, up), 1);
    EXPECT_EQ(radiance_factor(glass(wide), down, down), 1);
    EXPECT_DOUBLE_EQ(radiance_factor(glass(wide), down, up), 2.25);
    EXPECT_DOUBLE_EQ(radiance_factor(glass(wide), up, down), 1 / 2.25);
}

struct OneClosure
{
    template <class Real>
    auto closure(Real strength) const
    {
        return Diffuse<Real>(Color3<Real>(strength));
    }
};
struct EitherClosure
{
    bool shiny;

    template <class Real, class Visit>
    double with_closure(Real strength, const Visit& visit) const
    {
        return shiny ? visit(metal(wide)) : visit(OneClosure().closure(strength));
    }
};

TEST(HostQueries, a_material_shows_its_closure_whichever_way_it_has_one)
{
    const auto albedo = [](const auto& closure) {
        return closure.albedo(direction<double>(1)).reflect.x;
    };
    EXPECT_DOUBLE_EQ(with_closure(OneClosure(), 0.25, albedo), 0.25);
    EXPECT_DOUBLE_EQ(with_closure(EitherClosure{false}, 0.25, albedo), 0.25);
    EXPECT_DOUBLE_EQ(with_closure(EitherClosure{true}, 0.25, albedo), albedo(metal(wide)));
}

TEST(HostQueries, what_is_prepared_tells_for_which_direction)
{
    const auto wo = direction<double>(0.6, 1.0);
    const auto told = [&](const auto& closure) {
        return Vec3<double>(closure.prepare(wo).wo()).equalWithAbsError(wo, 1e-15);
    };
    EXPECT_TRUE(told(paint));
    EXPECT_TRUE(told(cloth));
    EXPECT_TRUE(told(metal(wide)));
    EXPECT_TRUE(told(sum(cloth, metal(wide))));
    EXPECT_TRUE(told(compensated(metal(wide), Method::turquin, luts::ggx_tables())));
    const Vec3<double> below(wo.x, wo.y, -wo.z);
    EXPECT_TRUE(
        ThinDielectric<GGX<double>>(wide, 1.5).prepare(below).wo().equalWithAbsError(below, 1e-15));
}

}  // namespace
