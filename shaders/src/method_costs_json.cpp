// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/method_costs.h>

#include <stdexcept>

#ifdef REGAIN_HAS_JSON
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#endif

REGAIN_NAMESPACE_BEGIN
namespace shaders {

#ifdef REGAIN_HAS_JSON

namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& why)
{
    throw std::runtime_error("the costs of methods cannot be read: " + why);
}

bool rises(const std::vector<double>& x)
{
    return !x.empty() && std::is_sorted(x.begin(), x.end()) &&
           std::adjacent_find(x.begin(), x.end()) == x.end();
}

bool are_counts(const std::vector<double>& x)
{
    return std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v) && v >= 0; });
}

void check(const MethodCost& e, const std::string& what)
{
    if (!rises(e.alpha) || !rises(e.axis)) fail(what + " has no rising alpha and axis");
    if (e.error.size() != e.alpha.size() || e.eval.size() != e.alpha.size() ||
        e.sample.size() != e.alpha.size())
        fail(what + " has not as many numbers as widths");
    bool good = are_counts(e.eval) && are_counts(e.sample) && std::isfinite(e.noise);
    for (const auto& row : e.error) good = good && row.size() == e.axis.size() && are_counts(row);
    if (!good) fail(what + " has a number that is none, or too few of them");
}

// Empty where the library has no such combination, or the method is unknown to it.
std::optional<MethodCost> entry_of(const Json& j)
{
    const std::string kind = j.at("class"), distribution = j.at("distribution"),
                      method = j.at("method");
    const std::string what = kind + ", " + distribution + ", " + method;
    const auto c = cost_class_named(kind);
    const auto d = distribution_named(distribution);
    const auto m = compensation_named(method);
    if (!c) fail("there is no class '" + kind + "'");
    if (!d) fail("there is no distribution '" + distribution + "'");
    if (!m || j.value("refused", false)) return std::nullopt;

    MethodCost e;
    e.kind = *c;
    e.distribution = *d;
    e.method = *m;
    if (has_gamma(*d)) e.gamma = j.at("gamma");
    j.at("alpha").get_to(e.alpha);
    if (*c == CostClass::coloured_metal)
        for (std::size_t i = 0; i < j.at("material").size(); ++i)
            e.axis.push_back(static_cast<double>(i));
    else
        j.at(*c == CostClass::metal ? "F0" : "eta").get_to(e.axis);
    j.at("error").get_to(e.error);
    j.at("eval").get_to(e.eval);
    j.at("sample").get_to(e.sample);
    e.noise = j.at("noise");
    e.table_bytes = j.at("table_bytes");
    check(e, what);
    return e;
}

}  // namespace

MethodCosts MethodCosts::parse(std::string_view text)
{
    MethodCosts costs;
    try
    {
        const Json j = Json::parse(text.begin(), text.end());
        if (j.at("schema") != 1) fail("schema " + j.at("schema").dump() + "; accepted: 1");
        // The one form that all methods go with; errors of the other are not known.
        if (j.value("transmission_shadowing", "beta") != "beta")
            fail("transmission_shadowing is not beta");
        costs._measured_on = j.value("compiler", "") + ", " + j.value("processor", "");
        for (const Json& one : j.at("entries"))
            if (auto e = entry_of(one)) costs._entries.push_back(std::move(*e));
    }
    catch (const Json::exception& e)
    {
        fail(e.what());
    }
    if (costs._entries.empty()) fail("there are none");
    return costs;
}

#else

MethodCosts MethodCosts::parse(std::string_view)
{
    throw std::runtime_error(
        "the costs of methods cannot be read: this library was built without nlohmann-json");
}

#endif

}  // namespace shaders
REGAIN_NAMESPACE_END
