// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "commands.h"
#include "errors.h"
#include "measured_albedo.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace regain::tools {
namespace {

constexpr const char* help_footer = R"help(
The albedo is the part of the light that leaves: over all directions, for light along one whose
cosine is mu; and on average, 2 int E(mu) mu dmu. It is measured on the closure's eval
(quadrature) or sample (monte-carlo); table is the look-up that the closure itself uses. The error
of quadrature is the difference from a coarser one, that of Monte Carlo its standard error. mu below
0 is seen from inside a dielectric, of which what is transmitted is listed beside what is reflected.

examples:
  regain albedo --alpha 1 --constant 1                     what a rough mirror keeps: 1 - ln 2 at mu 1
  regain albedo --alpha 1 --constant 1 --method turquin    the white furnace: 1
  regain albedo --closure generalized_schlick --f0 1,0.78,0.34 --alpha 0.5,0.1 --mu 0.2,0.9
  regain albedo --alpha 0.5 --n 0.2,0.4,1.4 --k 3.4,2.3,1.8 --how monte-carlo --n-samples 1000000
  regain albedo --closure dielectric --eta 1.5 --alpha 0.5 --mu -0.5,0.5    rough glass, both sides
  regain albedo --distribution gtr --gamma 1 --alpha 0.3 --method walk      all bounces
  regain albedo --alpha 1 --constant 1 --method walk --order 2              the second bounce alone
)help";

struct Arguments
{
    std::string closure, distribution = "ggx", method = "none", precision = "float";
    std::string how, scatter_mode, shadowing;
    std::vector<double> alpha, F0, F82, n, k, constant, gamma, eta;
    std::vector<double> mu{0.01, 0.1, 0.2, 0.5, 0.8, 1};
    double strength = 1;
    std::vector<double> color, roughness;
    std::string mode;
    bool energy_compensation = false;
    bool thin_walled = false;
    std::uint64_t order = 0;
    std::uint64_t samples = AlbedoSettings{}.samples, seed = 0;
    bool json = false;
};

// One number stands for all three channels.
Json channels(const std::vector<double>& given)
{
    return given.size() == 1 ? Json::array({given[0], given[0], given[0]}) : Json(given);
}

// The same object as in a query, so that the same is accepted and the errors read alike.
Json as_json(const Arguments& a)
{
    Json json{{"method", a.method},
              {"precision", a.precision},
              {"strength", a.strength},
              {"closure", a.closure}};
    if (a.closure.empty())
        json["closure"] = name(!a.eta.empty() ? Lobe::dielectric
                               : a.F0.empty() ? Lobe::conductor
                                              : Lobe::generalized_schlick);
    if (lobe_has_microfacets(json["closure"].get<std::string>()) || a.distribution != "ggx")
        json["distribution"] = a.distribution;
    if (!a.color.empty()) json["color"] = channels(a.color);
    if (!a.roughness.empty()) json["roughness"] = a.roughness[0];
    if (!a.mode.empty()) json["mode"] = a.mode;
    if (a.energy_compensation) json["energy_compensation"] = true;
    if (!a.gamma.empty()) json["gamma"] = a.gamma[0];
    if (!a.eta.empty()) json["fresnel"]["eta"] = a.eta[0];
    if (!a.scatter_mode.empty()) json["scatter_mode"] = a.scatter_mode;
    if (!a.shadowing.empty()) json["transmission_shadowing"] = a.shadowing;
    if (a.thin_walled) json["thin_walled"] = true;
    if (a.alpha.size() == 1)
        json["alpha"] = a.alpha[0];
    else if (!a.alpha.empty())
        json["alpha"] = a.alpha;
    if (!a.F0.empty()) json["fresnel"]["F0"] = channels(a.F0);
    if (!a.F82.empty()) json["fresnel"]["F82"] = channels(a.F82);
    if (!a.n.empty()) json["fresnel"]["n"] = channels(a.n);
    if (!a.k.empty()) json["fresnel"]["k"] = channels(a.k);
    if (!a.constant.empty()) json["fresnel"]["constant"] = channels(a.constant);
    return json;
}

AlbedoSettings settings_of(const Arguments& a, const ClosureSpec& spec)
{
    AlbedoSettings settings;
    settings.how = default_albedo_method(spec);
    if (!a.how.empty())
        settings.how = static_cast<AlbedoMethod>(choose("how", a.how, albedo_methods));
    if (a.order > 0)
    {
        if (!spec.is_stochastic()) throw BadInput("--order belongs to the method walk");
        if (a.order > most_bounces)
            throw BadInput(fmt::format("--order is {}; accepted: 1 to {}", a.order, most_bounces));
        settings.order = static_cast<int>(a.order);
    }
    require_possible(spec, settings);
    if (a.samples < 2 || a.samples > most_averaged_samples)
        throw BadInput(
            fmt::format("--n-samples is {}; accepted: 2 to {}", a.samples, most_averaged_samples));
    settings.samples = a.samples;
    settings.seed = a.seed;
    return settings;
}

Json as_json(const MeasuredAlbedo& albedo)
{
    const auto list = [](const ColorD& c) { return Json::array({c.x, c.y, c.z}); };
    return {{"reflect", list(albedo.reflect)},
            {"transmit", list(albedo.transmit)},
            {"stderr", albedo.error ? Json(*albedo.error) : Json()}};
}

void print_row(const std::string& label, const MeasuredAlbedo& albedo, bool two_sides)
{
    const std::string error = albedo.error ? fmt::format("{:9.1e}", *albedo.error) : "        -";
    const auto colour = [](const ColorD& c) {
        return fmt::format("{:10.6f} {:10.6f} {:10.6f}", c.x, c.y, c.z);
    };
    fmt::print("{:>8}  {}  {}{}\n", label, colour(albedo.reflect),
               two_sides ? colour(albedo.transmit) + "  " : "", error);
}

int run(const Arguments& a)
{
    const Json json = as_json(a);
    Fields fields(json, "the closure");
    const ClosureSpec spec = read_closure_spec(fields, true);
    fields.finish();
    const AlbedoSettings settings = settings_of(a, spec);
    const std::string_view how = albedo_methods[static_cast<std::size_t>(settings.how)];
    for (double mu : a.mu)
        if (!(mu >= -1 && mu <= 1))
            throw BadInput(fmt::format("--mu holds {}; accepted: cosines from -1 to 1", mu));

    const bool both = spec.has_two_sides();
    Json answers{{"closure", json}, {"how", how}, {"directional", Json::array()}};
    if (!a.json)
    {
        const std::string gamma =
            shaders::has_gamma(spec.distribution) ? fmt::format(" of gamma {:g}", spec.gamma) : "";
        fmt::print("{}, {}{}, alpha {:g}{}; method {}, strength {:g}; {}, {}\n", name(spec.lobe),
                   shaders::name(spec.distribution), gamma, spec.alpha_x,
                   spec.alpha_y == spec.alpha_x ? "" : fmt::format(",{:g}", spec.alpha_y), a.method,
                   spec.strength, how, a.precision);
        constexpr const char* colours = "       red      green       blue";
        fmt::print("{:>8}  {}  {}    error\n", "mu", colours,
                   both ? "       and transmitted            " : "");
    }
    for (double mu : a.mu)
    {
        const MeasuredAlbedo albedo = measured_albedo(spec, direction_at(mu), settings);
        if (!a.json)
            print_row(fmt::format("{:g}", mu), albedo, both);
        else
        {
            Json entry = as_json(albedo);
            entry["mu"] = mu;
            answers["directional"].push_back(entry);
        }
    }
    const auto average = [&](const char* label, bool below) {
        const MeasuredAlbedo albedo = measured_average_albedo(spec, settings, below);
        if (!a.json)
            print_row(label, albedo, both);
        else
            answers[label] = as_json(albedo);
    };
    average("average", false);
    if (both) average("inside", true);
    if (a.json) fmt::print("{}\n", answers.dump());
    return kDone;
}

void add_numbers(CLI::App* command, const char* name, std::vector<double>& value, int most,
                 const char* help)
{
    command->add_option(name, value, help)->delimiter(',')->expected(1, most);
}

}  // namespace

void add_albedo(CLI::App& app, int& exit_code)
{
    CLI::App* command =
        app.add_subcommand("albedo", "what a closure reflects, by direction and on average");
    command->footer(help_footer);
    auto a = std::make_shared<Arguments>();
    command->add_option("--closure", a->closure,
                        "conductor (default), generalized_schlick (default with --f0), "
                        "dielectric (default with --eta), sheen, oren_nayar_diffuse, "
                        "burley_diffuse, subsurface, translucent, transparent");
    command->add_option("--distribution", a->distribution, "ggx (default), beckmann, gtr, std");
    add_numbers(command, "--gamma", a->gamma, 1, "tail of gtr (up to 10) and std (1.51 to 100); 2");
    add_numbers(command, "--alpha", a->alpha, 2, "width in [0, 1], or alpha_x,alpha_y; 0.05");
    add_numbers(command, "--color", a->color, 3, "of what has no microfacets");
    add_numbers(command, "--roughness", a->roughness, 1, "of the rough diffuse ones and of cloth");
    command->add_option("--mode", a->mode, "of sheen: burley (default), conty_kulla, zeltner");
    command->add_flag("--energy-compensation", a->energy_compensation, "of oren_nayar_diffuse");
    add_numbers(command, "--f0", a->F0, 3, "Schlick: colour at normal incidence");
    add_numbers(command, "--f82", a->F82, 3, "Schlick: tint at 82 degrees");
    add_numbers(command, "--n", a->n, 3, "conductor: index of refraction");
    add_numbers(command, "--k", a->k, 3, "conductor: extinction");
    add_numbers(command, "--constant", a->constant, 3, "the same reflectance at every angle");
    add_numbers(command, "--eta", a->eta, 1, "dielectric: index inside over index outside; 1.5");
    command->add_option("--scatter-mode", a->scatter_mode, "of dielectric: R, T, RT (default)");
    command->add_option("--transmission-shadowing", a->shadowing,
                        "of dielectric: correlated (default), beta");
    command->add_flag("--thin-walled", a->thin_walled, "the dielectric is a sheet");
    command->add_option("--method", a->method,
                        "of compensation; none (default), turquin, kulla-conty, walk, ...");
    command->add_option("--strength", a->strength, "of the method, in [0, 1]; 1");
    add_numbers(command, "--mu", a->mu, 1 << 20, "cosines; 0.01,0.1,0.2,0.5,0.8,1");
    command->add_option("--how", a->how,
                        "quadrature (default), table, monte-carlo (default of walk)");
    command->add_option("--order", a->order, "of walk: light of so many bounces alone");
    command->add_option("--n-samples", a->samples, "of Monte Carlo, for each number; 65536")
        ->check(CLI::NonNegativeNumber);
    // CLI11 takes -1 for the largest number there is.
    command->add_option("--seed", a->seed, "of Monte Carlo; 0")->check(CLI::NonNegativeNumber);
    command->add_option("--precision", a->precision, "float (default), double");
    command->add_flag("--json", a->json, "one JSON object in place of the table");
    command->callback([a, &exit_code] { exit_code = run_reporting([&] { return run(*a); }); });
}

}  // namespace regain::tools
