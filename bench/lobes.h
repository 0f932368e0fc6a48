// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The lobes that are measured: one of each kind, of any distribution and number type.

#pragma once

#include "table_sets.h"

#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/thin_dielectric.h>

namespace regain::bench {

template <template <class> class Distribution, class Real>
struct Lobes
{
    using D = Distribution<Real>;
    using Color = Color3<Real>;

    static Color color(float r, float g, float b) { return {Real(r), Real(g), Real(b)}; }

    /// The mirror that all ratios are taken to.
    static auto white(const Real& alpha, const MicrofacetTables& tables)
    {
        return MicrofacetReflection<D, ConstantFresnel<Real>>(distribution_of<Distribution>(alpha),
                                                              ConstantFresnel<Real>(), tables);
    }
    /// Schlick's Fresnel term with a tint at 82 degrees, of gold.
    static auto schlick(const Real& alpha, const MicrofacetTables& tables)
    {
        return MicrofacetReflection<D, SchlickFresnel<Real>>(
            distribution_of<Distribution>(alpha),
            SchlickFresnel<Real>(color(0.94f, 0.77f, 0.37f), color(0.98f, 0.95f, 0.75f)), tables);
    }
    /// The exact Fresnel term, of gold.
    static auto gold()
    {
        return ConductorFresnel<Real>(color(0.16f, 0.42f, 1.5f), color(3.46f, 2.35f, 1.88f));
    }
    static auto conductor(const Real& alpha, const MicrofacetTables& tables)
    {
        return MicrofacetReflection<D, ConductorFresnel<Real>>(distribution_of<Distribution>(alpha),
                                                               gold(), tables);
    }
    static auto glass(const Real& alpha, TransmissionShadowing shadowing,
                      const DielectricTables& tables)
    {
        return Dielectric<D>(distribution_of<Distribution>(alpha), eta(), ScatterMode::RT,
                             Color(Real(1)), Color(Real(1)), shadowing, tables);
    }
    static auto sheet(const Real& alpha, const MicrofacetTables& tables)
    {
        return ThinDielectric<D>(distribution_of<Distribution>(alpha), eta(), ScatterMode::RT,
                                 Color(Real(1)), Color(Real(1)), tables);
    }
    static Real eta() { return Real(1.5f); }
};

}  // namespace regain::bench
