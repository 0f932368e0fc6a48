// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What is dear to measure of one subject and told of several: the bounces of a reference, which
/// every method of a lobe is compared with; the survey of a lobe that gains scale.

#pragma once

#include "survey.h"

#include <map>
#include <mutex>
#include <string>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// By name, from any thread.
template <class Value>
class Remembered
{
public:
    /// What `measure` returned for this name before, or returns now.
    template <class Measure>
    Value of(const std::string& name, const Measure& measure)
    {
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            if (const auto known = _known.find(name); known != _known.end()) return known->second;
        }
        // Two that ask at once measure the same.
        const Value value = measure();
        const std::lock_guard<std::mutex> lock(_mutex);
        return _known.emplace(name, value).first->second;
    }

private:
    std::mutex _mutex;
    std::map<std::string, Value> _known;
};

/// One run's.
struct Memory
{
    Remembered<MeanColor> reference_albedos;
    Remembered<Survey> surveys;  ///< without cells
};

}  // namespace conformance
REGAIN_NAMESPACE_END
