// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/planner.h>

#include "bound_tables.h"
#include "called_for.h"
#include "method_prediction.h"
#include "plan_search.h"
#include "plan_words.h"
#include "planned_points.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

using namespace planning;

// A closure over all places where its material is planned.
struct LobeRange
{
    PlacedLobe first;
    bool is_there = false;  // somewhere
    int places = 0;
    CalledFor called_for;
    std::vector<NamedOffer> offers;  // the worst errors and the mean price
    std::vector<Prediction> sums;    // of the times, by offer
    ColorD without{0.0};             // the worst error of single scattering
    bool knows_without = true;

    const MicrofacetMaterial* facets() const
    {
        return std::get_if<MicrofacetMaterial>(&first.material);
    }
};

void widen(ColorD& worst, const ColorD& error)
{
    for (int c = 0; c < 3; ++c) worst[c] = std::max(worst[c], error[c]);
}

class MaterialPlanner
{
public:
    MaterialPlanner(const NamedMaterial& given, const MethodCosts& costs, double tolerance)
        : _costs(costs), _tolerance(tolerance)
    {
        _plan.name = given.name;
        _plan.surface = given.surface;
    }

    MaterialPlan plan()
    {
        simplify();
        at_planned_points(_plan.surface, [&](const std::vector<PlacedLobe>& lobes) {
            if (_ranges.empty()) begin(lobes);
            for (std::size_t k = 0; k < lobes.size(); ++k) look_at(lobes[k], _ranges[k]);
        });
        for (LobeRange& r : _ranges) finish(r);
        choose();
        bind();
        return std::move(_plan);
    }

private:
    ClosureTree& tree() { return _plan.surface.tree; }

    void simplify()
    {
        for (int k = 0; k < tree().lobes(); ++k)
        {
            const ClosureTree::Node node = tree().node_of(k);
            if (const auto* m = std::get_if<MicrofacetMaterial>(&tree().material_of(node)))
                tree().set_material(node, simplified(*m));
        }
    }

    void begin(const std::vector<PlacedLobe>& lobes)
    {
        for (const PlacedLobe& l : lobes)
        {
            LobeRange r;
            r.first = l;
            if (const auto* m = r.facets())
                for (const Compensation& method : predictable_methods(_costs, *m))
                    r.offers.push_back({method, {}});
            r.sums.resize(r.offers.size());
            _ranges.push_back(std::move(r));
        }
    }

    void look_at(const PlacedLobe& lobe, LobeRange& r) const
    {
        if (lobe.weight == ColorD(0.0) || is_black(lobe.material)) return;
        r.is_there = true;
        ++r.places;
        add(r.called_for, called_for_by(lobe.material));
        const auto* m = std::get_if<MicrofacetMaterial>(&lobe.material);
        if (!m) return;
        for (std::size_t i = 0; i < r.offers.size();)
        {
            const auto p = predicted(_costs, *m, r.offers[i].method);
            if (!p)
            {
                r.offers.erase(r.offers.begin() + static_cast<std::ptrdiff_t>(i));
                r.sums.erase(r.sums.begin() + static_cast<std::ptrdiff_t>(i));
                continue;
            }
            widen(r.offers[i].offer.error, p->error * lobe.weight);
            r.sums[i].eval += p->eval;
            r.sums[i].sample += p->sample;
            ++i;
        }
    }

    // What several closures ask besides, eval and sample aside, is an albedo of each; some methods
    // know theirs by an integral alone.
    bool knows_albedo(const Compensation& method, const LobeRange& r) const
    {
        const auto* walk = std::get_if<RandomWalk>(&method);
        if (std::holds_alternative<Balanced>(method)) return false;
        if (!walk) return true;
        const bool has_tables = !r.facets()->is_interface() || !has_gamma(r.facets()->distribution);
        if (walk->bounded) return has_tables;
        // As a reference it may take its time, but what is below gets what the albedo leaves.
        return _tolerance == 0 && !r.first.covers;
    }

    void finish(LobeRange& r)
    {
        r.knows_without = !r.facets();
        for (std::size_t i = 0; i < r.offers.size(); ++i)
        {
            const double n = std::max(r.places, 1);
            r.sums[i].eval /= n;
            r.sums[i].sample /= n;
            r.offers[i].offer.price = r.sums[i].eval + r.sums[i].sample;
            if (name(r.offers[i].method) != "none") continue;
            r.without = r.offers[i].offer.error;
            r.knows_without = true;
        }
        r.called_for.layering = r.first.covers && r.is_there;
        r.called_for.multiple_scattering = r.knows_without && largest(r.without) > _tolerance;
    }

    void choose()
    {
        const auto there = std::count_if(_ranges.begin(), _ranges.end(),
                                         [](const LobeRange& r) { return r.is_there; });
        std::vector<std::vector<Offer>> offers;
        std::vector<LobeRange*> chosen_of;
        for (LobeRange& r : _ranges)
        {
            if (there > 1) drop_unknown_albedos(r);
            if (!r.is_there || r.offers.empty()) continue;
            offers.emplace_back();
            for (const NamedOffer& o : r.offers) offers.back().push_back(o.offer);
            chosen_of.push_back(&r);
        }
        const auto chosen = cheapest_within(offers, _tolerance);
        ColorD sum(0.0);
        for (std::size_t k = 0; k < chosen.size(); ++k) sum += offers[k][chosen[k]].error;
        _plan.error = largest(sum);
        _plan.is_within = _plan.error <= _tolerance;
        for (LobeRange& r : _ranges)
        {
            const auto at = std::find(chosen_of.begin(), chosen_of.end(), &r);
            if (at == chosen_of.end())
                keep(r);
            else
                take(r, chosen[static_cast<std::size_t>(at - chosen_of.begin())]);
            add(_plan.called_for, _plan.lobes.back().called_for);
        }
    }
    void drop_unknown_albedos(LobeRange& r) const
    {
        for (std::size_t i = r.offers.size(); i-- > 0;)
            if (!knows_albedo(r.offers[i].method, r))
            {
                r.offers.erase(r.offers.begin() + static_cast<std::ptrdiff_t>(i));
                r.sums.erase(r.sums.begin() + static_cast<std::ptrdiff_t>(i));
            }
    }

    PlannedLobe described(const LobeRange& r)
    {
        PlannedLobe lobe;
        lobe.node = r.first.node;
        for (int k = 0; k < tree().lobes(); ++k)
            if (tree().node_of(k) == lobe.node) lobe.name = tree().lobe_name(k);
        lobe.closure = closure_name(r.first.material);
        if (r.facets()) lobe.distribution = name(r.facets()->distribution);
        lobe.called_for = r.called_for;
        return lobe;
    }

    // What there is no choice for.
    void keep(const LobeRange& r)
    {
        PlannedLobe lobe = described(r);
        if (!r.is_there)
        {
            lobe.left_out = true;
            lobe.error = 0;
            lobe.why = "its weight is 0";
            tree().leave_out(lobe.node);
        }
        else if (!r.facets() || std::holds_alternative<SheenSurface>(r.facets()->surface))
        {
            lobe.method = "none";
            lobe.error = lobe.error_without = 0;
            lobe.why = "it has no microfacets, and nothing to compensate";
        }
        else
        {
            MicrofacetMaterial m = *std::get_if<MicrofacetMaterial>(&tree().material_of(lobe.node));
            m.method = recommended_compensation(m.surface);
            // Nobody ships tables of such an interface.
            if (m.is_interface() && has_gamma(m.distribution)) m.method = Method::none;
            tree().set_material(lobe.node, m);
            lobe.method = name(m.method);
            lobe.why = why_unknown(_costs, *r.facets());
            _plan.is_known = _plan.is_within = false;
        }
        _plan.lobes.push_back(std::move(lobe));
    }

    void take(const LobeRange& r, std::size_t i)
    {
        PlannedLobe lobe = described(r);
        const NamedOffer& chosen = r.offers[i];
        MicrofacetMaterial m = std::get<MicrofacetMaterial>(tree().material_of(lobe.node));
        m.method = chosen.method;
        auto* interface = std::get_if<InterfaceSurface>(&m.surface);
        if (interface && interface->mode == ScatterMode::RT &&
            interface->shadowing != TransmissionShadowing::beta)
        {
            interface->shadowing = TransmissionShadowing::beta;
            _plan.notes.push_back(lobe.name +
                                  ": its transmission has beta shadowing, as the walk's has; no "
                                  "other was measured");
        }
        tree().set_material(lobe.node, m);
        lobe.method = name(chosen.method);
        lobe.error = largest(chosen.offer.error);
        if (r.knows_without) lobe.error_without = largest(r.without);
        lobe.eval = r.sums[i].eval;
        lobe.sample = r.sums[i].sample;
        _plan.eval += lobe.eval;
        _plan.sample += lobe.sample;
        lobe.why = why_chosen(r.offers, i, _plan.error <= _tolerance, _tolerance);
        _plan.lobes.push_back(std::move(lobe));
    }

    void bind()
    {
        tree().bind_tables();
        for (int k = 0; k < tree().lobes(); ++k)
            if (const auto* m = std::get_if<MicrofacetMaterial>(&tree().material(k)))
                add_bound_tables(*m, _plan.tables);
    }

    const MethodCosts& _costs;
    double _tolerance;
    MaterialPlan _plan;
    std::vector<LobeRange> _ranges;
};

std::size_t sum_of(const std::vector<PlannedTable>& tables, bool compiled_in)
{
    std::size_t sum = 0;
    for (const PlannedTable& t : tables)
        if (t.compiled_in == compiled_in) sum += t.bytes;
    return sum;
}

}  // namespace

std::size_t ScenePlan::loaded_bytes() const { return sum_of(tables, false); }
std::size_t ScenePlan::compiled_in_bytes() const { return sum_of(tables, true); }

ScenePlan plan_scene(const std::vector<NamedMaterial>& materials, const PlannerSettings& settings)
{
    if (!(settings.tolerance >= 0 && settings.tolerance <= 1))
        throw std::invalid_argument("tolerance " + std::to_string(settings.tolerance) +
                                    ": takes numbers from 0 to 1");
    const MethodCosts& costs = settings.costs ? *settings.costs : MethodCosts::shipped();
    ScenePlan scene;
    if (costs.empty())
        scene.notes.push_back(
            "no measured costs are compiled in, so nothing is predicted: methods are those that "
            "are recommended");
    for (const NamedMaterial& m : materials)
    {
        scene.materials.push_back(MaterialPlanner(m, costs, settings.tolerance).plan());
        for (const PlannedTable& t : scene.materials.back().tables) add_table(t, scene.tables);
    }
    return scene;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
