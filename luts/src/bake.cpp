// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/bake.h>

#include "definition.h"
#include "dielectric_anisotropy.h"
#include "integral_rows.h"
#include "parallel.h"

#include <memory>
#include <mutex>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

using Integrals = std::vector<double>;

// Those that were integrated last are kept for the next table that is made of them.
std::shared_ptr<const Integrals> integrals_of(const IntegralRows& rows,
                                              const BakeProgress& progress)
{
    static std::mutex mutex;
    static std::string last;
    static std::shared_ptr<const Integrals> kept;
    {
        const std::lock_guard<std::mutex> lock(mutex);
        if (kept && last == rows.name)
        {
            if (progress && !progress(1)) throw BakeStopped();
            return kept;
        }
    }
    auto all = std::make_shared<Integrals>(rows.count * rows.length);
    parallel_for(rows.count, progress,
                 [&](std::size_t row) { rows.integrate(row, all->data() + row * rows.length); });
    const std::lock_guard<std::mutex> lock(mutex);
    last = rows.name;
    kept = all;
    return all;
}

void append(std::vector<std::string>& names, const std::vector<std::string>& more)
{
    names.insert(names.end(), more.begin(), more.end());
}

}  // namespace

std::vector<std::string> compiled_in_tables()
{
    return {"ggx_E_ss", "ggx_E_avg", "ggx_falloff", "ggx_dip",     "ggx_balance",
            "ggx_q_ms", "ggx_mu_ms", "ggx_spread",  "ggx_forward", "ggx_tilt"};
}

std::vector<std::string> shipped_tables()
{
    std::vector<std::string> names = compiled_in_tables();
    // By family, so that each is integrated once.
    for (const char* distribution : {"beckmann", "gtr", "std"})
        for (const char* quantity : {"E_ss", "falloff", "dip", "E_avg", "balance", "q_ms", "mu_ms",
                                     "spread", "forward", "tilt"})
            names.push_back(std::string(distribution) + "_" + quantity);
    for (const char* quantity : {"anisotropy", "balance_anisotropy"})
        for (const char* distribution : {"ggx", "beckmann", "gtr", "std"})
            names.push_back(std::string(distribution) + "_" + quantity);
    append(names, dielectric_table_names("ggx"));
    append(names, dielectric_table_names("beckmann"));
    append(names, later_split_table_names("ggx"));
    append(names, later_split_table_names("beckmann"));
    append(names, dielectric_anisotropy_table_names("ggx"));
    append(names, dielectric_anisotropy_table_names("beckmann"));
    return names;
}

std::vector<std::string> dielectric_table_names(const std::string& distribution, double gamma)
{
    TableInfo info;
    info.distribution = distribution;
    info.gamma = distribution == "gtr" || distribution == "std" ? gamma : 0;
    std::vector<std::string> names;
    for (const char* side : {"outside", "inside"})
        // By quantity, whose tables are of one size and come out of one lattice.
        for (const char* quantity : {"E_S", "R_share"})
            for (const char* shadowing : {"correlated", "beta"})
            {
                info.side = side;
                info.transmission_shadowing = shadowing;
                info.quantity = quantity;
                names.push_back(table_name(info));
            }
    return names;
}

std::vector<std::string> later_split_table_names(const std::string& distribution, double gamma)
{
    TableInfo info;
    info.distribution = distribution;
    info.gamma = distribution == "gtr" || distribution == "std" ? gamma : 0;
    info.quantity = "R_later";
    std::vector<std::string> names;
    for (const char* side : {"outside", "inside"})
    {
        info.side = side;
        names.push_back(table_name(info));
    }
    return names;
}

std::vector<std::string> dielectric_anisotropy_table_names(const std::string& distribution)
{
    TableInfo info;
    info.distribution = distribution;
    info.quantity = "anisotropy";
    std::vector<std::string> names;
    if (distribution == "gtr" || distribution == "std") return names;
    for (const char* side : {"outside", "inside"})
        for (const char* shadowing : {"correlated", "beta"})
        {
            info.side = side;
            info.transmission_shadowing = shadowing;
            names.push_back(table_name(info));
        }
    return names;
}

void require_bakeable(const std::string& name) { Definition::of(name); }

TableInfo bakeable_info(const std::string& name) { return Definition::of(name).info; }

double exact_value(const std::string& name, const TablePoint& at, int nodes)
{
    const Definition d = Definition::of(name);
    if (d.is_grid()) return d.family.plane({at.x}, {at.y}, at.z, at.v, at.w, nodes).values.front();
    if (d.family.kind == Family::Kind::glass_anisotropy)
    {
        const GlassAnisotropy::Values v =
            GlassAnisotropy{d.info.distribution, d.family.inside}.at(at, nodes);
        return d.info.transmission_shadowing == "beta" ? v.beta : v.correlated;
    }
    return d.value(d.family.row({at.x}, at.y, at.z, nodes)[0]);
}

bool is_error_promised(const std::string& name, const TablePoint& at)
{
    const Definition d = Definition::of(name);
    if (d.is_grid()) return d.family.plane({at.x}, {at.y}, at.z, at.v, at.w, 2).promised.front();
    if (d.family.kind != Family::Kind::glass_anisotropy) return d.family.promised(at.x, at.y, at.z);
    const GlassAnisotropy::Values v =
        GlassAnisotropy{d.info.distribution, d.family.inside}.at(at, d.check_accuracy);
    return GlassAnisotropy::promised(
        v.mu, d.info.transmission_shadowing == "beta" ? v.beta_sum : v.correlated_sum);
}

double smallest_promised(const std::string& name) { return Definition::of(name).smallest_promised; }

double greatest_answer(const std::string& name) { return Definition::of(name).greatest; }

bool is_logarithmic(const std::string& name) { return Definition::of(name).info.transform == "ln"; }

double interpolated(const TableView& table, const TablePoint& at)
{
    if (table.depth > 1) return table.at(at.x, at.y, at.z);
    return table.height > 1 ? table.at(at.x, at.y) : table.at(at.x);
}

double interpolated(const Table& table, const TablePoint& at)
{
    const double x[] = {at.x, at.y, at.z, at.v, at.w};
    return table.info().axis_4.empty() ? interpolated(table.view(), at) : table.grid<5>().at(x);
}

Table bake(const std::string& name, const BakeProgress& progress)
{
    const Definition d = Definition::of(name);
    return table_of(d, *integrals_of(rows_of(d), progress));
}

}  // namespace luts
REGAIN_NAMESPACE_END
