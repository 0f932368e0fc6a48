// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Why a plan is as it is, in one sentence each.

#pragma once

#include <regain/shaders/planner.h>

#include "plan_search.h"

#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {

struct NamedOffer
{
    Compensation method;
    Offer offer;
};

/// Of the offer that was chosen among these, all of one closure.
std::string why_chosen(const std::vector<NamedOffer>&, std::size_t chosen, bool within,
                       double tolerance);

/// Why there is no prediction.
std::string why_unknown(const MethodCosts&, const MicrofacetMaterial&);

/// Two digits.
std::string digits(double);

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
