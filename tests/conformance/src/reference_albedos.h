// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Albedos of references: a simulation of all bounces is dear, and every method of a lobe is
/// compared with the same one.

#pragma once

#include "survey.h"

#include <map>
#include <mutex>
#include <string>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

class ReferenceAlbedos
{
public:
    /// What `simulate` returned for this name before, or returns now. From any thread.
    template <class Simulate>
    MeanColor of(const std::string& name, const Simulate& simulate)
    {
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            if (const auto known = _known.find(name); known != _known.end()) return known->second;
        }
        // Two that ask at once simulate the same.
        const MeanColor albedo = simulate();
        const std::lock_guard<std::mutex> lock(_mutex);
        return _known.emplace(name, albedo).first->second;
    }

private:
    std::mutex _mutex;
    std::map<std::string, MeanColor> _known;
};

}  // namespace conformance
REGAIN_NAMESPACE_END
