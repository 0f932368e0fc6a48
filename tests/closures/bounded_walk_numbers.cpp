// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The walks of bounded cost and the numbers they are given: garbage, the same numbers twice, the
// number types.

#include "../support/hostile.h"
#include "../support/walks.h"

#include <regain/closures/bounded_dielectric_walk.h>
#include <regain/closures/bounded_walk.h>
#include <regain/closures/xsimd.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

template <class Closure, class Real>
void check_garbage(const Closure& walk, Hostile<Real>& hostile, long& failures)
{
    const auto numbers = [&] {
        const Real x = hostile.random_number(), y = hostile.random_number();
        return Vec3<Real>(x, y, hostile.random_number());
    };
    const Vec3<Real> wo = hostile.any_direction(), wi = hostile.any_direction();
    const auto prepared = walk.prepare(wo);
    const Color3<Real> f = prepared.eval(wi, numbers());
    const Real pdf = prepared.pdf(wi);
    const Sample<Real> s = prepared.sample(numbers());
    const bool good = sane(f) && sane(s.weight) && std::isfinite(pdf) && pdf >= 0 &&
                      std::isfinite(s.pdf) && s.pdf >= 0 && (!s.valid || s.pdf > 0) &&
                      std::abs(s.wi.length() - 1) < 2e-6 && sane(prepared.path(numbers()).weight);
    if (!good && failures++ < 5)
        ADD_FAILURE() << "wo " << wo << ", wi " << wi << ": eval " << f << ", pdf " << pdf
                      << ", sample " << s.wi << " " << s.weight << " " << s.pdf;
}

struct Tables
{
    MicrofacetTables shape = luts::microfacet_tables("ggx");
    DielectricTables glass = luts::dielectric_tables("ggx", TransmissionShadowing::beta);

    Tables()
    {
        luts::add_later_bounces(shape, "ggx");
        luts::add_later_shape(shape, "ggx");
    }
};

template <class Distribution, class Real>
void check_garbage_of(const Distribution& distribution, const Tables& all, Hostile<Real>& hostile,
                      std::uint64_t pick, long& failures)
{
    const int samples = pick % 10 ? 1 : 2, bounces = pick % 7 ? 16 : int(pick % 40) - 3;
    const MicrofacetTables shape =
        pick % 3 && !Distribution::has_tail ? all.shape : MicrofacetTables{};
    check_garbage(BoundedWalk<Distribution, SchlickFresnel<Real>>(
                      distribution, SchlickFresnel<Real>(hostile.color(), hostile.color()), samples,
                      shape, bounces),
                  hostile, failures);
    const Real eta = hostile.number(), usual = Real(0.3 + 0.02 * double(pick % 64));
    check_garbage(BoundedDielectricWalk<Distribution>(
                      distribution, pick % 4 ? usual : eta, hostile.color(), hostile.color(),
                      samples, pick % 3 ? all.glass : DielectricTables{}, shape, bounces),
                  hostile, failures);
}

template <class Real>
void run_garbage(int calls)
{
    Hostile<Real> hostile(7 + sizeof(Real));
    Random random(23);
    const Tables tables;
    long failures = 0;
    const Trapped trapped;
    for (int i = 0; i < calls; ++i)
    {
        const Real ax = hostile.parameter(), ay = i % 3 ? ax : hostile.parameter();
        const std::uint64_t pick = random.bits();
        check_garbage_of(GGX<Real>(ax, ay), tables, hostile, pick, failures);
        if (i % 8 == 0) check_garbage_of(Beckmann<Real>(ax, ay), tables, hostile, pick, failures);
        if (i % 16 == 0)
        {
            const Real gamma = i % 64 ? Real(5 * random.unit()) : hostile.number();
            check_garbage_of(GTR<Real>(ax, ay, gamma), tables, hostile, pick, failures);
            check_garbage_of(STD<Real>(ax, ay, gamma), tables, hostile, pick, failures);
        }
    }
    EXPECT_EQ(failures, 0);
}

TEST(BoundedWalkNumbers, float_walks_stay_finite) { run_garbage<float>(60000); }
TEST(BoundedWalkNumbers, double_walks_stay_finite) { run_garbage<double>(15000); }

// Random numbers are arguments: nothing else decides.
TEST(BoundedWalkNumbers, the_same_numbers_give_the_same_answer)
{
    for_each_distribution<float>([](const auto& distribution, const char*) {
        using Distribution = std::decay_t<decltype(distribution)>;
        const auto check = [](const auto& walk) {
            Random random(21);
            const auto a = walk.prepare(direction<float>(0.4)), b = walk.prepare(a.wo());
            for (int i = 0; i < 200; ++i)
            {
                const auto u = random.cube<float>();
                const auto wi = direction<float>(random.unit(), 7 * random.unit());
                const auto s = a.sample(u), t = b.sample(u);
                ASSERT_EQ(s.wi, t.wi);
                ASSERT_EQ(s.weight, t.weight);
                ASSERT_EQ(s.pdf, t.pdf);
                ASSERT_EQ(a.eval(wi, u), b.eval(wi, u));
            }
        };
        check(BoundedWalk<Distribution, ConstantFresnel<float>>(distribution,
                                                                ConstantFresnel<float>()));
        check(BoundedDielectricWalk<Distribution>(distribution, 1.5f));
    });
}

using Batch = xsimd::batch<float>;
constexpr std::size_t lanes = Batch::size;

struct Lanes
{
    alignas(64) float value[lanes] = {};
    Batch load() const { return Batch::load_aligned(value); }
};

// In each lane what a float gets, but where a rounding sends a walk elsewhere.
template <class MakeBatch, class MakeFloat>
void compare_with_lanes(const MakeBatch& of_batch, const MakeFloat& of_float)
{
    Random random(22);
    int compared = 0, apart = 0;
    for (int group = 0; group < 300; ++group)
    {
        Lanes alpha, wo[3], wi[3], u[3];
        for (std::size_t l = 0; l < lanes; ++l)
        {
            alpha.value[l] = float(0.1 + 0.9 * random.unit());
            const double side = random.unit() < 0.3 ? -1 : 1;
            const auto o = direction<float>(0.05 + 0.95 * random.unit(), 7 * random.unit()),
                       i = direction<float>(side * (0.05 + 0.95 * random.unit()),
                                            7 * random.unit());
            const auto numbers = random.cube<float>();
            for (int k = 0; k < 3; ++k)
            {
                wo[k].value[l] = o[k];
                wi[k].value[l] = i[k];
                u[k].value[l] = numbers[k];
            }
        }
        const auto load = [](const Lanes(&v)[3]) {
            return Vec3<Batch>(v[0].load(), v[1].load(), v[2].load());
        };
        const auto prepared = of_batch(alpha.load()).prepare(load(wo));
        const auto s = prepared.sample(load(u));
        const auto f = prepared.eval(load(wi), load(u));
        Lanes x, y, pdf, value;
        s.wi.x.store_aligned(x.value);
        s.wi.y.store_aligned(y.value);
        s.pdf.store_aligned(pdf.value);
        f.y.store_aligned(value.value);
        for (std::size_t l = 0; l < lanes; ++l)
        {
            const auto at = [l](const Lanes(&v)[3]) {
                return Vec3<float>(v[0].value[l], v[1].value[l], v[2].value[l]);
            };
            const auto scalar = of_float(alpha.value[l]).prepare(at(wo));
            const auto t = scalar.sample(at(u));
            const float e = scalar.eval(at(wi), at(u)).y;
            ++compared;
            if (std::abs(x.value[l] - t.wi.x) > 1e-3f || std::abs(y.value[l] - t.wi.y) > 1e-3f ||
                std::abs(pdf.value[l] - t.pdf) > 0.02f * t.pdf + 1e-4f ||
                std::abs(value.value[l] - e) > 0.02f * e + 1e-4f)
                ++apart;
        }
    }
    EXPECT_LT(apart, 0.01 * compared);
}

TEST(BoundedWalkNumbers, a_vector_of_floats_walks_as_each_float_does)
{
    const Tables tables;
    const auto metal = [&](auto alpha) {
        using Real = decltype(alpha);
        return BoundedWalk<GGX<Real>, SchlickFresnel<Real>>(
            GGX<Real>(alpha),
            SchlickFresnel<Real>(Color3<Real>(Real(0.9f), Real(0.5f), Real(0.2f))), 1,
            tables.shape);
    };
    compare_with_lanes(metal, metal);
    // A bound that many walks meet.
    const auto gtr = [](auto alpha) {
        using Real = decltype(alpha);
        return BoundedWalk<GTR<Real>, SchlickFresnel<Real>>(
            GTR<Real>(alpha, alpha, Real(1.5f)),
            SchlickFresnel<Real>(Color3<Real>(Real(0.9f), Real(0.5f), Real(0.2f))), 2,
            MicrofacetTables{}, 3);
    };
    compare_with_lanes(gtr, gtr);
    const auto glass = [&](auto alpha) {
        using Real = decltype(alpha);
        const Color3<Real> one(Real(1));
        return BoundedDielectricWalk<GGX<Real>>(GGX<Real>(alpha), Real(1.5f), one, one, 2,
                                                tables.glass, tables.shape, 4);
    };
    compare_with_lanes(glass, glass);
}

}  // namespace
