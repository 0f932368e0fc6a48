// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Gains where E_ss is close to 0, and hooks of a host at their ends. Surfaces with long tails
// reflect only a few hundredths of what grazes them, a host's own table may hold a 0, and a host's
// hook returns what its author meant, black and very bright included.

#include "questions.h"

#include <regain/closures/compensated.h>
#include <regain/closures/conductor.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/std.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Real>
class Gains : public testing::Test
{
public:
    using Mirror = MicrofacetReflection<STD<Real>, ConstantFresnel<Real>>;

    static Mirror long_tailed(double F = 1)
    {
        return {STD<Real>(Real(1), Real(std_min_gamma)),
                ConstantFresnel<Real>(Color3<Real>(Real(F)))};
    }
    /// A table of one value at all nodes, as a host's own may be.
    static MicrofacetTables constant_tables(const std::uint16_t (&stored)[8],
                                            float scale = 1.0f / 65535)
    {
        MicrofacetTables t;
        t.E_ss = {stored, 2, 2, 2, 0, scale};
        t.E_avg = {stored, 2, 2, 1, 0, scale};
        return t;
    }
};
TYPED_TEST_SUITE(Gains, Numbers, NumberNames);

constexpr std::uint16_t zeros[8] = {}, ones[8] = {1, 1, 1, 1, 1, 1, 1, 1};

// The lowest E_ss there is: STD of the longest tail, width 1. Eq. 8 by hand.
TYPED_TEST(Gains, at_the_lowest_albedo_the_gain_is_equation_8)
{
    using Real = TypeParam;
    const auto tables = luts::microfacet_tables("std");
    for (double F0 : {0.04, 0.5, 1.0})
    {
        const auto lobe = TestFixture::long_tailed(F0);
        const TableAxes<Real> axes(lobe.distribution());
        for (double mu : {1e-11, 1e-7, 1e-4, 1e-2, 1.0})
        {
            const auto wo = towards<Real>(mu);
            const double E = double(tables.albedo(axes, wo.z)),
                         E_avg = double(tables.average_albedo(axes));
            EXPECT_LT(E, 0.15);
            const auto gain = [&](Method method) {
                const WhileLibraryRuns guard;
                const MethodGain<Real> of(lobe, method, tables, Real(1));
                return double(of.at(wo).x);
            };
            const double k = (1 - E) / E, tolerance = 20 * rounding<Real> * (1 + k);
            EXPECT_EQ(gain(Method::none), 1);
            EXPECT_NEAR(gain(Method::normalise), 1 + k, tolerance);
            EXPECT_NEAR(gain(Method::turquin), 1 + F0 * k, tolerance);
            EXPECT_NEAR(gain(Method::turquin_eq12), 1 + k * E_avg / (1 - F0 * (1 - E_avg)),
                        tolerance);
            EXPECT_NEAR(gain(Method::turquin_eq13), 1 + F0 * k, tolerance) << "alpha is 1";
            EXPECT_NEAR(gain(Method::turquin_eq14), 1 + F0 * k, tolerance);
            EXPECT_NEAR(gain(Method::series), 1 + k * F0 * E_avg / (1 - F0 * (1 - E_avg)),
                        tolerance);
        }
    }
}

// The smallest number of a table of 16 bits. E is 1 / 65535, and the gain 65535.
TYPED_TEST(Gains, the_smallest_number_of_a_table_gives_its_inverse)
{
    using Real = TypeParam;
    const auto lobe = TestFixture::long_tailed();
    const auto tables = TestFixture::constant_tables(ones);
    for (Method method : all_methods)
    {
        if (method == Method::none) continue;
        const WhileLibraryRuns guard;
        const MethodGain<Real> gain(lobe, method, tables, Real(1));
        // 1 - F + F E is E where F is 1, unless the compiler makes 1 - F (1 - E) of it again.
        const double tolerance = fast_math ? 65535.0 * 65535 * 1e-7 : 0.5;
        EXPECT_NEAR(gain.at(towards<Real>(0.3)).x, 65535, tolerance) << name(method);
    }
}

// A table of a host that holds a 0: what is divided by is 1e-12 then, as the header says.
TYPED_TEST(Gains, an_albedo_of_0_counts_as_1e_12)
{
    using Real = TypeParam;
    const auto lobe = TestFixture::long_tailed();
    const auto tables = TestFixture::constant_tables(zeros);
    for (Method method :
         {Method::normalise, Method::turquin, Method::turquin_eq13, Method::turquin_eq14})
    {
        const WhileLibraryRuns guard;
        const MethodGain<Real> gain(lobe, method, tables, Real(1));
        EXPECT_NEAR(gain.at(towards<Real>(0.3)).x, 1 + 1e12, 1e12 * rounding<Real>) << name(method);
    }
    // E_avg = 0 with F = 1 is 0 / 0: a surface that lets nothing out.
    for (Method method : {Method::turquin_eq12, Method::series})
    {
        const WhileLibraryRuns guard;
        const MethodGain<Real> gain(lobe, method, tables, Real(1));
        examine(gain.at(towards<Real>(0.3)), name(method).data());
    }
    // An added lobe takes all, and gives back all times F_ms = E_avg / ... = 0.
    const auto closure = kulla_conty(lobe, KullaContyForm::printed, tables);
    const auto wo = towards<Real>(0.3);
    examine(closure.eval(wo, towards<Real>(0.5, 3)), "eval");
    for (Real u : {Real(0), Real(0.5), Real(1)}) examine(closure.sample(wo, {u, u, u}));
}

// The other end, where nothing is missing: the gain is 1, the added lobe black, bit for bit.
TYPED_TEST(Gains, where_nothing_is_missing_nothing_is_added)
{
    using Real = TypeParam;
    const auto lobe = TestFixture::long_tailed(0.5);
    const auto tables = TestFixture::constant_tables(ones, 1);
    const auto wo = towards<Real>(0.3), wi = towards<Real>(0.6, 3);
    const WhileLibraryRuns guard;
    for (Method method : all_methods)
        EXPECT_EQ(MethodGain<Real>(lobe, method, tables, Real(1)).at(wo), Color3<Real>(Real(1)));
    const auto closure = kulla_conty(lobe, KullaContyForm::printed, tables);
    EXPECT_EQ(closure.eval(wo, wi), lobe.eval(wo, wi));
    EXPECT_EQ(closure.pdf(wo, wi), lobe.pdf(wo, wi));
}

// A hook that returns the same colour for all directions.
template <class Real>
struct Constant
{
    Color3<Real> value;
    Color3<Real> at(const Vec3<Real>&) const { return value; }
};

// One that demands unit directions, which it is promised.
template <class Real>
struct Demanding
{
    static constexpr bool depends_on_wi = true;
    static bool is_unit(const Vec3<Real>& w)
    {
        return is_finite(w.x) && is_finite(w.y) && is_finite(w.z) &&
               std::abs(double(w.length()) - 1) < 1e-2;
    }
    Color3<Real> at(const Vec3<Real>& wo) const
    {
        EXPECT_TRUE(is_unit(wo)) << wo;
        return Color3<Real>(Real(2));
    }
    Color3<Real> pair(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        EXPECT_TRUE(is_unit(wo) && is_unit(wi)) << wo << wi;
        return Color3<Real>(Real(3));
    }
};

// A hook that switches a lobe off, or makes it a lamp: weights follow it exactly, and no direction
// or pdf moves.
TYPED_TEST(Gains, a_hook_of_0_is_black_and_one_of_a_million_a_million_times_as_bright)
{
    using Real = TypeParam;
    const auto lobe = TestFixture::long_tailed(0.5);
    const auto wi = towards<Real>(0.6, 3);
    for (double value : {0.0, 1e6, 1e30})
    {
        const Color3<Real> gain(Real(value), Real(1), Real(0));
        const auto closure = compensated(lobe, Constant<Real>{gain});
        for (double mu : {1e-4, 0.5, 1.0})
        {
            const auto wo = towards<Real>(mu);
            const auto f = closure.eval(wo, wi), bare = lobe.eval(wo, wi);
            const double tolerance = 4 * rounding<Real>;
            expect_color_near(f, Color3<double>(double(gain.x) * double(bare.x), double(bare.y), 0),
                              tolerance * (double(gain.x) + 1) * double(bare.x), "eval");
            EXPECT_EQ(f.z, 0);
            EXPECT_EQ(closure.pdf(wo, wi), lobe.pdf(wo, wi));
            const Vec3<Real> u(Real(0.2), Real(0.7), Real(0.4));
            const auto s = closure.sample(wo, u), t = lobe.sample(wo, u);
            EXPECT_EQ(s.valid, t.valid);
            EXPECT_EQ(s.wi, t.wi);
            EXPECT_EQ(s.pdf, t.pdf);
            EXPECT_EQ(s.weight.z, 0);
            EXPECT_NEAR(s.weight.x, double(gain.x) * double(t.weight.x),
                        tolerance * double(gain.x) * double(t.weight.x));
        }
    }
}

// Whatever a host passes to the closure, its hook is asked about directions.
TYPED_TEST(Gains, a_hook_is_asked_about_unit_directions_only)
{
    using Real = TypeParam;
    const auto lobe = TestFixture::long_tailed(0.5);
    const auto closure = compensated(lobe, Demanding<Real>());
    const Vec3<Real> good = towards<Real>(0.5), flat(1, 0, 0), none(0, 0, 0),
                     longer = good * Real(1.5);
    for (const auto& wo : {good, flat, none, longer, -good})
        for (const auto& wi : {good, flat, none, longer, -good})
            examine(closure.eval(wo, wi), "eval");
    EXPECT_NEAR(closure.eval(good, good).x, 6 * double(lobe.eval(good, good).x),
                rounding<Real> * 6 * double(lobe.eval(good, good).x));
}
TYPED_TEST(Gains, a_hook_is_not_asked_about_nan)
{
    REGAIN_NEEDS_INFINITIES();
    using Real = TypeParam;
    const auto closure = compensated(TestFixture::long_tailed(0.5), Demanding<Real>());
    const Vec3<Real> good = towards<Real>(0.5), bad{Real(tests::nan)}, far{Real(infinity), 0, 0};
    for (const auto& wo : {good, bad, far})
        for (const auto& wi : {bad, far}) EXPECT_EQ(closure.eval(wo, wi).x, 0);
}

// The slider from single scattering to all of it: 0 is the lobe as it was, beyond the ends is the
// end.
TYPED_TEST(Gains, a_strength_beyond_0_and_1_is_its_end)
{
    const auto compensating = [](const auto& kind) {
        return !kind.is_bare() && !kind.is_walk() && !kind.distribution.empty();
    };
    const Member strength = [](Parameters& s) -> double& { return s.strength; };
    expect_taken_for<TypeParam>(compensating, strength, "strength",
                                {{-1, 0}, {-0.0, 0}, {1.5, 1}, {3e38, 1}, {1 + 1e-7, 1}});
}
TYPED_TEST(Gains, a_strength_that_is_no_number_is_0)
{
    REGAIN_NEEDS_INFINITIES();
    const auto compensating = [](const auto& kind) {
        return !kind.is_bare() && !kind.is_walk() && !kind.distribution.empty();
    };
    const Member strength = [](Parameters& s) -> double& { return s.strength; };
    expect_taken_for<TypeParam>(compensating, strength, "strength",
                                {{tests::nan, 0}, {infinity, 1}, {-infinity, 0}});
}

// At strength 0 a gain is no gain, bit for bit.
TYPED_TEST(Gains, a_strength_of_0_is_the_method_none)
{
    using Real = TypeParam;
    const auto& all = kinds<Real>();
    for_each_kind<Real>(
        [](const auto& kind) {
            return kind.is_mirror() && !kind.is_bare() && !kind.is_walk() && !kind.has_added_lobe();
        },
        [&](const auto& kind) {
            for (const auto& other : all)
            {
                if (!(other.is_bare() && other.lobe == kind.lobe && other.batch == kind.batch &&
                      other.distribution == kind.distribution))
                    continue;
                Parameters parameters;
                parameters.strength = 0;
                expect_same_answers<Real>(*kind.make(parameters), *other.make(parameters),
                                          "strength 0");
            }
        });
}

}  // namespace
