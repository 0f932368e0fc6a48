// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "query_line.h"

#include "errors.h"

#include <fmt/format.h>

namespace regain::tools {
namespace {

constexpr std::array<std::string_view, 7> ops{"eval", "pdf",     "sample", "albedo",
                                              "gain", "fresnel", "ndf"};

// One closure needs two levels: the object, a list or the Fresnel term in it, a list in that. Each
// combination that it is in needs one more.
constexpr int deepest = 16;

// The names given at each level, to find those given twice, of which JSON readers keep one or the
// other.
class Keys
{
public:
    void open(std::size_t level) { _count[level] = 0; }
    void add(std::size_t level, const std::string& name)
    {
        auto& names = _names[level];
        for (std::size_t i = 0; i < _count[level]; ++i)
            if (names[i] == name) throw BadInput("the field " + excerpt(name) + " is given twice");
        // Beyond that there is some unknown one, which will be found.
        if (_count[level] < names.size()) names[_count[level]++] = name;
    }

private:
    std::array<std::array<std::string, 32>, deepest + 1> _names;
    std::array<std::size_t, deepest + 1> _count{};
};

std::string without_prefix(std::string message)
{
    // "[json.exception.parse_error.101] parse error at line 1, column 7: ..."
    const std::size_t at = message.find("] ");
    if (at != std::string::npos) message.erase(0, at + 2);
    constexpr std::size_t longest = 200;
    if (message.size() > longest) message = message.substr(0, longest) + "...";
    return message;
}

Json parsed(std::string_view line)
{
    // The parser would take it for the end.
    if (line.find('\0') != std::string_view::npos) throw BadInput("the line has a zero byte in it");

    static thread_local Keys keys;
    const auto watch = [](int depth, Json::parse_event_t event, Json& value) {
        using Event = Json::parse_event_t;
        if (event == Event::object_start || event == Event::array_start)
        {
            if (depth >= deepest) throw BadInput("the line is nested too deep for a query");
            keys.open(static_cast<std::size_t>(depth) + 1);
        }
        else if (event == Event::key)
            keys.add(static_cast<std::size_t>(depth), value.get_ref<const std::string&>());
        return true;
    };
    try
    {
        return Json::parse(line, watch);
    }
    catch (const Json::exception& e)
    {
        throw BadInput("the line is no JSON: " + without_prefix(e.what()));
    }
}

Imath::V3d read_wo(Fields& fields)
{
    const auto wo = fields.direction("wo");
    const auto mu = fields.number("mu", {-1, 1});
    if (wo && mu) throw BadInput("'wo' and 'mu' are both given; 'mu' stands for 'wo'");
    if (wo) return *wo;
    if (!mu) fields.missing("'wo' (or 'mu')");
    return direction_at(*mu);
}

Imath::V3d needed_direction(Fields& fields, std::string_view name)
{
    const auto w = fields.direction(name);
    if (!w) fields.missing("'" + std::string(name) + "'");
    return *w;
}

// `otherwise`: how many times where nothing is said; 0 if it has to be.
void read_random_numbers(Fields& fields, Query& query, std::size_t numbers, std::uint64_t most,
                         std::uint64_t otherwise)
{
    query.u = fields.numbers("u", numbers, {0, 1, true});
    const auto n = fields.count("n", 1, most);
    const auto seed = fields.count("seed", 0, UINT64_MAX);
    if (query.u && (n || seed))
        throw BadInput("'u' is given, and 'n' or 'seed', too; accepted: 'u', or 'n' with 'seed'");
    if (!query.u && !n && otherwise == 0) fields.missing("'u' (or 'n')");
    query.n = n.value_or(otherwise);
    query.seed = seed.value_or(0);
}

AlbedoSettings read_albedo_settings(Fields& fields, const ClosureSpec& closure)
{
    AlbedoSettings settings;
    settings.how = default_albedo_method(closure);
    if (closure.is_stochastic())
    {
        if (const auto order = fields.count("order", 1, most_bounces))
            settings.order = static_cast<int>(*order);
    }
    else
        fields.reject("order", "it belongs to the method walk");
    if (const auto how = fields.text("how"))
        settings.how = static_cast<AlbedoMethod>(choose("how", *how, albedo_methods));
    require_possible(closure, settings);
    if (settings.how == AlbedoMethod::monte_carlo)
    {
        settings.samples = fields.count("n", 2, most_averaged_samples).value_or(settings.samples);
        settings.seed = fields.count("seed", 0, UINT64_MAX).value_or(settings.seed);
    }
    return settings;
}

void read_operands(Fields& fields, Query& query)
{
    switch (query.op)
    {
        case Op::eval:
        case Op::pdf:
            query.wo = read_wo(fields);
            query.wi = needed_direction(fields, "wi");
            if (query.op == Op::eval && query.closure.is_stochastic())
                read_random_numbers(fields, query, 3, most_averaged_samples, default_estimates);
            break;
        case Op::sample:
            query.wo = read_wo(fields);
            read_random_numbers(fields, query, query.closure.random_numbers(), most_listed_samples,
                                0);
            break;
        case Op::albedo:
            query.wo = read_wo(fields);
            query.albedo = read_albedo_settings(fields, query.closure);
            break;
        case Op::gain:
            query.wo = read_wo(fields);
            if (std::holds_alternative<shaders::Balanced>(query.closure.method))
                query.wi = needed_direction(fields, "wi");
            break;
        case Op::fresnel: {
            // Below the surface there is nothing but a dielectric's other side.
            const bool two_sides =
                std::holds_alternative<DielectricParameters>(query.closure.fresnel);
            const auto mu = fields.number("mu", two_sides ? Range{-1, 1} : unit_range);
            if (!mu) fields.missing("'mu'");
            query.mu = *mu;
            break;
        }
        case Op::ndf:
            query.wo = read_wo(fields);
            query.wm = needed_direction(fields, "wm");
            break;
    }
}

}  // namespace

Query read_query(std::string_view line)
{
    const Json json = parsed(line);
    Fields fields(json, "the query");
    Query query;
    const auto op = fields.text("op");
    if (!op) fields.missing("'op'");
    query.op = static_cast<Op>(choose("op", *op, ops));

    if (query.op != Op::albedo) fields.reject("order", "it belongs to the op albedo");
    const bool closure_needed =
        query.op != Op::ndf && !(query.op == Op::fresnel && fields.has("fresnel"));
    query.closure = read_closure_spec(fields, closure_needed);
    read_operands(fields, query);
    fields.finish();
    return query;
}

}  // namespace regain::tools
