// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a run found, and how machines read it: docs/cost.md says what each field means.

#pragma once

#include "equal_time.h"
#include "measure.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace regain::tools::cost {

struct Row
{
    Class kind = Class::metal;
    Law law;
    double alpha = 0;
    Part part;
    std::string method;
    std::string refused;  ///< why there is nothing; empty where there is
    Errors errors;
    figures::Times times;     ///< nanoseconds
    figures::Times to_none;   ///< over those of the same closure without compensation; 0: none ran
    figures::Times to_white;  ///< over those of the white GGX without compensation
    std::size_t table_bytes = 0;
};

/// The lobes of one case for eyes: the walk's and those of methods.
struct LobeSet
{
    Class kind = Class::metal;
    double alpha = 0;
    Part part;
    Lobe walk;
    std::vector<std::pair<std::string, Lobe>> methods;
};

struct Results
{
    bool quick = false;
    std::uint64_t samples = 0, walk_samples = 0, walk_shape_samples = 0;
    std::uint32_t seed = 0;
    int threads = 0;
    Choice choice;
    std::vector<Row> rows;
    std::vector<LobeSet> lobes;
    std::vector<EqualTimeScene> pictures;
};

std::string as_csv(const Results&);
nlohmann::ordered_json as_json(const Results&);

}  // namespace regain::tools::cost
