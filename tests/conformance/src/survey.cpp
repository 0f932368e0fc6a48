// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "survey.h"

#include "random.h"
#include "rounding.h"
#include "settings.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

// Evenly spread samples come in groups, each from a random start, whose means are independent.
constexpr std::size_t groups = 32;

// Bins hold this share of the lobe each.
constexpr double bin_share = 1.0 / 128;
// An integral with a larger error says nothing; one with less, within it.
constexpr double most_unresolved = 5e-4;
constexpr std::size_t scouts = 1 << 14;

void add(std::array<RunningMean, 3>& means, const Color& c)
{
    for (int k = 0; k < 3; ++k) means[static_cast<std::size_t>(k)].add(c[k]);
}

bool same_side(const Direction& a, const Direction& b) { return (a.z < 0) == (b.z < 0); }

// Where the lobe is: what the bins are made for.
std::vector<Direction> scout(const TestedClosure& closure, Random& random)
{
    std::vector<Direction> lobe;
    EvenPoints even(random.cube());
    for (std::size_t i = 0; i < scouts; ++i)
    {
        const Sample<double> s = closure.sample(even.next());
        if (s.valid && !s.delta) lobe.push_back(s.wi);
    }
    return lobe;
}

// Low peaks beside high ones are to be found, too.
double share_of_looks(double pdf) { return std::isfinite(pdf) && pdf > 0 ? std::sqrt(pdf) : 0; }

// Where in the plane of incidence the pdf is, which no sample tells of one that is not exact.
std::vector<Direction> looked_along_incidence(const TestedClosure& closure, const Direction& wo,
                                              SphereCells& cells)
{
    std::vector<Direction> found;
    constexpr int places = 512, looks = 128;
    const double azimuth = std::atan2(wo.y, wo.x), pi = std::acos(-1.0);
    for (int arc = 0; arc < 4; ++arc)
    {
        const double phi = azimuth + (arc & 1 ? pi : 0), side = arc & 2 ? -1 : 1;
        // Directions on either side of the plane are in different cells.
        const auto direction = [&](double x, double off) {
            return direction_at(side * (1 - x) * (1 + x), phi + off);
        };
        std::array<double, places> up_to;
        double sum = 0;
        for (int i = 0; i < places; ++i)
        {
            const double x = (i + 0.5) / places, pdf = closure.pdf(direction(x, 0));
            up_to[static_cast<std::size_t>(i)] = sum += share_of_looks(pdf) * x;
        }
        if (sum <= 0) continue;
        for (int i = 0; i < looks; ++i)
        {
            const auto place =
                std::upper_bound(up_to.begin(), up_to.end() - 1, sum * (i + 0.5) / looks);
            const double x = (static_cast<double>(place - up_to.begin()) + 0.5) / places;
            for (double off : {-1e-9, 1e-9}) cells.look_at(direction(x, off));
            found.push_back(direction(x, 0));
        }
    }
    return found;
}

// Some of all directions, more where the pdf is.
std::vector<Direction> picked_directions(const TestedClosure& closure, std::size_t n,
                                         Random& random)
{
    constexpr std::size_t places = 1 << 13;
    std::vector<Direction> directions(places);
    std::vector<double> up_to(places);
    double sum = 0;
    for (std::size_t i = 0; i < places; ++i)
    {
        directions[i] = random.direction();
        const double pdf = closure.pdf(directions[i]);
        up_to[i] = sum += share_of_looks(pdf);
    }
    std::vector<Direction> picked;
    for (std::size_t i = 0; i < n && sum > 0; ++i)
    {
        const double place = sum * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        const auto found = std::upper_bound(up_to.begin(), up_to.end() - 1, place);
        picked.push_back(directions[static_cast<std::size_t>(found - up_to.begin())]);
    }
    return picked;
}

// Along fans too narrow to be met by chance: a chain of steps of all lengths from each start, to be
// found anywhere as often as the pdf is large (Metropolis et al. 1953).
void follow_pdf(const TestedClosure& closure, const std::vector<Direction>& starts, Random& random,
                SphereCells& cells)
{
    constexpr int steps = 96, every = 4;
    for (const Direction& start : starts)
    {
        Direction w = start;
        double pdf = closure.pdf(w);
        for (int i = 0; i < steps; ++i)
        {
            const double length = std::pow(10, -5 * random.unit());
            const Direction next = (w + random.direction() * length).normalized();
            const double there = closure.pdf(next);
            if (random.unit() * pdf < there)
            {
                w = next;
                pdf = there;
            }
            if (i % every == every - 1) cells.look_at(w);
        }
    }
}

void look_for_pdf(const TestedClosure& closure, const Direction& wo,
                  const std::vector<Direction>& samples, Random& random, SphereCells& cells)
{
    constexpr std::size_t each = 128;
    std::vector<Direction> starts = picked_directions(closure, each, random);
    for (const auto& found : {looked_along_incidence(closure, wo, cells), samples})
        for (std::size_t i = 0; i < each && !found.empty(); ++i)
            starts.push_back(found[i * found.size() / each]);
    follow_pdf(closure, starts, random, cells);
}

void take_even_samples(const TestedClosure& closure, std::size_t n, Random& random, Survey& out)
{
    const Color zero(0.0);
    const std::size_t each = std::max<std::size_t>(1, n / groups);
    const double share = 1.0 / static_cast<double>(each);
    Color delta_reflect(0.0), delta_transmit(0.0);
    std::array<double, 3> squares{};
    for (std::size_t g = 0; g < groups; ++g)
    {
        EvenPoints even(random.cube());
        double nothing = 0, delta = 0;
        Color reflect(0.0), transmit(0.0);
        for (std::size_t i = 0; i < each; ++i)
        {
            const Direction u = even.next();
            const Sample<double> s = closure.sample(u);
            if (!s.valid)
            {
                nothing += share;
                continue;
            }
            (s.transmitted ? transmit : reflect) += s.weight * share;
            if (s.delta)
            {
                delta += share;
                (s.transmitted ? delta_transmit : delta_reflect) += s.weight * share;
            }
            for (int k = 0; k < 3; ++k)
            {
                const auto channel = static_cast<std::size_t>(k);
                squares[channel] += s.weight[k] * s.weight[k] * share;
                Drawn& heaviest = out.heaviest[channel];
                if (s.weight[k] > heaviest.sample.weight[k] || std::isnan(s.weight[k]))
                    heaviest = {u, s};
            }
        }
        out.nothing.add(nothing);
        out.delta.add(delta);
        add(out.weight.reflect, reflect);
        add(out.weight.transmit, transmit);
        add(out.weight.both, reflect + transmit);
    }
    out.delta_reflect = delta_reflect * (1.0 / groups);
    out.delta_transmit = delta_transmit * (1.0 / groups);
    for (std::size_t k = 0; k < 3; ++k) out.weight_squares[k] = squares[k] / groups;
}

void scale(std::array<RunningMean, 3>& means, const Color& factor)
{
    for (int k = 0; k < 3; ++k) means[static_cast<std::size_t>(k)].scale_by(factor[k]);
}

}  // namespace

void MeanColor::scale_by(const Color& factor)
{
    for (auto* means : {&reflect, &transmit, &both}) scale(*means, factor);
}

void Survey::scale_by(const Color& gain)
{
    for (Color* c : {&reflect, &transmit, &delta_reflect, &delta_transmit}) *c *= gain;
    weight.scale_by(gain);
    for (Drawn& d : heaviest) d.sample.weight *= gain;
    for (int k = 0; k < 3; ++k) weight_squares[static_cast<std::size_t>(k)] *= gain[k] * gain[k];
    error *= std::max({1.0, gain.x, gain.y, gain.z});
    resolved = resolved && error <= most_unresolved;
}

Effort Effort::times(std::size_t factor) const
{
    Effort e = *this;
    e.samples *= factor;
    e.even_samples *= factor;
    e.estimates *= factor;
    e.evaluations *= 4;
    e.tolerance /= static_cast<double>(factor);
    return e;
}

Survey survey(TestedClosure& closure, const Direction& wo, bool in_double, const Effort& effort,
              std::uint64_t seed)
{
    Random random(seed);
    Survey out;
    out.wo = wo;
    out.traits = closure.traits();
    closure.prepare(wo);

    const std::vector<Direction> lobe = scout(closure, random);
    // An estimate is asked where samples go, on either side, however few on one.
    const auto made = std::make_shared<SphereCells>(
        wo, lobe, bin_share,
        out.traits.stochastic_eval ? SphereCells::Of::each_side : SphereCells::Of::all);
    SphereCells& cells = *made;
    if (!out.traits.exact_pdf) look_for_pdf(closure, wo, lobe, random, cells);
    const bool exact = !out.traits.stochastic_eval;
    out.error = cells.integrate(
        [&](const Direction& wi) {
            const double pdf = closure.pdf(wi);
            // Facets that stand upright have directions that float does not tell apart.
            const double unsure =
                in_double ? 0 : std::abs(closure.pdf(turned_by_rounding(wi, false, 1)) - pdf);
            return Density{pdf, exact ? closure.eval(wi, Direction(0.5)) : Color(0.0), unsure};
        },
        effort.tolerance, effort.evaluations);
    out.resolved = out.error <= most_unresolved;
    for (const Bin& b : cells.bins())
    {
        out.pdf += b.integral.pdf;
        out.rounding += b.integral.unsure;
        ((b.corner.chart < 4) == (wo.z >= 0) ? out.reflect : out.transmit) += b.integral.value;
    }
    take_even_samples(closure, effort.even_samples, random, out);
    out.cells = made;
    return out;
}

// A bin by its shares of the area, of the pdf, and of the samples on either side, which an inexact
// pdf need not know of; a place in it evenly, the estimate by numbers of its own.
MeanColor estimated_integrals(const TestedClosure& closure, const Survey& survey, std::size_t n,
                              std::uint64_t seed)
{
    const std::vector<Bin>& bins = survey.cells->bins();
    Random random(seed);
    MeanColor mean;
    const double pi = std::acos(-1.0);
    const auto side = [](const Bin& b) { return static_cast<std::size_t>(b.corner.chart < 4); };
    std::vector<double> up_to(bins.size());
    double sum = 0, pdf = 0, area = 0;
    std::array<double, 2> drawn{};
    for (const Bin& b : bins)
    {
        area += b.size * b.size;
        pdf += b.integral.pdf;
        drawn[side(b)] += static_cast<double>(b.drawn);
    }
    const auto chance = [&](const Bin& b) {
        double p = 0.2 * b.size * b.size / area;
        if (pdf > 0) p += 0.4 * b.integral.pdf / pdf;
        if (drawn[side(b)] > 0) p += 0.2 * static_cast<double>(b.drawn) / drawn[side(b)];
        return p;
    };
    for (std::size_t b = 0; b < bins.size(); ++b) up_to[b] = sum += chance(bins[b]);

    const std::size_t each = std::max<std::size_t>(1, n / groups);
    for (std::size_t g = 0; g < groups; ++g)
    {
        EvenPoints even(random.cube());
        Color reflect(0.0), transmit(0.0);
        for (std::size_t i = 0; i < each; ++i)
        {
            const Direction v = even.next();
            const auto place = std::upper_bound(up_to.begin(), up_to.end(), v.z * sum);
            const Bin& b =
                bins[std::min(bins.size() - 1, static_cast<std::size_t>(place - up_to.begin()))];
            const ChartPoint p{b.corner.chart, b.corner.x + b.size * v.x,
                               b.corner.y + b.size * v.y};
            const Direction wi = survey.cells->charts().direction_of(p);
            const double weight = pi * p.x * b.size * b.size * sum / chance(b);
            const Color value =
                closure.eval(wi, random.cube()) * (weight / static_cast<double>(each));
            (same_side(wi, survey.wo) ? reflect : transmit) += value;
        }
        add(mean.reflect, reflect + survey.delta_reflect);
        add(mean.transmit, transmit + survey.delta_transmit);
        add(mean.both, reflect + transmit + survey.delta_reflect + survey.delta_transmit);
    }
    return mean;
}

std::vector<double> histogram(const TestedClosure& closure, const SphereCells& cells, std::size_t n,
                              std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> found(cells.bins().size(), 0);
    for (std::size_t i = 0; i < n; ++i)
    {
        const Sample<double> s = closure.sample(random.cube());
        if (s.valid && !s.delta) ++found[cells.bin_of(s.wi)];
    }
    return found;
}

}  // namespace conformance
REGAIN_NAMESPACE_END
