// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "export_fits.h"

#include "errors.h"
#include "shader_expression.h"

#include <regain/closures/analytic_albedo.h>
#include <regain/luts/replace_file.h>

#include <fmt/format.h>

#include <fstream>

namespace regain::tools {
namespace {

constexpr const char* head = R"text(// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project
//
// Energy compensation for microfacet lobes without tables, {language}. Written by Regain {version},
// `regain bake --export`, from the formulas of regain/closures/analytic_albedo.h.
//
// mu = cos theta of the direction towards the viewer and alpha, the width of an isotropic GGX or
// Beckmann lobe with height-correlated Smith shadowing, are in [0, 1]; alpha is an artist's
// roughness squared. Errors are the largest over mu in (0, 1] and alpha in [1e-6, 1].
//
//   E_ss    single-scattering albedo where F = 1          2e-3, of itself
//   E_avg   2 int_0^1 E_ss mu dmu                         2e-4
//   q_ms    of light past its second facet the share that goes on to another at each
//   mu_ms   cosine at which F is what later facets reflect
//
// A lobe is compensated when it is multiplied by
//   1 + F_ms (1 - E_ss) / E_ss
// with, per channel, F_ms = F0, or F_ms = x (1 - q_ms) / (1 - q_ms x) where x = F(mu_ms). The
// albedo of the latter is within 5e-3 of a random walk's for Schlick's term, within 1.2e-2 for
// metals by n and k, for alpha from 0.1 and mu from 0.05.

#ifndef REGAIN_FITS
#define REGAIN_FITS
)text";

// visit(name, what it is, arguments, formula).
template <class Visit>
void visit_functions(const Visit& visit)
{
    using E = ShaderExpression;
    struct Distribution
    {
        const char* name;
        const char* title;
        const MicrofacetFits* fits;
    };
    for (const Distribution& d :
         {Distribution{"ggx", "GGX", &ggx_fits}, {"beckmann", "Beckmann", &beckmann_fits}})
    {
        const MicrofacetFits& fits = *d.fits;
        const auto function = [&](const char* quantity, bool directional, const auto& formula) {
            ShaderFunction body;
            const E mu(body, "mu"), alpha(body, "alpha");
            const std::string name = fmt::format("regain_{}_{}", d.name, quantity);
            const std::vector<std::string> arguments = directional
                                                           ? std::vector<std::string>{"mu", "alpha"}
                                                           : std::vector<std::string>{"alpha"};
            const std::string result = formula(mu, alpha).text();
            visit(name, fmt::format("{} of {}.", quantity, d.title),
                  body.text(name, arguments, result));
        };
        function("E_ss", true, [&](const E& mu, const E& alpha) { return fits.E_ss(mu, alpha); });
        function("E_avg", false, [&](const E&, const E& alpha) { return fits.E_avg(alpha); });
        function("q_ms", true, [&](const E& mu, const E& alpha) { return fits.q_ms(mu, alpha); });
        function("mu_ms", true, [&](const E& mu, const E& alpha) { return fits.mu_ms(mu, alpha); });
    }
}

}  // namespace

std::vector<std::string> exported_functions()
{
    std::vector<std::string> names;
    visit_functions([&](const std::string& name, const std::string&, const std::string&) {
        names.push_back(name);
    });
    return names;
}

std::string exported_fits(const std::string& language)
{
    std::string all = fmt::format(head, fmt::arg("language", language == "osl" ? "OSL" : "GLSL"),
                                  fmt::arg("version", REGAIN_VERSION_STRING));
    visit_functions([&](const std::string&, const std::string& what, const std::string& text) {
        all += "\n// " + what + "\n" + text;
    });
    return all + "\n#endif\n";
}

std::string export_language(const std::filesystem::path& file)
{
    for (const char* language : {"glsl", "osl"})
        if (file.extension() == "." + std::string(language)) return language;
    throw BadInput(
        fmt::format("cannot export to '{}': the file's extension tells the language; "
                    "accepted: .glsl, .osl",
                    file.string()));
}

void export_fits(const std::filesystem::path& file)
{
    const std::string text = exported_fits(export_language(file));
    luts::replace_file(file, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary);
        out << text;
        out.close();
        if (!out) throw std::runtime_error(fmt::format("cannot write '{}'", file.string()));
    });
}

}  // namespace regain::tools
