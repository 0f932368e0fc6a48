// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/planner.h>

#include "bound_tables.h"
#include "called_for.h"
#include "lobe_range.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

using namespace planning;

// Of texture coordinates, along each side; and the part of the price that tiles have to save.
constexpr int tiles_across = 8;
constexpr double worth_tiles = 0.05;

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
        // Where a plan is the reference there is nothing to choose by tile.
        const bool by_tile = _tolerance > 0 && may_have_tiles(_plan.surface);
        if (by_tile) _tiles.resize(tiles_across * tiles_across);
        at_planned_points(_plan.surface, [&](const PlannedPlace& place) { look_at(place); });
        finish(_ranges);
        const auto choice = cheapest(_ranges, _tolerance);
        take(choice);
        if (by_tile && _plan.is_known) take_tiles(choice);
        bind();
        return std::move(_plan);
    }

private:
    using Ranges = std::vector<LobeRange>;
    // By lobe; nothing where there is no choice.
    using Methods = std::vector<std::optional<Compensation>>;

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

    static bool may_have_tiles(const VaryingTree& surface)
    {
        return surface.varies() && surface.program.needs_texcoord_alone() &&
               surface.values() < VaryingTree::most_values;
    }

    void look_at(const PlannedPlace& place)
    {
        if (_ranges.empty())
        {
            for (const PlacedLobe& l : place.lobes) _ranges.emplace_back(_costs, l);
            for (Ranges& tile : _tiles) tile = _ranges;
        }
        for (std::size_t k = 0; k < place.lobes.size(); ++k)
        {
            const PlacedLobe& lobe = place.lobes[k];
            const LobePredictions predictions = _ranges[k].predict(_costs, lobe);
            _ranges[k].look_at(lobe, predictions);
            if (_tiles.empty()) continue;
            for_tiles_at(place, [&](std::size_t i) { _tiles[i][k].look_at(lobe, predictions); });
        }
    }
    // What is a step beyond a tile counts as in it, since numbers vary between places.
    template <class Visit>
    static void for_tiles_at(const PlannedPlace& place, const Visit& visit)
    {
        const int n = place.across / tiles_across;
        const auto first = [&](int i) { return std::max((i - 1) / n, 0); };
        const auto last = [&](int i) { return std::min((i + 1) / n, tiles_across - 1); };
        for (int y = first(place.j); y <= last(place.j); ++y)
            for (int x = first(place.i); x <= last(place.i); ++x)
                visit(static_cast<std::size_t>(x + tiles_across * y));
    }

    void finish(Ranges& ranges) const
    {
        // What is somewhere in the material is asked for its albedo everywhere.
        const auto there = std::count_if(_ranges.begin(), _ranges.end(),
                                         [](const LobeRange& r) { return r.is_there(); });
        for (LobeRange& r : ranges)
        {
            r.finish(_tolerance);
            if (there > 1) r.drop_unknown_albedos(_tolerance);
        }
    }

    void take(const Choice& choice)
    {
        _plan.error = choice.error;
        _plan.eval = choice.eval;
        _plan.sample = choice.sample;
        _plan.is_within = _plan.error <= _tolerance;
        for (std::size_t k = 0; k < _ranges.size(); ++k)
        {
            if (choice.offers[k])
                take(_ranges[k], *choice.offers[k]);
            else
                keep(_ranges[k]);
            add(_plan.called_for, _plan.lobes.back().called_for);
        }
    }

    PlannedLobe described(const LobeRange& r)
    {
        PlannedLobe lobe;
        lobe.node = r.first().node;
        for (int k = 0; k < tree().lobes(); ++k)
            if (tree().node_of(k) == lobe.node) lobe.name = tree().lobe_name(k);
        lobe.closure = closure_name(r.first().material);
        if (r.facets()) lobe.distribution = name(r.facets()->distribution);
        lobe.called_for = r.called_for();
        return lobe;
    }

    // What there is no choice for.
    void keep(const LobeRange& r)
    {
        PlannedLobe lobe = described(r);
        if (!r.is_there())
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
        const NamedOffer& chosen = r.offers()[i];
        MicrofacetMaterial m = std::get<MicrofacetMaterial>(tree().material_of(lobe.node));
        m.method = chosen.method;
        // Of widths that vary, those that the tree has only say whether there may be two, for which
        // there are tables of their own.
        if (!r.called_for().anisotropy) m.alpha_x = m.alpha_y;
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
        if (r.without()) lobe.error_without = largest(*r.without());
        lobe.eval = r.mean(i).eval;
        lobe.sample = r.mean(i).sample;
        lobe.why = why_chosen(r.offers(), i, _plan.error <= _tolerance, _tolerance);
        _plan.lobes.push_back(std::move(lobe));
    }

    // One choice for each tile, where all together cost less than one for all: `whole`.
    void take_tiles(const Choice& whole)
    {
        PlannedTiles tiles;
        tiles.across = tiles_across;
        double eval = 0, sample = 0;
        for (Ranges& ranges : _tiles)
        {
            finish(ranges);
            const Choice choice = cheapest(ranges, _tolerance);
            tiles.error = std::max(tiles.error, choice.error);
            tiles.eval += choice.eval / double(_tiles.size());
            tiles.sample += choice.sample / double(_tiles.size());
            Methods methods(ranges.size());
            for (std::size_t k = 0; k < ranges.size(); ++k)
            {
                if (!whole.offers[k]) continue;
                const Compensation& of_all = _ranges[k].offers()[*whole.offers[k]].method;
                methods[k] =
                    choice.offers[k] ? ranges[k].offers()[*choice.offers[k]].method : of_all;
                if (!ranges[k].is_there()) continue;
                const Prediction* same = ranges[k].mean_of(of_all);
                eval += same->eval / double(_tiles.size());
                sample += same->sample / double(_tiles.size());
            }
            tiles.choice_of.push_back(add_choice(methods, tiles));
        }
        tiles.price_of_one = eval + sample;
        if (tiles.eval + tiles.sample > (1 - worth_tiles) * tiles.price_of_one) return;
        _plan.error = tiles.error;
        _plan.is_within = _plan.error <= _tolerance;
        _plan.eval = tiles.eval;
        _plan.sample = tiles.sample;
        _plan.tiles = std::move(tiles);
    }
    std::size_t add_choice(const Methods& methods, PlannedTiles& tiles)
    {
        std::vector<std::string> names;
        for (std::size_t k = 0; k < methods.size(); ++k)
            names.emplace_back(methods[k] ? name(*methods[k]) : _plan.lobes[k].method);
        for (std::size_t i = 0; i < tiles.choices.size(); ++i)
            if (tiles.choices[i] == names) return i;
        tiles.choices.push_back(names);
        _methods_of_choices.push_back(methods);
        return tiles.choices.size() - 1;
    }

    void bind()
    {
        std::vector<ClosureTree> trees;
        for (std::size_t i = 0; i < _plan.tiles.choices.size(); ++i)
        {
            ClosureTree of_tiles = tree();
            for (std::size_t k = 0; k < _plan.lobes.size(); ++k)
                if (const auto& method = _methods_of_choices[i][k])
                    set_method(of_tiles, _plan.lobes[k].node, *method);
            bind(of_tiles);
            trees.push_back(std::move(of_tiles));
        }
        bind(tree());
        if (trees.empty()) return;
        const auto& of = _plan.tiles.choice_of;
        _plan.surface.set_tiles(_plan.tiles.across, {of.begin(), of.end()}, std::move(trees));
    }
    static void set_method(ClosureTree& t, ClosureTree::Node lobe, const Compensation& method)
    {
        ClosureTree::Material m = t.material_of(lobe);
        std::get<MicrofacetMaterial>(m).method = method;
        t.set_material(lobe, m);
    }
    void bind(ClosureTree& t)
    {
        t.bind_tables();
        for (int k = 0; k < t.lobes(); ++k)
            if (const auto* m = std::get_if<MicrofacetMaterial>(&t.material(k)))
                add_bound_tables(*m, t.lobes() > 1, _plan.tables);
    }

    const MethodCosts& _costs;
    double _tolerance;
    MaterialPlan _plan;
    Ranges _ranges;              // by lobe
    std::vector<Ranges> _tiles;  // row by row; empty where nothing is planned by tile
    std::vector<Methods> _methods_of_choices;
};

std::size_t sum_of(const std::vector<PlannedTable>& tables, bool compiled_in)
{
    std::size_t sum = 0;
    for (const PlannedTable& t : tables)
        if (t.compiled_in == compiled_in) sum += t.bytes;
    return sum;
}

}  // namespace

std::size_t PlannedTiles::count(std::size_t choice) const
{
    return static_cast<std::size_t>(std::count(choice_of.begin(), choice_of.end(), choice));
}

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
