// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/later_bounces.h>

#include <regain/closures/beckmann.h>
#include <regain/closures/ggx.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/closures/walk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

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

// The least of a function on [0, 1] that falls and then rises.
template <class F>
double least(const F& f)
{
    constexpr double golden = 0.61803398874989484820;
    double low = 0, high = 1;
    for (int i = 0; i < 40; ++i)
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
    result.mu = least(error);
    return result;
}

}  // namespace

LaterBounces later_bounces(const std::string& distribution, double alpha, double gamma, double mu,
                           double E_ss, int walks)
{
    const auto of = [&](const auto& d) {
        return fitted(walk(d, mu, walks), alpha, mu, E_ss, walks);
    };
    if (distribution == "ggx") return of(GGX<double>(alpha));
    if (distribution == "beckmann") return of(Beckmann<double>(alpha));
    if (distribution == "gtr") return of(GTR<double>(alpha, gamma));
    if (distribution == "std") return of(STD<double>(alpha, gamma));
    throw std::invalid_argument("no distribution is called '" + distribution +
                                "'; there are ggx, beckmann, gtr, std");
}

}  // namespace luts
REGAIN_NAMESPACE_END
