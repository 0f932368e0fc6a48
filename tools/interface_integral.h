// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Integrals over all directions into which a rough interface between two media sends wo, on both
/// sides,
///
///   reflected   dwi = 4 (wo.m) dm                                   Walter et al. 2007, Eq. 14
///   refracted   dwi = |wo.m + eta_o wi.m|^2 / (eta_o^2 |wi.m|) dm   Eq. 17
///
/// over the slopes of the facet m, in polar coordinates about slope 0 stretched by alpha, where a
/// microfacet distribution peaks. Along each ray the range is cut where a facet turns away from wo,
/// reflects totally, or scatters along the horizon; arcs of rays are halved until their halves say
/// the same.
///
/// f is any function of wi, so that what is integrated are the answers of a closure and nothing
/// else: the mapping knows alpha and eta only to put its nodes where the light is.

#pragma once

#include "json_fields.h"

#include <functional>

namespace regain::tools {

struct InterfaceIntegral
{
    ColorD reflected{0.0}, transmitted{0.0};

    void add(const InterfaceIntegral& other, double weight)
    {
        reflected += other.reflected * weight;
        transmitted += other.transmitted * weight;
    }
};

/// wo is unit, on either side; black along the horizon. eta: index on the -z side over index on the
/// +z side. `nodes`: 64 is within about 1e-6, 32 within 1e-5.
InterfaceIntegral integrate_interface(const Imath::V3d& wo, double eta, double alpha_x,
                                      double alpha_y, int nodes,
                                      const std::function<ColorD(const Imath::V3d&)>& f);

}  // namespace regain::tools
