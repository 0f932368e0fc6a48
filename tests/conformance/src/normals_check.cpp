// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// C1: a distribution of microfacet normals, alone.

#include "check.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

std::string needs_normals(const Subject& subject, const Traits&)
{
    return subject.normals({}) ? "" : "its microfacets are not known";
}

// Cells about the visible normals of w, so that integrals find a narrow distribution.
SphereCells cells_about(const TestedNormals& normals, const Direction& w, Random& random)
{
    std::vector<Direction> lobe;
    for (int i = 0; i < 4096; ++i) lobe.push_back(normals.sample_visible(w, random.cube()));
    return SphereCells(w, lobe, 1.0 / 128);
}

std::optional<Outcome> normals_are_consistent(Bench& bench)
{
    const Parameters& p = bench.parameters();
    if (!p.in_double) return std::nullopt;
    const auto normals = bench.subject().normals(p);
    if (std::min(p.alpha_x, p.alpha_y) < 1e-3) return std::nullopt;
    Random random = bench.random("C1");
    Outcome o;
    o.bound = 1;
    // Each measure over its own bound.
    const auto note = [&](double off, double bound, const std::string& detail, double chance = 0) {
        if (!(off <= bound)) o.probability = std::min(o.probability, chance);
        if (!(off / bound > o.measured)) return;
        o.measured = off / bound;
        o.detail = detail;
    };
    const Effort effort = bench.effort();

    const Direction up(0, 0, 1);
    SphereCells all = cells_about(*normals, up, random);
    const double error = all.integrate(
        [&](const Direction& m) {
            return Density{m.z > 0 ? m.z * normals->D(m) : 0, Color(0.0)};
        },
        1e-6, effort.evaluations);
    double projected = 0;
    for (const Bin& b : all.bins()) projected += b.integral.pdf;
    note(std::abs(projected - 1), 1e-5 + error,
         "the projected area of all normals is " + shown(projected) + ", not 1, error " +
             shown(error));

    for (const Direction& w : {bench.setting().wo, direction_at(0.9, 0.4), direction_at(0.1, 1.2),
                               direction_at(-0.3, 2)})
    {
        SphereCells visible = cells_about(*normals, w, random);
        const double said = normals->projected_area(w);
        // From below, few are visible.
        const double area_error = visible.integrate(
            [&](const Direction& m) {
                return Density{m.z > 0 ? std::max(0.0, w.dot(m)) * normals->D(m) : 0, Color(0.0)};
            },
            1e-6 * std::min(1.0, said), effort.evaluations);
        double area = 0;
        for (const Bin& b : visible.bins()) area += b.integral.pdf;
        note(std::abs(area - said), 1e-5 * std::max(1.0, said) + area_error,
             "along " + shown(w) + " the visible area is " + shown(area) + ", said to be " +
                 shown(said));

        if (said < 1e-9) continue;  // there is nothing to be seen

        // The visible normals that are sampled are those.
        std::vector<double> found(visible.bins().size(), 0);
        for (std::size_t i = 0; i < effort.samples; ++i)
        {
            const Direction m = normals->sample_visible(w, random.cube());
            if (!(std::abs(m.length() - 1) < 1e-9) || m.z < 0 || w.dot(m) < -1e-12)
                note(1, 1e-9, "along " + shown(w) + " the normal " + shown(m) + " is sampled");
            ++found[visible.bin_of(m)];
        }
        double chi2 = 0, few = 0, few_found = 0;
        std::size_t cells = 0;
        for (std::size_t b = 0; b < found.size(); ++b)
        {
            const double expected =
                visible.bins()[b].integral.pdf / area * static_cast<double>(effort.samples);
            if (expected < 8)
                few += expected, few_found += found[b];
            else
                chi2 += (found[b] - expected) * (found[b] - expected) / expected, ++cells;
        }
        if (few >= 8) chi2 += (few_found - few) * (few_found - few) / few, ++cells;
        if (cells > 1)
        {
            const double chance = chi_squared_tail(chi2, static_cast<double>(cells - 1));
            o.probability = std::min(o.probability, 4 * chance);
            if (chance < 1e-3)
                o.detail = "along " + shown(w) + " chi squared of sampled normals is " +
                           shown(chi2) + " over " + std::to_string(cells) + " bins";
        }
    }

    for (int i = 0; i < 1000; ++i)
    {
        const Direction a = direction_at(1e-3 + 0.999 * random.unit(), 7 * random.unit());
        const Direction b = direction_at(1e-3 + 0.999 * random.unit(), 7 * random.unit());
        const double both = normals->G2(a, b), one = normals->G1(a), other = normals->G1(b);
        const bool ordered =
            both <= std::min(one, other) * (1 + 1e-9) && both >= one * other * (1 - 1e-9);
        if (!ordered)
            note(1, 1e-9,
                 "G2 of " + shown(a) + " and " + shown(b) + " is " + shown(both) + ", G1 " +
                     shown(one) + " and " + shown(other));
    }
    return o;
}

}  // namespace

std::vector<Check> normals_checks()
{
    return {{"C1", "normals, their visible area, their samples and G agree", Scope::parameters,
             true, needs_normals, normals_are_consistent}};
}

}  // namespace conformance
REGAIN_NAMESPACE_END
