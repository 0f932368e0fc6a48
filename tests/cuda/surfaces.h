// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The surfaces and the questions.

#pragma once

#include "../support/closures.h"
#include "../support/coarse_glass.h"
#include "question.h"

#include <regain/luts/library.h>

#include <string>
#include <vector>

namespace regain::tests {

/// Round microfacets, and long ones; with all tables that there are of the distribution.
inline std::vector<Surface> surfaces_of(const std::string& distribution)
{
    Surface round;
    round.mirror = luts::microfacet_tables(distribution);
    luts::add_anisotropy(round.mirror, distribution);
    luts::add_later_bounces(round.mirror, distribution);
    luts::add_later_shape(round.mirror, distribution);
    luts::add_balance(round.mirror, distribution);
    luts::add_balance_anisotropy(round.mirror, distribution);
    for (int shadowing = 0; shadowing < 2; ++shadowing)
    {
        const bool beta = shadowing == 1;
        const auto form = beta ? TransmissionShadowing::beta : TransmissionShadowing::correlated;
        DielectricTables& glass = round.glass[shadowing];
        if (distribution == "gtr" || distribution == "std")
        {
            glass = coarse_dielectric_tables();
            if (beta)
                for (int side = 0; side < 2; ++side) glass.later[side] = glass.R[side];
            continue;
        }
        glass = luts::dielectric_tables(distribution, form);
        luts::add_anisotropy(glass, distribution, form);
        if (beta) luts::add_later_split(glass, distribution);
    }
    Surface brushed = round;
    brushed.alpha_x = 0.12f;
    brushed.alpha_y = 0.5f;
    brushed.gamma = 2.6f;
    brushed.eta = 1.33f;
    brushed.strength = 0.7f;
    return {round, brushed};
}

/// From above and below, in all directions but those near the horizon.
inline std::vector<Question> questions()
{
    Random random(12);
    const auto towards = [&](double share_below) {
        const double mu = 0.1 + 0.9 * random.unit(), azimuth = 6.2831853 * random.unit();
        Vec3<float> w = direction<float>(mu, azimuth);
        if (random.unit() < share_below) w.z = -w.z;
        return askew().to_world(w);
    };
    std::vector<Question> all;
    for (int i = 0; i < 48; ++i)
    {
        Question q;
        q.wo = towards(0.25);
        q.wi = towards(0.4);
        q.u = {random.unit<float>(), random.unit<float>(), random.unit<float>()};
        all.push_back(q);
    }
    return all;
}

}  // namespace regain::tests
