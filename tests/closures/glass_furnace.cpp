// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The white furnace of glass: a rough interface that absorbs nothing, compensated by the tables
// that are shipped, reflects and transmits all energy, seen from either side, for any index.

#include "../support/dielectric_bake.h"
#include "../support/glass.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/luts/dielectric_integral.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

using namespace regain;
using namespace regain::tests;

namespace {

constexpr auto correlated = TransmissionShadowing::correlated, beta = TransmissionShadowing::beta;
constexpr double bound = 5e-3;

constexpr double indices[] = {1.0001, 1.001, 1.05, 1.33, 1.5, 2.4, 4};
constexpr double widths[] = {1e-3, 0.05, 0.1, 0.25, 0.5, 0.75, 1};
constexpr double facings[] = {0.02, 0.05, 0.1, 0.3, 0.6, 1};

template <class Distribution>
auto furnace(double alpha, double eta, TransmissionShadowing shadowing,
             const DielectricTables& tables)
{
    using Real = typename Distribution::Real;
    const Color3<Real> white(Real(1));
    const Dielectric<Distribution> lobe(Distribution(Real(alpha)), Real(eta), ScatterMode::RT,
                                        white, white, shadowing);
    return compensated(lobe, Method::turquin, tables);
}

// R + T as the integral of eval. Directions are rounded to Real on their way in.
template <class Distribution>
double integrated(const Vec3<double>& wo, double alpha, double eta, TransmissionShadowing shadowing,
                  const DielectricTables& tables)
{
    using Real = typename Distribution::Real;
    const auto prepared =
        furnace<Distribution>(alpha, eta, shadowing, tables).prepare(Vec3<Real>(wo));
    const auto sums = integrals(prepared, wo, eta, alpha, alpha, 2e-4);
    return sums.reflected.y + sums.transmitted.y;
}

// Of an index next to 1 float does not know the half-vector, in which wo and eta wi all but cancel.
bool needs_double(double eta) { return std::abs(eta - 1) < 0.01; }

template <template <class> class Distribution>
double returned(const Vec3<double>& wo, double alpha, double eta, TransmissionShadowing shadowing,
                const DielectricTables& tables)
{
    return needs_double(eta) ? integrated<Distribution<double>>(wo, alpha, eta, shadowing, tables)
                             : integrated<Distribution<float>>(wo, alpha, eta, shadowing, tables);
}

struct Place
{
    double alpha, eta, mu;  // mu < 0: from below

    // E^S in the beta form.
    double beta_albedo(const luts::SlopeLaw& law) const
    {
        const auto E = luts::dielectric_albedo(law, std::abs(mu), mu < 0 ? 1 / eta : eta, 16);
        return E.reflected + E.transmitted_beta;
    }
};

std::ostream& operator<<(std::ostream& out, const Place& p)
{
    return out << "alpha " << p.alpha << ", eta " << p.eta << ", mu " << p.mu;
}

// Every index and its inverse, from the side of wo that `side` says.
template <class F>
void for_grid(double side, const F& f)
{
    for (double index : indices)
        for (double alpha : widths)
            for (double mu : facings)
                for (double eta : {index, 1 / index}) f(Place{alpha, eta, side * mu});
}

void expect_eval_integrates_to_one(double side)
{
    const auto tables = luts::dielectric_tables("ggx", correlated);
    for_grid(side, [&](const Place& p) {
        EXPECT_NEAR(returned<GGX>(sided(p.mu, 0.4), p.alpha, p.eta, correlated, tables), 1, bound)
            << p;
    });
}

TEST(GlassFurnace, eval_integrates_to_one_from_above) { expect_eval_integrates_to_one(1); }
TEST(GlassFurnace, eval_integrates_to_one_from_below) { expect_eval_integrates_to_one(-1); }

// R + T as the mean weight of samples.
template <class Real>
double sampled(const Place& p, const DielectricTables& tables)
{
    const auto closure = furnace<GGX<Real>>(p.alpha, p.eta, correlated, tables);
    const SampleSums sums = sum_samples(closure.prepare(Vec3<Real>(sided(p.mu, 0.4))), 12000);
    return sums.reflected + sums.transmitted;
}

TEST(GlassFurnace, weights_of_samples_are_one_on_average)
{
    const auto tables = luts::dielectric_tables("ggx", correlated);
    for_grid(1, [&](const Place& p) {
        const double sum =
            needs_double(p.eta) ? sampled<double>(p, tables) : sampled<float>(p, tables);
        EXPECT_NEAR(sum, 1, bound) << p;
    });
}

// The beta form falls to nothing at grazing angles, and where it does nobody gives it back.
template <template <class> class Distribution>
void expect_beta_form_returns_all(const std::string& name)
{
    const auto tables = luts::dielectric_tables(name, beta);
    int counted = 0;
    for_grid(1, [&](const Place& p) {
        const double E = p.beta_albedo(luts::SlopeLaw::named(name, p.alpha, 0));
        if (E < 0.1) return;
        ++counted;
        EXPECT_NEAR(returned<Distribution>(sided(p.mu, 0.4), p.alpha, p.eta, beta, tables), 1,
                    bound)
            << p << ", E^S " << E;
    });
    EXPECT_GT(counted, 500);
}

TEST(GlassFurnace, beta_form_returns_all_energy_where_it_has_some)
{
    expect_beta_form_returns_all<GGX>("ggx");
}

TEST(GlassFurnace, beta_form_of_beckmann_returns_all_energy_where_it_has_some)
{
    expect_beta_form_returns_all<Beckmann>("beckmann");
}

TEST(GlassFurnace, beckmann_returns_all_energy)
{
    const auto tables = luts::dielectric_tables("beckmann", correlated);
    for_grid(1, [&](const Place& p) {
        const double sum = returned<Beckmann>(sided(p.mu, 0.4), p.alpha, p.eta, correlated, tables);
        EXPECT_NEAR(sum, 1, bound) << p;
    });
}

// Tables of one gamma are baked on demand; these are of one interface. Half of what a heavy tail
// shows may be facets that all but stand upright, which samples find and no quadrature over
// directions does; so weights are averaged, within four standard errors of what lies about 1.
template <class Distribution>
void expect_tail_returns_all(const Distribution& distribution, const luts::SlopeLaw& law)
{
    constexpr int n = 1 << 14;
    for (double index : {1.05, 1.5, 2.4})
    {
        const BakedDielectric baked(law, index, false, true);
        const Color3<double> white(1);
        const Dielectric<Distribution> lobe(distribution, index, ScatterMode::RT, white, white);
        const auto closure = compensated(lobe, Method::turquin, baked.tables());
        for (double mu : {0.02, 0.1, 0.3, 0.6, 1.0, -0.02, -0.1, -0.3, -0.6, -1.0})
        {
            const auto prepared = closure.prepare(sided(mu, 0.4));
            double sum = 0, squares = 0;
            for (int i = 0; i < n; ++i)
            {
                const double weight = prepared.sample(hammersley(i, n)).weight.x;
                sum += weight / n;
                squares += weight * weight / n;
            }
            const double error = std::sqrt(std::max(0.0, squares - sum * sum) / n);
            EXPECT_NEAR(sum, 1, 1e-3 + 4 * error)
                << "alpha " << law.alpha() << ", eta " << index << ", mu " << mu;
        }
    }
}

TEST(GlassFurnace, tails_return_all_energy)
{
    for (double alpha : {0.1, 0.5, 1.0})
    {
        for (double gamma : {1.51, 1.6, 3.0})
            expect_tail_returns_all(STD<double>(alpha, gamma), luts::SlopeLaw::std(alpha, gamma));
        for (double gamma : {0.5, 1.3, 3.0})
            expect_tail_returns_all(GTR<double>(alpha, gamma), luts::SlopeLaw::gtr(alpha, gamma));
    }
}

// The same of GTR by quadrature of eval, whose samples carry no noise.
TEST(GlassFurnace, eval_of_gtr_integrates_to_one)
{
    for (double alpha : {0.1, 1.0})
        for (double gamma : {0.5, 3.0})
            for (double index : {1.05, 1.5})
            {
                const BakedDielectric baked(luts::SlopeLaw::gtr(alpha, gamma), index, false, true);
                const Color3<double> white(1);
                const GTR<double> distribution(alpha, gamma);
                const auto closure = compensated(
                    Dielectric<GTR<double>>(distribution, index, ScatterMode::RT, white, white),
                    Method::turquin, baked.tables());
                for (double mu : {0.02, 0.3, 1.0, -0.02, -0.3, -1.0})
                {
                    const auto wo = sided(mu, 0.4);
                    const auto sums = integrals(closure.prepare(wo), wo, index, alpha, alpha, 2e-4);
                    EXPECT_NEAR(sums.reflected.y + sums.transmitted.y, 1, 2e-3)
                        << "alpha " << alpha << ", gamma " << gamma << ", eta " << index << ", mu "
                        << mu;
                }
            }
}

}  // namespace
