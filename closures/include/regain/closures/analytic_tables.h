// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Tables that are formulas, analytic_albedo.h, for GGX and Beckmann mirrors. They go wherever
/// MicrofacetTables go, into any method, and need no library and no file:
///
///   compensated(lobe, Method::turquin, analytic_tables<GGX<float>>())

#pragma once

#include <regain/closures/beckmann.h>
#include <regain/closures/ggx.h>
#include <regain/closures/table.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class Distribution>
struct FitsOf
{
    static constexpr bool exist = false;
};
template <class Real>
struct FitsOf<GGX<Real>>
{
    static constexpr bool exist = true;
    REGAIN_HOST_DEVICE static const MicrofacetFits* get()
    {
        static constexpr MicrofacetFits fits = ggx_fits;
        return &fits;
    }
};
template <class Real>
struct FitsOf<Beckmann<Real>>
{
    static constexpr bool exist = true;
    REGAIN_HOST_DEVICE static const MicrofacetFits* get()
    {
        static constexpr MicrofacetFits fits = beckmann_fits;
        return &fits;
    }
};

}  // namespace detail

/// Whether there are formulas for a distribution.
template <class Distribution>
constexpr bool has_analytic_tables = detail::FitsOf<Distribution>::exist;

/// The formulas of a distribution, in place of every table of it. They are static: the result may
/// be kept for ever.
template <class Distribution>
REGAIN_HOST_DEVICE MicrofacetTables analytic_tables()
{
    static_assert(has_analytic_tables<Distribution>, "there are formulas for GGX and Beckmann");
    MicrofacetTables tables;
    tables.fits = detail::FitsOf<Distribution>::get();
    return tables;
}

REGAIN_NAMESPACE_END
