// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "integral_rows.h"

#include "dielectric_anisotropy.h"
#include "grid_bake.h"
#include "lattice_bake.h"
#include "parallel.h"

#include <regain/luts/table_integrals.h>

#include <algorithm>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace luts {

IntegralRows rows_of(const Definition& d)
{
    if (d.is_grid()) return grid_rows(d);
    if (d.family.kind == Family::Kind::glass_anisotropy) return glass_anisotropy_rows(d);
    return lattice_rows(d);
}

Table table_of(const Definition& d, const std::vector<double>& integrals)
{
    if (d.is_grid()) return grid_table(d, integrals);
    if (d.family.kind == Family::Kind::glass_anisotropy)
        return glass_anisotropy_table(d, integrals);
    return lattice_table(d, integrals);
}

TableIntegrals::TableIntegrals(const std::string& table)
    : _rows(std::make_shared<const IntegralRows>(rows_of(Definition::of(table))))
{}

const std::string& TableIntegrals::name() const { return _rows->name; }
std::size_t TableIntegrals::rows() const { return _rows->count; }
std::size_t TableIntegrals::across() const { return _rows->across; }
std::size_t TableIntegrals::length() const { return _rows->length; }

std::vector<double> TableIntegrals::integrate(const std::vector<std::size_t>& rows,
                                              const BakeProgress& progress) const
{
    for (const std::size_t row : rows)
        if (row >= _rows->count)
            throw std::invalid_argument("row " + std::to_string(row) + " of " +
                                        std::to_string(_rows->count));
    std::vector<double> values(rows.size() * _rows->length);
    if (rows.empty()) return values;
    parallel_for(rows.size(), progress, [&](std::size_t i) {
        _rows->integrate(rows[i], values.data() + i * _rows->length);
    });
    return values;
}

Table bake(const std::string& name, const std::vector<double>& integrals)
{
    const Definition d = Definition::of(name);
    const IntegralRows rows = rows_of(d);
    if (integrals.size() != rows.count * rows.length)
        throw std::invalid_argument("table " + name + " is made of " +
                                    std::to_string(rows.count * rows.length) + " integrals, not " +
                                    std::to_string(integrals.size()));
    return table_of(d, integrals);
}

}  // namespace luts
REGAIN_NAMESPACE_END
