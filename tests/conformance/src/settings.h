// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The parameters and directions that a subject is looked at for.

#pragma once

#include <regain/conformance/run.h>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

struct Setting
{
    Parameters parameters;
    Direction wo{0, 0, 1};
    std::string parameters_name, name;  ///< without and with the direction
    bool first_direction = true;        ///< of its parameters
};

/// Those that the subject can tell apart, each once.
std::vector<Setting> settings_of(const Subject& subject, Tier tier);

/// wo at the cosine mu in [-1, 1] and the azimuth phi in radians.
Direction direction_at(double mu, double phi = 0);

/// Commonly measured metals, for tinted lobes: n and k at 650, 550 and 450 nm (Johnson and Christy
/// 1972).
Parameters gold(Parameters p);

}  // namespace conformance
REGAIN_NAMESPACE_END
