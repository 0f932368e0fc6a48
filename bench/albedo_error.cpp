// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How far each method's directional albedo is from the random walk's: the table of docs/methods.md.
//
//   albedo_error [walks] [fits]
//
// With `fits` the methods take the formulas of analytic_tables.h in place of tables.
//
// Single scattering is integrated by quadrature, so that what is seen is the error of the method
// and its tables alone; the walk is sampled, by 16 independent sets whose means tell the standard
// error. 2^22 walks, the default, bring that below 1e-4 in a quarter of an hour on two cores.

#include <regain/closures/analytic_tables.h>
#include <regain/closures/balanced_gain.h>
#include <regain/closures/beckmann.h>
#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/ggx.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/walk.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/library.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace regain;
using Triple = Color3<double>;

constexpr double alphas[] = {0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 1};
constexpr double cosines[] = {0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1};
constexpr std::size_t cells = std::size(alphas) * std::size(cosines);

// F0 of the eight dielectrics and paints.
const SchlickFresnel<double> schlick[] = {SchlickFresnel<double>(Triple(0.02, 0.04, 0.1)),
                                          SchlickFresnel<double>(Triple(0.2, 0.35, 0.5)),
                                          SchlickFresnel<double>(Triple(0.8, 0.95, 0.95))};

// n and k at 650, 550 and 450 nm, from the refractiveindex.info database: gold, copper, silver of
// Johnson and Christy 1972, aluminium of Rakic 1995, nickel of Johnson and Christy 1974.
const ConductorFresnel<double> metals[] = {
    {Triple(0.156, 0.424, 1.383), Triple(3.602, 2.472, 1.916)},
    {Triple(0.238, 1.007, 1.240), Triple(3.626, 2.582, 2.393)},
    {Triple(1.558, 1.015, 0.633), Triple(7.712, 6.627, 5.454)},
    {Triple(0.052, 0.060, 0.040), Triple(4.409, 3.597, 2.648)},
    {Triple(1.990, 1.921, 1.729), Triple(4.209, 3.616, 2.944)}};

std::vector<std::string> method_names()
{
    std::vector<std::string> names;
    for (const Method method : all_methods) names.emplace_back(name(method));
    names.emplace_back("directional");
    names.emplace_back("balanced");
    for (const KullaContyForm form : all_kulla_conty_forms) names.emplace_back(name(form));
    names.emplace_back("tail");
    return names;
}

// Differences from the walk, by method; and how well it is known.
struct Errors
{
    std::vector<double> largest, squares;
    double standard_error = 0;
    int count = 0;

    Errors() : largest(method_names().size()), squares(largest.size()) {}
    void add(std::size_t method, const Triple& off)
    {
        for (int c = 0; c < 3; ++c)
        {
            largest[method] = std::max(largest[method], std::abs(off[c]));
            squares[method] += off[c] * off[c];
        }
    }
    void join(const Errors& other)
    {
        for (std::size_t m = 0; m < largest.size(); ++m)
        {
            largest[m] = std::max(largest[m], other.largest[m]);
            squares[m] += other.squares[m];
        }
        standard_error = std::max(standard_error, other.standard_error);
        count += other.count;
    }
};

// Of a gain that depends on wi, over samples of the lobe, each by its weight.
template <class Closure>
Triple mean_gain(const Closure& closure, const Vec3<double>& wo)
{
    const auto lobe = closure.lobe().prepare(wo);
    Triple with(0.0), without(0.0);
    for (int i = 0; i < 1 << 16; ++i)
    {
        const Sample<double> s =
            lobe.sample(regain::detail::shifted_numbers(Vec3<double>(0.21, 0.37, 0.71), i));
        with += s.weight * closure.gain().pair(wo, s.wi);
        without += s.weight;
    }
    return with / without;
}

template <class Distribution, class Fresnel>
void measure(const Distribution& distribution, const luts::SlopeLaw& law, const Fresnel& fresnel,
             const MicrofacetTables& tables, double mu, int walks, Errors& errors)
{
    const Vec3<double> wo(std::sqrt((1 - mu) * (1 + mu)), 0, mu);
    const auto walk = Walk<Distribution, Fresnel>(distribution, fresnel).prepare(wo);
    constexpr int sets = 16;
    Triple truth(0.0), squares(0.0);
    for (int set = 0; set < sets; ++set)
    {
        // Places in the unit cube that have nothing to do with each other.
        const Vec3<double> start = RandomStream<double>({(set + 0.5) / sets, 0.37, 0.71}).next3();
        Triple mean(0.0);
        for (int i = 0; i < walks / sets; ++i)
            mean += walk.path(regain::detail::shifted_numbers(start, i)).weight;
        mean *= double(sets) / walks;
        truth += mean / sets;
        squares += mean * mean / sets;
    }
    for (int c = 0; c < 3; ++c)
        errors.standard_error =
            std::max(errors.standard_error,
                     std::sqrt(std::max(squares[c] - truth[c] * truth[c], 0.0) / (sets - 1)));

    Triple single;
    for (int c = 0; c < 3; ++c)
        single[c] = luts::albedo(law, mu, [&](double cosine) { return fresnel.at(cosine)[c]; });
    const MicrofacetReflection<Distribution, Fresnel> lobe(distribution, fresnel, tables);
    std::size_t m = 0;
    for (const Method method : all_methods)
        errors.add(m++, single * MethodGain<double>(lobe, method, tables, 1).at(wo) - truth);
    errors.add(m++, single * DirectionalGain(distribution, fresnel, tables, 1.0).at(wo) - truth);
    errors.add(m++, single * mean_gain(balanced(lobe, tables), wo) - truth);
    for (const KullaContyForm form : all_kulla_conty_forms)
    {
        const auto closure = kulla_conty(lobe, form, tables);
        errors.add(m++, single + closure.added_lobe().prepare(wo).albedo().reflect - truth);
    }
    const auto tail = fitted_tail(lobe, tables);
    errors.add(m++, single + tail.added_lobe().prepare(wo).albedo().reflect - truth);
    errors.count += 3;
}

template <class Distribution, class Terms>
Errors measured(const std::string& name, const Terms& terms, int walks, bool fits)
{
    MicrofacetTables tables = luts::microfacet_tables(name);
    luts::add_later_bounces(tables, name);
    luts::add_later_shape(tables, name);
    if (fits) tables = analytic_tables<Distribution>();
    luts::add_balance(tables, name);
    std::vector<Errors> errors(cells);
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i; (i = next++) < cells;)
        {
            const double alpha = alphas[i / std::size(cosines)];
            const luts::SlopeLaw law = luts::SlopeLaw::named(name, alpha, 0);
            for (const auto& fresnel : terms)
                measure(Distribution(alpha), law, fresnel, tables, cosines[i % std::size(cosines)],
                        walks, errors[i]);
            std::fprintf(stderr, "%s: %zu of %zu\n", name.c_str(), i + 1, cells);
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
        threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    Errors all;
    for (const Errors& e : errors) all.join(e);
    return all;
}

}  // namespace

int main(int argc, char** argv)
{
    const int walks = argc > 1 ? std::atoi(argv[1]) : 1 << 22;
    if (walks < 16)
    {
        std::fprintf(stderr, "walks is '%s'; accepted: 16 to %d\n", argv[1], 1 << 30);
        return 2;
    }
    const bool fits = argc > 2 && argv[2] == std::string("fits");
    const Errors columns[] = {measured<GGX<double>>("ggx", schlick, walks, fits),
                              measured<GGX<double>>("ggx", metals, walks, fits),
                              measured<Beckmann<double>>("beckmann", schlick, walks, fits),
                              measured<Beckmann<double>>("beckmann", metals, walks, fits)};
    std::printf(
        "| method | GGX, Schlick | GGX, metals | Beckmann, Schlick | Beckmann, metals |\n"
        "|---|---|---|---|---|\n");
    const std::vector<std::string> names = method_names();
    double standard_error = 0;
    for (std::size_t m = 0; m < names.size(); ++m)
    {
        std::printf("| `%s` |", names[m].c_str());
        for (const Errors& e : columns)
            std::printf(" %.4f / %.4f |", e.largest[m], std::sqrt(e.squares[m] / e.count));
        std::printf("\n");
    }
    for (const Errors& e : columns) standard_error = std::max(standard_error, e.standard_error);
    std::printf(
        "\nLargest / root mean square difference from the walk, whose standard error is at "
        "most %.1e.\n",
        standard_error);
    return 0;
}
