// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/method_costs.h>

#include <algorithm>

REGAIN_NAMESPACE_BEGIN

namespace embedded {

std::string_view method_cost_data(std::string_view name);

}  // namespace embedded

namespace shaders {
namespace {

constexpr std::string_view class_names[] = {"metal", "coloured-metal", "glass-outside",
                                            "glass-inside", "plastic"};

}  // namespace

std::string_view name(CostClass c) { return class_names[static_cast<std::size_t>(c)]; }

std::optional<CostClass> cost_class_named(std::string_view wanted)
{
    const auto found = std::find(std::begin(class_names), std::end(class_names), wanted);
    if (found == std::end(class_names)) return std::nullopt;
    return static_cast<CostClass>(found - std::begin(class_names));
}

const MethodCosts& MethodCosts::shipped()
{
    static const MethodCosts costs = [] {
        const std::string_view text = embedded::method_cost_data("method_costs.json");
        return text.empty() ? MethodCosts() : parse(text);
    }();
    return costs;
}

const MethodCost* MethodCosts::find(CostClass kind, DistributionKind distribution, double gamma,
                                    const Compensation& method) const
{
    for (const MethodCost& e : _entries)
        if (e.kind == kind && e.distribution == distribution &&
            (!has_gamma(distribution) || e.gamma == gamma) &&
            shaders::name(e.method) == shaders::name(method))
            return &e;
    return nullptr;
}

std::vector<double> MethodCosts::gammas(DistributionKind distribution) const
{
    std::vector<double> all;
    if (!has_gamma(distribution)) return all;
    for (const MethodCost& e : _entries)
        if (e.distribution == distribution) all.push_back(e.gamma);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
