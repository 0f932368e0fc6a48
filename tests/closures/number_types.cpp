// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// One source, three number types: float, double and a vector of floats say the same.

#include "../support/closures.h"
#include "../support/trapped.h"

#include <regain/closures/gaussian_tail.h>
#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

using namespace regain;
using namespace regain::tests;

namespace {

using Batch = xsimd::batch<float>;
constexpr std::size_t lanes = Batch::size;

// The lanes of a vector of directions, colours or numbers.
struct Lanes
{
    alignas(64) float value[lanes] = {};
    Batch load() const { return Batch::load_aligned(value); }
    explicit Lanes(const Batch& b) { b.store_aligned(value); }
    Lanes() = default;
};

struct Case
{
    double alpha_x, alpha_y;
    Vec3<float> wo, wi;
    Vec2<float> u;
};

std::vector<Case> cases()
{
    Random random(17);
    std::vector<Case> all;
    for (int i = 0; i < 4096; ++i)
    {
        const double alpha = std::pow(random.unit(), 2), ratio = i % 3 ? 1 : 0.3;
        all.push_back({i % 50 ? alpha : 0, i % 50 ? alpha * ratio : 0,
                       direction<float>(random.unit(), 7 * random.unit()),
                       direction<float>(random.unit(), 7 * random.unit()), random.square<float>()});
    }
    return all;
}

template <class Real, template <class> class Make>
auto closure_of(const Real& alpha_x, const Real& alpha_y, Method method)
{
    return compensated(Make<Real>::lobe(alpha_x, alpha_y), method, luts::ggx_tables());
}

template <class Real>
struct Gold
{
    static Conductor<Real> lobe(const Real& alpha_x, const Real& alpha_y)
    {
        return {GGX<Real>(alpha_x, alpha_y),
                ConductorFresnel<Real>(Color3<Real>(Real(0.16f), Real(0.42f), Real(1.5f)),
                                       Color3<Real>(Real(3.46f), Real(2.35f), Real(1.88f)))};
    }
};
template <class Real>
struct ArtistsGold
{
    static GeneralizedSchlick<Real> lobe(const Real& alpha_x, const Real& alpha_y)
    {
        return {GGX<Real>(alpha_x, alpha_y),
                SchlickFresnel<Real>(Color3<Real>(Real(0.94f), Real(0.77f), Real(0.37f)),
                                     Color3<Real>(Real(0.98f), Real(0.95f), Real(0.75f)))};
    }
};

void expect_near(double a, double b, double relative, const char* what)
{
    EXPECT_NEAR(a, b, relative * (1e-3 + std::abs(b))) << what;
}

template <template <class> class Make>
void compare_batch_with_scalar(Method method)
{
    const auto all = cases();
    for (std::size_t first = 0; first + lanes <= all.size(); first += lanes)
    {
        Lanes ax, ay, wo[3], wi[3], u[2];
        for (std::size_t l = 0; l < lanes; ++l)
        {
            const Case& c = all[first + l];
            ax.value[l] = float(c.alpha_x);
            ay.value[l] = float(c.alpha_y);
            for (int k = 0; k < 3; ++k)
            {
                wo[k].value[l] = c.wo[k];
                wi[k].value[l] = c.wi[k];
            }
            u[0].value[l] = c.u.x;
            u[1].value[l] = c.u.y;
        }
        const auto closure = closure_of<Batch, Make>(ax.load(), ay.load(), method);
        const auto prepared = closure.prepare({wo[0].load(), wo[1].load(), wo[2].load()});
        const Vec3<Batch> in(wi[0].load(), wi[1].load(), wi[2].load());
        const auto f = prepared.eval(in), albedo = prepared.albedo().reflect;
        const Lanes f_x(f.x), f_z(f.z), pdf(prepared.pdf(in)), albedo_y(albedo.y);
        const auto s = prepared.sample({u[0].load(), u[1].load()});
        const Lanes s_x(s.wi.x), s_z(s.wi.z), s_w(s.weight.y), s_pdf(s.pdf);
        const Lanes valid(xsimd::select(s.valid, Batch(1.0f), Batch(0.0f)));
        const Lanes delta(xsimd::select(s.delta, Batch(1.0f), Batch(0.0f)));

        for (std::size_t l = 0; l < lanes; ++l)
        {
            const Case& c = all[first + l];
            const auto scalar =
                closure_of<float, Make>(float(c.alpha_x), float(c.alpha_y), method).prepare(c.wo);
            const auto t = scalar.sample(c.u);
            expect_near(f_x.value[l], scalar.eval(c.wi).x, 1e-5, "eval");
            expect_near(f_z.value[l], scalar.eval(c.wi).z, 1e-5, "eval");
            expect_near(pdf.value[l], scalar.pdf(c.wi), 1e-5, "pdf");
            expect_near(albedo_y.value[l], scalar.albedo().reflect.y, 1e-5, "albedo");
            EXPECT_EQ(valid.value[l] != 0, t.valid);
            EXPECT_EQ(delta.value[l] != 0, t.delta);
            EXPECT_NEAR(s_x.value[l], t.wi.x, 2e-5);
            EXPECT_NEAR(s_z.value[l], t.wi.z, 2e-5);
            expect_near(s_w.value[l], t.weight.y, 1e-4, "weight");
            // The density of a narrow lobe multiplies the rounding of the direction.
            if (c.alpha_y > 0.03) expect_near(s_pdf.value[l], t.pdf, 2e-3, "sample pdf");
        }
    }
}

TEST(NumberTypes, a_vector_of_floats_answers_as_a_float_does)
{
    for (Method method : all_methods)
    {
        compare_batch_with_scalar<Gold>(method);
        compare_batch_with_scalar<ArtistsGold>(method);
    }
}

// Lanes that are not asked for hold whatever a formula makes of its ends. Scalars raise no
// exception there, and a host that traps them meets none of vectors either.
TEST(NumberTypes, functions_of_vectors_raise_no_exception_at_their_ends)
{
    const float huge = std::numeric_limits<float>::max(), nan = std::nanf("");
    const Batch zero(0.0f), one(1.0f), large(huge), none(nan);
    const tests::Trapped trapped;
    EXPECT_EQ(detail::exp(-large).get(0), 0);
    EXPECT_EQ(detail::exp(one).get(0), xsimd::exp(one).get(0));
    EXPECT_LT(detail::erfc(large).get(0), 1e-30f);
    EXPECT_EQ(detail::erfc(one).get(0), xsimd::erfc(one).get(0));
    EXPECT_EQ(detail::pow(zero, one).get(0), 0);
    EXPECT_EQ(detail::pow(zero, zero).get(0), 1);
    EXPECT_NEAR(detail::pow(Batch(0.3f), Batch(2.5f)).get(0), std::pow(0.3f, 2.5f), 1e-7f);
    EXPECT_LT(detail::ierfc(large).get(0), 1e-30f);
    for (const auto& [a, b] : {std::pair(none, one), std::pair(one, none), std::pair(one, zero)})
        EXPECT_FALSE(detail::any<Batch>(detail::quiet_less(a, b)));
    EXPECT_TRUE(detail::all<Batch>(detail::quiet_less(zero, one)));
}

// Median and 99.9th percentile of the relative difference of eval, and the worst albedo.
TEST(NumberTypes, float_is_close_to_double)
{
    std::vector<double> differences;
    double worst_albedo = 0;
    for (const Case& c : cases())
    {
        const auto single =
            closure_of<float, Gold>(float(c.alpha_x), float(c.alpha_y), Method::turquin);
        const auto precise = closure_of<double, Gold>(double(float(c.alpha_x)),
                                                      double(float(c.alpha_y)), Method::turquin);
        const Vec3<double> wo(c.wo), wi(c.wi);
        const double a = single.eval(c.wo, c.wi).y, b = precise.eval(wo, wi).y;
        if (b > 0 && c.alpha_x > 1e-3 && c.alpha_y > 1e-3)
            differences.push_back(std::abs(a / b - 1));
        worst_albedo = std::max(
            worst_albedo, std::abs(single.albedo(c.wo).reflect.y - precise.albedo(wo).reflect.y));
    }
    std::sort(differences.begin(), differences.end());
    EXPECT_LT(differences[differences.size() / 2], 1e-6);
    EXPECT_LT(differences[differences.size() * 999 / 1000], 1e-3);
    EXPECT_LT(worst_albedo, 1e-4);
}

}  // namespace
