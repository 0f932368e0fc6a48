// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "plan_report.h"

#include "errors.h"
#include "render_checks.h"

#include <fstream>
#include <sstream>

namespace regain::tools {

using namespace shaders;
using Json = nlohmann::ordered_json;

namespace {

Json or_null(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

Json as_json(const std::vector<PlannedTable>& tables)
{
    Json all = Json::array();
    for (const PlannedTable& t : tables)
        all.push_back({{"name", t.name}, {"bytes", t.bytes}, {"compiled_in", t.compiled_in}});
    return all;
}

Json as_json(const PlannedLobe& lobe)
{
    Json j{{"name", lobe.name}, {"closure", lobe.closure}};
    if (!lobe.distribution.empty()) j["distribution"] = lobe.distribution;
    j["left_out"] = lobe.left_out;
    if (!lobe.left_out) j["method"] = lobe.method;
    j["called_for"] = lobe.called_for.names();
    j["error"] = or_null(lobe.error);
    j["error_without"] = or_null(lobe.error_without);
    j["eval"] = lobe.eval;
    j["sample"] = lobe.sample;
    j["why"] = lobe.why;
    return j;
}

Json as_json(const MaterialPlan& m)
{
    Json j{{"material", m.name},
           {"error", m.is_known ? Json(m.error) : Json(nullptr)},
           {"within", m.is_within},
           {"eval", m.eval},
           {"sample", m.sample},
           {"price", m.price()},
           {"called_for", m.called_for.names()},
           {"closures", Json::array()},
           {"tables", as_json(m.tables)},
           {"notes", m.notes}};
    for (const PlannedLobe& lobe : m.lobes) j["closures"].push_back(as_json(lobe));
    if (m.tiles.across > 0)
        j["tiles"] = {{"across", m.tiles.across},
                      {"choices", m.tiles.choices},
                      {"choice_of", m.tiles.choice_of},
                      {"price_of_one", m.tiles.price_of_one}};
    return j;
}

std::string listed(const std::vector<std::string>& all)
{
    return all.empty() ? "nothing" : fmt::format("{}", fmt::join(all, ", "));
}

std::string kept(const MaterialPlan& m)
{
    if (!m.is_known) return "error not known";
    return fmt::format("error {:.2g}{}", m.error, m.is_within ? "" : ", beyond the tolerance");
}

// "by tile of 8 x 8: 40 none, 24 turquin"; of several closures, methods in their order.
std::string tiles_of(const MaterialPlan& m)
{
    std::vector<std::string> all;
    for (std::size_t i = 0; i < m.tiles.choices.size(); ++i)
    {
        std::vector<std::string> methods;
        for (const std::string& method : m.tiles.choices[i])
            if (!method.empty()) methods.push_back(method);
        all.push_back(
            fmt::format("{} {}", m.tiles.count(i), fmt::format("{}", fmt::join(methods, " + "))));
    }
    return fmt::format("by tile of {0} x {0}: {1}", m.tiles.across, fmt::join(all, ", "));
}

std::string lines_of(const MaterialPlan& m)
{
    std::string text = fmt::format("{}: {}; price {:.3g}; calls for {}\n", m.name, kept(m),
                                   m.price(), listed(m.called_for.names()));
    for (const PlannedLobe& lobe : m.lobes)
    {
        const std::string law = lobe.distribution.empty() ? "" : " " + lobe.distribution;
        text += fmt::format("  {:<12} {:<28} {:<18} {:>8} {:>9} {:>6.3g}\n", lobe.name,
                            lobe.closure + law, lobe.left_out ? "left out" : lobe.method,
                            lobe.error ? fmt::format("{:.2g}", *lobe.error) : "?",
                            lobe.error_without ? fmt::format("{:.2g}", *lobe.error_without) : "?",
                            lobe.eval + lobe.sample);
        text += fmt::format("               {}\n", lobe.why);
    }
    if (m.tiles.across > 0)
        text += fmt::format("  {}; one plan for all: price {:.3g}\n", tiles_of(m),
                            m.tiles.price_of_one);
    for (const std::string& note : m.notes) text += fmt::format("  {}\n", note);
    return text;
}

}  // namespace

MethodCosts method_costs(const std::string& file)
{
    if (file.empty()) return MethodCosts::shipped();
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in)
        refuse("--costs", file, "cannot be read; takes a file of `regain cost --planner-data`");
    try
    {
        return MethodCosts::parse(text.str());
    }
    catch (const std::runtime_error& e)
    {
        refuse("--costs", file, e.what());
    }
}

void check_tolerance(double tolerance) { check_number("--tolerance", tolerance, 0, 1); }

Json as_json(const ScenePlan& plan, double tolerance)
{
    Json j{{"tolerance", tolerance},
           {"materials", Json::array()},
           {"tables", as_json(plan.tables)},
           {"loaded_bytes", plan.loaded_bytes()},
           {"compiled_in_bytes", plan.compiled_in_bytes()},
           {"notes", plan.notes}};
    for (const MaterialPlan& m : plan.materials) j["materials"].push_back(as_json(m));
    return j;
}

std::string as_text(const ScenePlan& plan, double tolerance)
{
    std::string text;
    for (const std::string& note : plan.notes) text += note + "\n";
    text += fmt::format(
        "tolerance {:g}; a price is that of an eval and a sample, each 1 of a white GGX mirror\n"
        "  {:<12} {:<28} {:<18} {:>8} {:>9} {:>6}\n",
        tolerance, "closure", "", "method", "error", "without", "price");
    for (const MaterialPlan& m : plan.materials) text += lines_of(m);
    text += fmt::format("tables in memory: {} bytes loaded, {} compiled in\n", plan.loaded_bytes(),
                        plan.compiled_in_bytes());
    for (const PlannedTable& t : plan.tables)
        text += fmt::format("  {:<32} {:>9}{}\n", t.name, t.bytes,
                            t.compiled_in ? "  compiled in" : "");
    return text;
}

std::string chosen_methods(const MaterialPlan& m)
{
    if (m.tiles.across > 0) return tiles_of(m);
    std::vector<std::string> all;
    for (const PlannedLobe& lobe : m.lobes)
        if (!lobe.left_out) all.push_back(lobe.name + " " + lobe.method);
    return fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace regain::tools
