// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What each method of compensation costs and how far it is from the random walk, as `regain cost`
/// measured it: what the planner (planner.h) goes by. docs/cost.md says what the numbers are.

#pragma once

#include <regain/shaders/export.h>
#include <regain/shaders/microfacet_material.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// Materials that were measured. Plastic: an interface of mode R over a diffuse base.
enum class CostClass { metal, coloured_metal, glass_outside, glass_inside, plastic };

/// The name in files; and back.
REGAIN_SHADERS_API std::string_view name(CostClass);
REGAIN_SHADERS_API std::optional<CostClass> cost_class_named(std::string_view);

/// One method on one class and distribution. Times are over that of a white GGX mirror without
/// compensation.
struct MethodCost
{
    CostClass kind = CostClass::metal;
    DistributionKind distribution = DistributionKind::ggx;
    double gamma = 2;  ///< of gtr and std
    Compensation method;
    std::vector<double> alpha;               ///< rising
    std::vector<double> axis;                ///< F0 or eta, rising; of coloured metals 0, 1, ...
    std::vector<std::vector<double>> error;  ///< of the albedo, largest; by alpha, then axis
    double noise = 0;                        ///< one sigma of the errors
    std::vector<double> eval, sample;        ///< by alpha
    std::size_t table_bytes = 0;
};

class MethodCosts
{
public:
    /// None.
    MethodCosts() = default;

    /// Those that are compiled in; none where this library was built without them.
    REGAIN_SHADERS_API static const MethodCosts& shipped();

    /// Of the text of a file that `regain cost --planner-data` writes. Throws std::runtime_error,
    /// which says what of it is wrong, and where this library was built without nlohmann-json.
    REGAIN_SHADERS_API static MethodCosts parse(std::string_view json);

    bool empty() const { return _entries.empty(); }
    const std::vector<MethodCost>& entries() const { return _entries; }
    /// Null where that was not measured, or there is no such combination.
    REGAIN_SHADERS_API const MethodCost* find(CostClass, DistributionKind, double gamma,
                                              const Compensation&) const;
    /// Gammas that a distribution was measured at, rising; none of ggx and beckmann.
    REGAIN_SHADERS_API std::vector<double> gammas(DistributionKind) const;
    /// The compiler and processor that the times are of.
    const std::string& measured_on() const { return _measured_on; }

private:
    std::vector<MethodCost> _entries;
    std::string _measured_on;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
