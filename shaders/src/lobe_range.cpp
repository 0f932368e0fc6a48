// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "lobe_range.h"

#include "called_for.h"
#include "plan_search.h"

#include <algorithm>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {
namespace {

bool knows_albedo(const Compensation& method, const LobeRange& r, double tolerance)
{
    const auto* walk = std::get_if<RandomWalk>(&method);
    if (std::holds_alternative<Balanced>(method)) return false;
    if (!walk) return true;
    const bool has_tables = !r.facets()->is_interface() || !has_gamma(r.facets()->distribution);
    if (walk->bounded) return has_tables;
    // As a reference it may take its time, but what is below gets what the albedo leaves.
    return tolerance == 0 && !r.first().covers;
}

}  // namespace

LobeRange::LobeRange(const MethodCosts& costs, const PlacedLobe& first) : _first(first)
{
    if (const auto* m = facets())
        for (const Compensation& method : predictable_methods(costs, *m))
            _offers.push_back({method, {}});
    _sums.resize(_offers.size());
    _is_known.assign(_offers.size(), true);
}

LobePredictions LobeRange::predict(const MethodCosts& costs, const PlacedLobe& lobe) const
{
    LobePredictions all;
    if (lobe.weight == ColorD(0.0) || is_black(lobe.material)) return all;
    if (const auto* m = std::get_if<MicrofacetMaterial>(&lobe.material))
        for (std::size_t i = 0; i < _offers.size(); ++i)
            all.push_back(_is_known[i] ? predicted(costs, *m, _offers[i].method) : std::nullopt);
    return all;
}

void LobeRange::look_at(const PlacedLobe& lobe, const LobePredictions& predictions)
{
    if (lobe.weight == ColorD(0.0) || is_black(lobe.material)) return;
    ++_places;
    add(_called_for, called_for_by(lobe.material));
    for (std::size_t i = 0; i < predictions.size(); ++i)
    {
        const auto& p = predictions[i];
        if (!p)
        {
            _is_known[i] = false;
            continue;
        }
        ColorD& worst = _offers[i].offer.error;
        for (int c = 0; c < 3; ++c) worst[c] = std::max(worst[c], p->error[c] * lobe.weight[c]);
        _sums[i].eval += p->eval;
        _sums[i].sample += p->sample;
    }
}

template <class Keep>
void LobeRange::keep_if(const Keep& keep)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < _offers.size(); ++i)
    {
        if (!keep(i)) continue;
        _offers[kept] = _offers[i];
        _sums[kept] = _sums[i];
        ++kept;
    }
    _offers.resize(kept);
    _sums.resize(kept);
    _is_known.assign(kept, true);
}

void LobeRange::finish(double tolerance)
{
    keep_if([&](std::size_t i) { return _is_known[i]; });
    if (!facets()) _without = ColorD(0.0);
    for (std::size_t i = 0; i < _offers.size(); ++i)
    {
        const double n = std::max(_places, 1);
        _sums[i].eval /= n;
        _sums[i].sample /= n;
        _offers[i].offer.price = _sums[i].eval + _sums[i].sample;
        if (name(_offers[i].method) == "none") _without = _offers[i].offer.error;
    }
    _called_for.layering = _first.covers && is_there();
    _called_for.multiple_scattering = _without && largest(*_without) > tolerance;
}

void LobeRange::drop_unknown_albedos(double tolerance)
{
    keep_if([&](std::size_t i) { return knows_albedo(_offers[i].method, *this, tolerance); });
}

const Prediction* LobeRange::mean_of(const Compensation& method) const
{
    for (std::size_t i = 0; i < _offers.size(); ++i)
        if (name(_offers[i].method) == name(method)) return &_sums[i];
    return nullptr;
}

Choice cheapest(const std::vector<LobeRange>& ranges, double tolerance)
{
    std::vector<std::vector<Offer>> offers;
    std::vector<std::size_t> of_range;
    for (std::size_t r = 0; r < ranges.size(); ++r)
    {
        if (!ranges[r].is_there() || ranges[r].offers().empty()) continue;
        offers.emplace_back();
        for (const NamedOffer& o : ranges[r].offers()) offers.back().push_back(o.offer);
        of_range.push_back(r);
    }
    Choice choice;
    choice.offers.resize(ranges.size());
    const auto chosen = cheapest_within(offers, tolerance);
    ColorD sum(0.0);
    for (std::size_t k = 0; k < chosen.size(); ++k)
    {
        const LobeRange& r = ranges[of_range[k]];
        sum += offers[k][chosen[k]].error;
        choice.eval += r.mean(chosen[k]).eval;
        choice.sample += r.mean(chosen[k]).sample;
        choice.offers[of_range[k]] = chosen[k];
    }
    choice.error = largest(sum);
    return choice;
}

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
