// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "render_checks.h"

#include "errors.h"

#include <algorithm>
#include <optional>

namespace regain::tools {

void refuse(const std::string& option, const std::string& given, const std::string& accepted)
{
    // A flag has no value.
    throw BadInput(fmt::format("{}{}{}: {}", option, given.empty() ? "" : " ", given, accepted));
}

void check_count(const char* option, std::int64_t value, std::int64_t least, std::int64_t most)
{
    if (value < least || value > most)
        refuse(option, std::to_string(value), fmt::format("takes {} to {}", least, most));
}

void check_number(const char* option, double value, double least, double most,
                  const char* least_means)
{
    if (!(value >= least && value <= most))
        refuse(option, fmt::format("{}", value),
               fmt::format("takes numbers from {}{} to {}", least, least_means, most));
}

void check_list(const char* option, const std::vector<double>& values, const char* least_means)
{
    constexpr std::size_t most = 16;
    if (values.empty() || values.size() > most)
        refuse(option, fmt::format("with {} values", values.size()),
               fmt::format("takes 1 to {}", most));
    for (const double value : values) check_number(option, value, 0, 1, least_means);
}

std::vector<shaders::Compensation> methods_named(const std::string& list)
{
    std::vector<shaders::Compensation> methods;
    for (std::size_t from = 0; from < list.size();)
    {
        const std::size_t to = std::min(list.find(',', from), list.size());
        const std::string one = list.substr(from, to - from);
        const auto method = shaders::compensation_named(one);
        if (!method)
            refuse("--method", one,
                   fmt::format("no such method; there are {}",
                               fmt::join(shaders::compensation_names(), ", ")));
        methods.push_back(*method);
        from = to + 1;
    }
    return methods;
}

std::vector<std::pair<std::string, std::string>> overrides_of(const std::vector<std::string>& all)
{
    std::vector<std::pair<std::string, std::string>> overrides;
    for (const std::string& one : all)
    {
        const auto equals = one.find('=');
        if (equals == one.npos || equals == 0 || equals + 1 == one.size())
            refuse("--set", one, "takes INPUT=VALUE or NODE.INPUT=VALUE");
        overrides.emplace_back(one.substr(0, equals), one.substr(equals + 1));
    }
    return overrides;
}

namespace {

std::optional<std::string> text(const std::optional<std::string>& given) { return given; }
std::optional<std::string> text(const std::optional<double>& given)
{
    if (given) return fmt::format("{}", *given);
    return std::nullopt;
}
std::optional<std::string> text(const std::vector<double>& given)
{
    if (!given.empty()) return fmt::format("{}", fmt::join(given, ","));
    return std::nullopt;
}
std::optional<std::string> text(bool given)
{
    if (given) return std::string();
    return std::nullopt;
}

}  // namespace

void check_belongings(const RenderOptions& o)
{
    const bool glass = o.material == "glass", sheen = o.material == "sheen",
               metal = !glass && !sheen;
    const struct
    {
        const char* option;
        std::optional<std::string> given;
        bool goes;
        const char* accepted;
    } options[] = {
        {"--metal", text(o.metal), metal, "metal"},
        {"--ior", text(o.ior), glass, "glass"},
        {"--thin-walled", text(o.thin_walled), glass, "glass"},
        {"--scatter-mode", text(o.scatter_mode), glass, "glass"},
        {"--transmission-shadowing", text(o.transmission_shadowing), glass, "glass"},
        {"--weight", text(o.weights), sheen, "sheen"},
        {"--base", text(o.base), sheen, "sheen"},
        {"--alpha", text(o.alphas), !sheen, "metal, glass"},
        {"--alpha-ratio", text(o.alpha_ratio), !sheen, "metal, glass"},
        {"--distribution", text(o.distribution), !sheen, "metal, glass"},
        {"--gamma", text(o.gamma), !sheen, "metal, glass"},
    };
    for (const auto& x : options)
        if (x.given && !x.goes)
            refuse(x.option, *x.given,
                   fmt::format("does not go with --material {}; accepted: {}", o.material,
                               x.accepted));
}

}  // namespace regain::tools
