// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The list of planted bugs: which fault of which textbook closure, and the check that is meant to
/// see it.

#pragma once

#include "planted_subject.h"

#include <regain/conformance/run.h>

#include <vector>

namespace regain::planted {

using conformance::Tier;

struct Bug
{
    std::string name;
    std::string check;
    std::function<PlantedSubject(const std::string& name)> subject;
    /// One setting in which it shows, or empty: all of them. Tests look there alone, which is what
    /// keeps them short.
    std::string setting;
    /// The tier that rejects it, by the setting and the effort of that tier.
    Tier tier = Tier::commit;
};

const std::vector<Bug>& bugs();

/// The closures without a fault.
std::vector<PlantedSubject> faultless();

}  // namespace regain::planted
