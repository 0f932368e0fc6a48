// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include "integral_rows.h"

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// What anisotropy changes of the albedo of glass: the table of five axes whose look-up is
/// described in regain/closures/dielectric_anisotropy.h.
struct GlassAnisotropy
{
    /// ln(E^S(w; ax, ay, eta) / E^S(w.z; a, eta)) by the form of transmission shadowing; the E^S of
    /// w, and its cosine.
    struct Values
    {
        double correlated, beta, correlated_sum, beta_sum, mu;
    };

    std::string distribution;  // "ggx" or "beckmann"
    bool inside;

    Values at(const TablePoint& point, int nodes) const;

    /// The range that the error is promised for: cosines from 0.03 on, where E^S is above 0.1.
    /// `share` of either is the bound.
    static bool promised(double mu, double sum, double share = 1)
    {
        return mu >= 0.03 * share && sum >= 0.1 * share;
    }
};

/// Nodes along its axes.
std::array<int, 5> glass_anisotropy_size(bool inside);

/// What rows_of and table_of do for it.
IntegralRows glass_anisotropy_rows(const Definition& definition);
Table glass_anisotropy_table(const Definition& definition, const std::vector<double>& integrals);

}  // namespace luts
REGAIN_NAMESPACE_END
