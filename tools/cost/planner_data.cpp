// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "planner_data.h"

#include "machine.h"

#include <regain/closures/version.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace regain::tools::cost {
namespace {

using Json = nlohmann::ordered_json;

double short_number(double x) { return std::stod(fmt::format("{:.3g}", x)); }

const char* axis_name(Class kind)
{
    switch (kind)
    {
        case Class::metal: return "F0";
        case Class::coloured: return "material";
        default: return "eta";
    }
}

// Rows of one class, distribution and method, which the results have alpha by alpha.
class Entry
{
public:
    explicit Entry(const Row& row)
        : _kind(row.kind), _law(row.law), _method(row.method), _bytes(row.table_bytes)
    {}

    bool holds(const Row& row) const
    {
        return row.kind == _kind && row.law.label() == _law.label() && row.method == _method;
    }
    void add(const Row& row)
    {
        _refused = _refused || !row.refused.empty();
        if (_alphas.empty() || _alphas.back() != row.alpha)
        {
            _alphas.push_back(row.alpha);
            _error.emplace_back();
            _eval.push_back(0);
            _sample.push_back(0);
        }
        if (_alphas.size() == 1)
            _axis.push_back(_kind == Class::coloured ? Json(row.part.label) : Json(row.part.axis));
        _error.back().push_back(short_number(row.errors.worst));
        // Times hardly depend on the material: one for all.
        const double n = static_cast<double>(_error.back().size());
        _eval.back() += (row.to_white.eval - _eval.back()) / n;
        _sample.back() += (row.to_white.sample - _sample.back()) / n;
        _sigma = std::max(_sigma, row.errors.noise);
        _bytes = std::max(_bytes, row.table_bytes);
    }
    Json json() const
    {
        Json j{{"class", name(_kind)}, {"distribution", shaders::name(_law.kind)}};
        if (shaders::has_gamma(_law.kind)) j["gamma"] = _law.gamma;
        j["method"] = _method;
        if (_refused)
        {
            j["refused"] = true;
            return j;
        }
        j["alpha"] = _alphas;
        j[axis_name(_kind)] = _axis;
        j["error"] = _error;
        j["noise"] = short_number(_sigma);
        j["eval"] = shortened(_eval);
        j["sample"] = shortened(_sample);
        j["table_bytes"] = _bytes;
        return j;
    }

private:
    static std::vector<double> shortened(std::vector<double> all)
    {
        for (double& x : all) x = short_number(x);
        return all;
    }

    Class _kind;
    Law _law;
    std::string _method;
    bool _refused = false;
    std::vector<double> _alphas;
    Json _axis = Json::array();
    std::vector<std::vector<double>> _error;
    std::vector<double> _eval, _sample;
    double _sigma = 0;
    std::size_t _bytes;
};

}  // namespace

std::string planner_data(const Results& results)
{
    std::vector<Entry> entries;
    for (const Row& row : results.rows)
    {
        auto entry = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry& e) { return e.holds(row); });
        if (entry == entries.end()) entry = entries.insert(entries.end(), Entry(row));
        entry->add(row);
    }
    const Json head{{"schema", 1},
                    {"version", REGAIN_VERSION_STRING},
                    {"compiler", compiler()},
                    {"processor", processor()},
                    {"samples", results.samples},
                    {"walk_samples", results.walk_samples},
                    {"seed", results.seed},
                    {"reference", "walk"},
                    {"transmission_shadowing", "beta"}};
    std::string out = head.dump(1);
    out.erase(out.size() - 2);  // the end, which is still to come
    out += ",\n \"entries\": [\n";
    for (std::size_t i = 0; i < entries.size(); ++i)
        out += entries[i].json().dump() + (i + 1 < entries.size() ? ",\n" : "\n");
    return out + "]}\n";
}

}  // namespace regain::tools::cost
