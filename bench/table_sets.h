// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The tables of a distribution, by what needs them, and how large they are.

#pragma once

#include "../tools/table_bytes.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/dielectric.h>
#include <regain/closures/ggx.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/luts/library.h>

#include <cstddef>
#include <string>

namespace regain::bench {

/// The name of a distribution's tables, and one of it whose gamma, where there is one, is `gamma`.
template <template <class> class Distribution>
struct Named;
template <>
struct Named<GGX>
{
    static constexpr const char* name = "ggx";
};
template <>
struct Named<Beckmann>
{
    static constexpr const char* name = "beckmann";
};
template <>
struct Named<GTR>
{
    static constexpr const char* name = "gtr";
};
template <>
struct Named<STD>
{
    static constexpr const char* name = "std";
};

template <template <class> class Distribution, class Real>
Distribution<Real> distribution_of(const Real& alpha)
{
    if constexpr (Distribution<Real>::has_tail)
        return Distribution<Real>(alpha, Real(2));
    else
        return Distribution<Real>(alpha);
}

using tools::bytes_of;

struct TableSets
{
    MicrofacetTables albedo, directional, balanced, tail;
    DielectricTables correlated, beta, beta_tail;  ///< of ggx and beckmann alone

    explicit TableSets(const std::string& distribution)
        : albedo(luts::microfacet_tables(distribution)), directional(albedo)
    {
        luts::add_later_bounces(directional, distribution);
        balanced = tail = directional;
        luts::add_balance(balanced, distribution);
        luts::add_later_shape(tail, distribution);
        if (distribution != "ggx" && distribution != "beckmann") return;
        correlated = luts::dielectric_tables(distribution, TransmissionShadowing::correlated);
        beta = beta_tail = luts::dielectric_tables(distribution, TransmissionShadowing::beta);
        luts::add_later_split(beta_tail, distribution);
    }
};

}  // namespace regain::bench
