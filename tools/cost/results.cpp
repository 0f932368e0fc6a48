// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "results.h"

#include "fronts.h"
#include "machine.h"

#include <regain/closures/version.h>

#include <fmt/format.h>

namespace regain::tools::cost {
namespace {

using Json = nlohmann::ordered_json;

// Six digits: more than the noise leaves, and the same in both files.
std::string digits(double x) { return fmt::format("{:.6g}", x); }
double rounded(double x) { return std::stod(digits(x)); }

std::string quoted(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

Json as_json(const Row& row)
{
    Json j{{"class", name(row.kind)},
           {"material", row.part.label},
           {"distribution", shaders::name(row.law.kind)},
           {"gamma", shaders::has_gamma(row.law.kind) ? Json(row.law.gamma) : Json()},
           {"alpha", row.alpha},
           {"method", row.method}};
    if (!row.refused.empty())
    {
        j["refused"] = row.refused;
        return j;
    }
    const Errors& e = row.errors;
    j["error"] = rounded(e.worst);
    j["error_mean"] = rounded(e.mean);
    j["tint"] = e.tint < 0 ? Json() : Json(rounded(e.tint));
    j["shape"] = rounded(e.shape);
    j["variance"] = rounded(e.variance);
    j["stderr"] = rounded(e.standard_error);
    j["noise"] = rounded(e.noise);
    j["eval_ns"] = rounded(row.times.eval);
    j["sample_ns"] = rounded(row.times.sample);
    j["eval_ratio"] = row.to_none.eval > 0 ? Json(rounded(row.to_none.eval)) : Json();
    j["sample_ratio"] = row.to_none.sample > 0 ? Json(rounded(row.to_none.sample)) : Json();
    j["eval_to_white"] = rounded(row.to_white.eval);
    j["sample_to_white"] = rounded(row.to_white.sample);
    j["table_bytes"] = row.table_bytes;
    return j;
}

// The columns, in the order and with the digits of the JSON.
constexpr const char* fields[] = {
    "class",           "material",    "distribution", "gamma",      "alpha",        "method",
    "error",           "error_mean",  "tint",         "shape",      "variance",     "stderr",
    "noise",           "eval_ns",     "sample_ns",    "eval_ratio", "sample_ratio", "eval_to_white",
    "sample_to_white", "table_bytes", "refused"};

std::string cell(const Json& row, const char* field)
{
    const auto at = row.find(field);
    if (at == row.end() || at->is_null()) return "";
    if (at->is_string()) return quoted(at->get<std::string>());
    if (at->is_number_integer()) return std::to_string(at->get<std::int64_t>());
    return digits(at->get<double>());
}

Json as_json(const Front& f)
{
    Json points = Json::array(), front = Json::array();
    for (const Point& p : f.points)
        points.push_back(
            {{"method", p.method}, {"error", rounded(p.error)}, {"time", rounded(p.time)}});
    for (const std::size_t i : f.front) front.push_back(f.points[i].method);
    return {{"class", name(f.kind)},
            {"distribution", shaders::name(f.law.kind)},
            {"gamma", shaders::has_gamma(f.law.kind) ? Json(f.law.gamma) : Json()},
            {"roughness", f.band.name},
            {"floor", rounded(f.floor)},
            {"front", front},
            {"points", points},
            {"sentence", f.sentence}};
}

Json as_json(const EqualTimeScene& scene)
{
    Json pictures = Json::array();
    for (const TimedPicture& p : scene.pictures)
        pictures.push_back({{"method", p.method},
                            {"seconds", rounded(p.seconds)},
                            {"samples_per_pixel", rounded(p.samples)},
                            {"rmse", rounded(p.rmse)},
                            {"block_rmse", rounded(p.block_rmse)}});
    return {{"scene", scene.name},
            {"reference_seconds", rounded(scene.reference_seconds)},
            {"reference_samples_per_pixel", rounded(scene.reference_samples)},
            {"note",
             "How many samples fit into the time depends on the machine and on what else it does: "
             "these pixels and their errors differ from run to run."},
            {"pictures", pictures}};
}

}  // namespace

std::string as_csv(const Results& results)
{
    std::string out;
    for (const char* f : fields) out += (out.empty() ? "" : ",") + std::string(f);
    out += "\n";
    for (const Row& row : results.rows)
    {
        const Json j = as_json(row);
        bool first = true;
        for (const char* f : fields)
        {
            out += (first ? "" : ",") + cell(j, f);
            first = false;
        }
        out += "\n";
    }
    return out;
}

Json as_json(const Results& results)
{
    Json j{{"schema", 1},
           {"version", REGAIN_VERSION_STRING},
           {"compiler", compiler()},
           {"machine", {{"processor", processor()}, {"processors", processors()}}},
           {"quick", results.quick},
           {"samples", results.samples},
           {"walk_samples", results.walk_samples},
           {"walk_shape_samples", results.walk_shape_samples},
           {"seed", results.seed},
           {"threads", results.threads},
           {"cosines", cosines}};
    Json shapes = Json::array();
    for (const std::size_t i : shape_cosines) shapes.push_back(cosines[i]);
    j["shape_cosines"] = shapes;
    j["transmission_shadowing"] = "beta";
    j["rows"] = Json::array();
    for (const Row& row : results.rows) j["rows"].push_back(as_json(row));
    j["fronts"] = Json::array();
    for (const Front& f : fronts_of(results)) j["fronts"].push_back(as_json(f));
    j["equal_time"] = Json::array();
    for (const EqualTimeScene& scene : results.pictures) j["equal_time"].push_back(as_json(scene));
    return j;
}

}  // namespace regain::tools::cost
