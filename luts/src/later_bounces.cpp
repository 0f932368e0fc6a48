// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/later_bounces.h>

#include <regain/closures/azimuth_spread.h>
#include <regain/closures/beckmann.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/closures/ggx.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/closures/walk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

constexpr std::size_t colors = 8;
constexpr std::array<double, colors> base = {0.02, 0.04, 0.1, 0.2, 0.35, 0.5, 0.8, 0.95};

double schlick(double F0, double falloff) { return F0 + (1 - F0) * falloff; }

// Schlick's terms of all F0 along one walk.
struct Products
{
    std::array<double, colors> product;
    int facets;

    void begin()
    {
        product.fill(1);
        facets = 0;
    }
    void meet(double mu)
    {
        const double falloff = FresnelMoments<double>::at(mu).falloff;
        for (std::size_t c = 0; c < colors; ++c) product[c] *= schlick(base[c], falloff);
        ++facets;
    }
};

// A white Fresnel term that is asked once for each facet, and keeps the account of the others.
class Counting
{
public:
    using Real = double;

    explicit Counting(Products& products) : _products(&products) {}

    Color3<double> at(double mu) const
    {
        _products->meet(mu);
        return Color3<double>(1.0);
    }

private:
    Products* _products;
};

// Sums over walks: albedos of those of one facet and of those of more, in each colour.
struct Sums
{
    std::array<double, colors> first{}, later{};
    double again = 0, facets = 0;  // walks of two facets or more, and their facets after the first
};

template <class Distribution>
Sums walk(const Distribution& distribution, double mu, int walks)
{
    Products products;
    const Walk<Distribution, Counting> closure(distribution, Counting(products));
    const auto prepared = closure.prepare({std::sqrt((1 - mu) * (1 + mu)), 0, mu});
    const Vec3<double> start = RandomStream<double>({0.5, 0.5, 0.25}).next3();
    Sums sums;
    for (int i = 0; i < walks; ++i)
    {
        products.begin();
        prepared.path(detail::shifted_numbers(start, i));
        const bool once = products.facets < 2;
        for (std::size_t c = 0; c < colors; ++c)
            (once ? sums.first : sums.later)[c] += products.product[c] / walks;
        if (once) continue;
        sums.again += 1;
        sums.facets += products.facets - 1;
    }
    return sums;
}

// The least of a function on [0, 1] that falls and then rises, within 0.618^steps.
template <class F>
double least(const F& f, int steps)
{
    constexpr double golden = 0.61803398874989484820;
    double low = 0, high = 1;
    for (int i = 0; i < steps; ++i)
    {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (f(a) < f(b))
            high = b;
        else
            low = a;
    }
    return 0.5 * (low + high);
}

LaterBounces fitted(const Sums& sums, double alpha, double mu, double E_ss, int walks)
{
    // Where hardly a walk goes on there is nothing to measure, and nothing that depends on it:
    // there the numbers pass to what they are about elsewhere.
    const double usual_q = 0.05, usual_mu = 0.4 * std::sqrt(alpha) * (0.6 + 0.4 * mu);
    const double usual_walks = 1e-4 * walks;
    LaterBounces result{};
    result.q = 1 - (sums.again + usual_walks) / (sums.facets + usual_walks / (1 - usual_q));

    const double lost = (1 - E_ss) / E_ss;
    const auto error = [&](double cosine) {
        const double falloff = FresnelMoments<double>::at(cosine).falloff;
        double sum = 1e-7 * (cosine - usual_mu) * (cosine - usual_mu);
        for (std::size_t c = 0; c < colors; ++c)
        {
            const double x = schlick(base[c], falloff);
            const double e =
                sums.first[c] * lost * x * (1 - result.q) / (1 - result.q * x) - sums.later[c];
            sum += e * e;
        }
        return sum;
    };
    result.mu = least(error, 40);
    return result;
}

// A walk of two facets or more.
struct Leaving
{
    double mu_o, mu_i;
    double azimuth;  // from straight ahead
};

template <class Distribution>
std::vector<Leaving> leaving(const Distribution& distribution, int walks)
{
    using White = Walk<Distribution, ConstantFresnel<double>>;
    const White closure(distribution, ConstantFresnel<double>());
    const Vec3<double> start = RandomStream<double>({0.5, 0.5, 0.25}).next3();
    std::vector<Leaving> all;
    for (int i = 0; i < walks; ++i)
    {
        // Cosine-weighted, in an order that has nothing to do with the walks' numbers.
        const double u = std::fmod(i * 0.41421356237309505, 1.0), mu = std::sqrt(u);
        const Vec3<double> wo(std::sqrt(1 - u), 0, mu);
        const auto path = closure.prepare(wo).path(detail::shifted_numbers(start, i));
        if (path.bounces > 1.5 && path.escaped)
            all.push_back({mu, path.wi.z, AzimuthSpread<double>::azimuth(wo, path.wi)});
    }
    return all;
}

double tilt_of(const std::vector<Leaving>& all)
{
    const double n = static_cast<double>(all.size());
    double mean = 0, product = 0, square = 0;
    for (const Leaving& w : all) mean += (w.mu_o + w.mu_i) / (2 * n);
    for (const Leaving& w : all)
    {
        const double a = w.mu_o - mean, b = w.mu_i - mean;
        product += a * b / n;
        square += (a * a + b * b) / (2 * n);
    }
    // Its variance is 1 / (n square^2), that of what is usual a third: so what a few walks say by
    // chance is hardly believed.
    const double believed = 3 / (square * square);
    return product / (square * square) * n / (n + believed);
}

LaterShape shape_of(const std::vector<Leaving>& all, double alpha)
{
    // Where nothing goes on ahead, or nothing goes on at all, k means nothing.
    const double usual_k = std::log(0.27 * alpha);
    LaterShape shape{std::exp(usual_k), 0, 0};
    if (all.size() < 16) return shape;
    // More would make P negative somewhere, but where the mean cosine is tiny.
    shape.c = std::clamp(tilt_of(all), -3.0, 8.0);

    using Spread = AzimuthSpread<double>;
    const std::size_t step = 1 + all.size() / 8192;
    const auto unlikeliness = [&](double log_k, double m) {
        const Spread spread(std::exp(log_k), m);
        double sum = 0;
        for (std::size_t i = 0; i < all.size(); i += step)
        {
            const auto polar = [](double mu) {
                return Spread::Polar{mu, std::sqrt((1 - mu) * (1 + mu))};
            };
            const auto about = spread.about(polar(all[i].mu_o), polar(all[i].mu_i));
            sum -= std::log(std::max(about.relative_density(all[i].azimuth), 1e-12));
        }
        return sum / static_cast<double>(all.size() / step + 1) +
               3e-4 * (log_k - usual_k) * (log_k - usual_k);
    };
    double x = 0.5, m = 0.5;  // x from 0 to 1 is log k from -9 to 2
    constexpr int steps = 24;
    const auto log_k = [](double place) { return -9 + 11 * place; };
    for (int round = 0; round < 5; ++round)
    {
        x = least([&](double place) { return unlikeliness(log_k(place), m); }, steps);
        m = least([&](double place) { return unlikeliness(log_k(x), place); }, steps);
    }
    shape.k = std::exp(log_k(x));
    shape.m = m;
    return shape;
}

template <class Distribution>
double reflected_share(const Distribution& distribution, double eta_o, double mu, int walks)
{
    const auto prepared = DielectricWalk<Distribution>(distribution, eta_o)
                              .prepare({std::sqrt((1 - mu) * (1 + mu)), 0, mu});
    const Vec3<double> start = RandomStream<double>({0.5, 0.5, 0.25}).next3();
    // What is usual counts where hardly a walk goes on; it costs the share of all light 1e-3.
    const double usual_walks = 1e-3 * walks;
    double again = usual_walks,
           reflected = usual_walks * DielectricFresnel<double>(eta_o).average_reflectance();
    for (int i = 0; i < walks; ++i)
    {
        const auto path = prepared.path(detail::shifted_numbers(start, i));
        if (path.bounces < 1.5) continue;
        again += 1;
        if (!path.transmitted) reflected += 1;
    }
    return reflected / again;
}

// visit(distribution).
template <class Visit>
auto with_distribution(const std::string& name, double alpha, double gamma, const Visit& visit)
{
    if (name == "ggx") return visit(GGX<double>(alpha));
    if (name == "beckmann") return visit(Beckmann<double>(alpha));
    if (name == "gtr") return visit(GTR<double>(alpha, gamma));
    if (name == "std") return visit(STD<double>(alpha, gamma));
    throw std::invalid_argument("no distribution is called '" + name +
                                "'; there are ggx, beckmann, gtr, std");
}

}  // namespace

LaterBounces later_bounces(const std::string& distribution, double alpha, double gamma, double mu,
                           double E_ss, int walks)
{
    return with_distribution(distribution, alpha, gamma, [&](const auto& d) {
        return fitted(walk(d, mu, walks), alpha, mu, E_ss, walks);
    });
}

double later_reflected_share(const std::string& distribution, double alpha, double gamma,
                             double eta_o, double mu, int walks)
{
    return with_distribution(distribution, alpha, gamma,
                             [&](const auto& d) { return reflected_share(d, eta_o, mu, walks); });
}

LaterShape later_shape(const std::string& distribution, double alpha, double gamma, int walks)
{
    return with_distribution(distribution, alpha, gamma,
                             [&](const auto& d) { return shape_of(leaving(d, walks), alpha); });
}

}  // namespace luts
REGAIN_NAMESPACE_END
