// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "bound_tables.h"

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>
#include <regain/luts/table.h>
#include <regain/shaders/tables_read.h>

#include <algorithm>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {
namespace {

std::size_t numbers(const TableView& t)
{
    return static_cast<std::size_t>(t.width) * static_cast<std::size_t>(std::max(t.height, 1)) *
           static_cast<std::size_t>(std::max(t.depth, 1));
}
std::size_t numbers(const GridView<5>& g)
{
    std::size_t n = 1;
    for (const int length : g.size) n *= static_cast<std::size_t>(length);
    return n;
}

class Collector
{
public:
    Collector(const MicrofacetMaterial& m, std::vector<PlannedTable>& all)
        : _m(m), _distribution(name(m.distribution)), _all(all)
    {}

    void operator()(const MicrofacetTables& t)
    {
        add("E_ss", t.E_ss);
        add("falloff", t.falloff);
        add("dip", t.dip);
        add("E_avg", t.E_avg);
        add("balance", t.balance);
        add("q_ms", t.q_ms);
        add("mu_ms", t.mu_ms);
        add("spread", t.spread);
        add("forward", t.forward);
        add("tilt", t.tilt);
        if (t.anisotropy) add("anisotropy", *t.anisotropy);
        if (t.balance_anisotropy) add("balance_anisotropy", *t.balance_anisotropy);
    }
    void operator()(const DielectricTables& t)
    {
        if (!t.E[0]) return;
        luts::TableInfo info;
        info.distribution = _distribution;
        if (has_gamma(_m.distribution)) info.gamma = _m.gamma;
        info.transmission_shadowing = t.near_index ? "beta" : "correlated";
        const auto later = luts::later_split_table_names(_distribution, info.gamma);
        for (std::size_t side = 0; side < 2; ++side)
        {
            info.side = side == 0 ? "outside" : "inside";
            for (const auto& [quantity, view] :
                 {std::pair{"E_S", t.E[side]}, {"R_share", t.R[side]}})
            {
                info.quantity = quantity;
                add_named(luts::table_name(info), view);
            }
            add_named(later[side], t.later[side]);
            if (t.anisotropy)
                add("anisotropy_" + info.transmission_shadowing + "_" + info.side,
                    t.anisotropy->change[side]);
        }
    }

private:
    template <class View>
    void add(const std::string& quantity, const View& view)
    {
        add_named(_distribution + "_" + quantity, view);
    }
    template <class View>
    void add_named(const std::string& table, const View& view)
    {
        if (!view) return;
        add_table({table, sizeof(std::uint16_t) * numbers(view), bool(luts::builtin_table(table))},
                  _all);
    }

    const MicrofacetMaterial& _m;
    std::string _distribution;
    std::vector<PlannedTable>& _all;
};

}  // namespace

void add_table(const PlannedTable& table, std::vector<PlannedTable>& all)
{
    if (std::none_of(all.begin(), all.end(),
                     [&](const PlannedTable& t) { return t.name == table.name; }))
        all.push_back(table);
}

void add_bound_tables(const MicrofacetMaterial& m, bool for_albedo, std::vector<PlannedTable>& all)
{
    Collector collect(m, all);
    const MicrofacetTables& bound = m.tables();
    MicrofacetTables read = tables_read(m.method, bound);
    // Those of ggx come all together, whatever is used.
    if (for_albedo)
    {
        static_cast<AlbedoTables&>(read) = bound;
        // A walk says what a method with tables would.
        if (std::holds_alternative<RandomWalk>(m.method))
            read.E_avg = bound.E_avg, read.q_ms = bound.q_ms, read.mu_ms = bound.mu_ms;
    }
    collect(read);
    collect(m.interface_tables());
}

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
