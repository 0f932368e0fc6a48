// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What the formulas of regain/closures/analytic_albedo.h are fitted to, as lines of text on
// standard output that bench/fit_albedo.py reads:
//
//   fit_truth [walks]
//
//   albedo   DISTRIBUTION  alpha mu  E_ss falloff dip              by quadrature
//   average  DISTRIBUTION  alpha  E_avg                            by quadrature
//   later    DISTRIBUTION  alpha mu  E_ss  [albedo] x 23  [single] x 23
//   shape    DISTRIBUTION  alpha  loss spread forward tilt         from the tables
//
// The third kind has the albedo of random walks and that of what is reflected once, for Schlick's
// term with eight F0 and for five metals at three wavelengths. 2^20 walks, the default, take some
// minutes.

#include <regain/closures/beckmann.h>
#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/ggx.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/walk.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/library.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace regain;
using Triple = Color3<double>;

constexpr std::size_t curves = 23;
using Row = std::array<double, curves>;

// F0, then gold, copper, aluminium, silver, nickel: those of albedo_error.cpp.
constexpr double base[] = {0.02, 0.04, 0.1, 0.2, 0.35, 0.5, 0.8, 0.95};
const ConductorFresnel<double> metals[] = {
    {Triple(0.156, 0.424, 1.383), Triple(3.602, 2.472, 1.916)},
    {Triple(0.238, 1.007, 1.240), Triple(3.626, 2.582, 2.393)},
    {Triple(1.558, 1.015, 0.633), Triple(7.712, 6.627, 5.454)},
    {Triple(0.052, 0.060, 0.040), Triple(4.409, 3.597, 2.648)},
    {Triple(1.990, 1.921, 1.729), Triple(4.209, 3.616, 2.944)}};

Row reflectances(double mu)
{
    Row row;
    std::size_t c = 0;
    for (double F0 : base) row[c++] = F0 + (1 - F0) * FresnelMoments<double>::at(mu).falloff;
    for (const auto& metal : metals)
        for (int channel = 0; channel < 3; ++channel) row[c++] = metal.at(mu)[channel];
    return row;
}

// The products along one walk of all curves, by a white Fresnel term that is asked at each facet.
class Products
{
public:
    using Real = double;

    explicit Products(Row& row) : _row(&row) {}
    Triple at(double mu) const
    {
        const Row facet = reflectances(std::clamp(mu, 0.0, 1.0));
        for (std::size_t c = 0; c < curves; ++c) (*_row)[c] *= facet[c];
        return Triple(1.0);
    }

private:
    Row* _row;
};

template <class Distribution>
void print_later(const std::string& name, double alpha, double mu, int walks)
{
    Row product, sum{};
    const Walk<Distribution, Products> closure{Distribution(alpha), Products(product)};
    const auto prepared = closure.prepare({std::sqrt((1 - mu) * (1 + mu)), 0, mu});
    const Vec3<double> start = RandomStream<double>({0.37, 0.61, 0.13}).next3();
    for (int i = 0; i < walks; ++i)
    {
        product.fill(1);
        prepared.path(regain::detail::shifted_numbers(start, i));
        for (std::size_t c = 0; c < curves; ++c) sum[c] += product[c] / walks;
    }
    const luts::SlopeLaw law = luts::SlopeLaw::named(name, alpha, 0);
    std::printf("later %s %g %g %.9f", name.c_str(), alpha, mu, luts::albedo(law, mu));
    for (double albedo : sum) std::printf(" %.7f", albedo);
    for (std::size_t c = 0; c < curves; ++c)
        std::printf(" %.7f",
                    luts::albedo(law, mu, [c](double at) { return reflectances(at)[c]; }, {24}));
    std::printf("\n");
    std::fflush(stdout);
}

// Denser towards both ends of [0, 1].
double place(int i, int count) { return 0.5 - 0.5 * std::cos(std::acos(-1.0) * i / (count - 1)); }

template <class Distribution>
void print(const std::string& name, int walks)
{
    constexpr int widths = 36, cosines = 64;
    for (int j = 0; j < widths; ++j)
    {
        const double alpha = std::max(place(j, widths) * place(j, widths), 1e-6);
        const luts::SlopeLaw law = luts::SlopeLaw::named(name, alpha, 0);
        for (int i = 0; i < cosines; ++i)
        {
            const double t = place(i, cosines), x = std::max(t * t * (3 - 2 * t), 1e-5);
            const double mu = std::min(x * alpha / (1 - x + x * alpha), 1.0);
            const luts::AlbedoMoments m = luts::albedo_moments(law, mu);
            std::printf("albedo %s %.17g %.17g %.17g %.17g %.17g\n", name.c_str(), alpha, mu,
                        m.E_ss, m.falloff, m.dip);
        }
    }
    for (int j = 0; j <= 120; ++j)
    {
        const double alpha = std::max(j * j / 14400.0, 1e-6);
        std::printf("average %s %.17g %.17g\n", name.c_str(), alpha,
                    luts::average_albedo(luts::SlopeLaw::named(name, alpha, 0)));
    }
    MicrofacetTables tables = luts::microfacet_tables(name);
    luts::add_later_shape(tables, name);
    for (int j = 0; j < tables.spread.width; ++j)
    {
        const double y = j / (tables.spread.width - 1.0), alpha = y * y;
        const TableAxes<double> axes{Distribution(alpha)};
        std::printf("shape %s %.9g %.6f %.6f %.6f %.6f\n", name.c_str(), alpha,
                    1 - tables.average_albedo(axes), tables.spread.at(y), tables.forward.at(y),
                    tables.tilt.at(y));
    }
    for (double alpha : {0.1, 0.15, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 1.0})
        for (double mu : {0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0})
            print_later<Distribution>(name, alpha, mu, walks);
}

}  // namespace

int main(int argc, char** argv)
{
    const int walks = argc > 1 ? std::atoi(argv[1]) : 1 << 20;
    if (walks < 16)
    {
        std::fprintf(stderr, "walks is '%s'; accepted: 16 to %d\n", argv[1], 1 << 30);
        return 2;
    }
    print<GGX<double>>("ggx", walks);
    print<Beckmann<double>>("beckmann", walks);
    return 0;
}
