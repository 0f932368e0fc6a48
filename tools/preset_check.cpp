// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "preset_check.h"

#include "preview/lobe_maker.h"

#include <regain/shaders/presets.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace regain::tools {

using shaders::ColorD;
using shaders::ConductorSurface;
using shaders::DocumentError;
using shaders::DocumentNote;
using shaders::InterfaceSurface;
using shaders::MaterialDocument;
using shaders::MicrofacetMaterial;
using shaders::PlainMaterial;
using shaders::SchlickSurface;
using shaders::VaryingTree;

namespace {

bool is_within(const ColorD& c, double low, double high)
{
    return std::min({c.x, c.y, c.z}) >= low && std::max({c.x, c.y, c.z}) <= high;
}

std::string text(const ColorD& c) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", c.x, c.y, c.z); }

ColorD normal_reflectance(const ConductorSurface& s)
{
    ColorD r;
    for (int c = 0; c < 3; ++c)
    {
        const double n = s.n[c], k = s.k[c];
        r[c] = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
    }
    return r;
}

std::vector<std::string> faults_of(const MicrofacetMaterial& m, bool is_metal)
{
    std::vector<std::string> faults;
    for (const double alpha : {m.alpha_x, m.alpha_y})
        if (!(alpha >= 0 && alpha <= 1))
            faults.push_back(fmt::format("a width of {:.4g} is outside [0, 1]", alpha));
    const auto check = [&](const char* what, const ColorD& c, double low) {
        if (!is_within(c, low, 1))
            faults.push_back(fmt::format("{} {} is outside [{:.4g}, 1]", what, text(c), low));
    };
    if (const auto* s = std::get_if<SchlickSurface>(&m.surface))
    {
        check("the reflectance", s->F0, is_metal ? 0.15 : 0);
        check("the tint at 82 degrees", s->F82, 0);
    }
    if (const auto* s = std::get_if<ConductorSurface>(&m.surface))
        check("the reflectance", normal_reflectance(*s), is_metal ? 0.15 : 0);
    if (const auto* s = std::get_if<InterfaceSurface>(&m.surface))
    {
        if (!(s->eta >= 1 && s->eta <= 3))
            faults.push_back(fmt::format("an index of {:.4g} is outside [1, 3]", s->eta));
        check("the tint of reflection", s->reflection_tint, 0);
        check("the tint of transmission", s->transmission_tint, 0);
    }
    return faults;
}

// Of all closures, as they weigh, of the least cosine on.
void check_energy(const VaryingTree& surface, std::vector<std::string>& faults)
{
    for (const double mu : {0.05, 0.2, 0.4, 0.6, 0.8, 1.0})
    {
        const float z = static_cast<float>(mu), sine = std::sqrt(1 - z * z);
        const preview::SeenPoint seen{{sine, 0, z}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}};
        std::vector<Imath::C3f> albedo(static_cast<std::size_t>(surface.lobes())),
            weight(albedo.size());
        for (int k = 0; k < surface.lobes(); ++k)
        {
            const auto& material = surface.tree.material(k);
            albedo[static_cast<std::size_t>(k)] =
                preview::maker_of(material).albedo(material, 1.0f, seen);
        }
        const ColorD whole(surface.tree.lobe_weights(albedo.data(), weight.data()));
        // What tables and added lobes are wrong by.
        constexpr double most = 1.01;
        if (!is_within(whole, 0, most))
            faults.push_back(
                fmt::format("at the cosine {:.4g} it gives back {} of the light", mu, text(whole)));
    }
}

}  // namespace

std::vector<std::string> preset_faults(const std::string& name,
                                       const shaders::DocumentSettings& settings)
{
    std::vector<std::string> faults;
    try
    {
        const auto document = MaterialDocument::read(shaders::preset_file(name), settings);
        if (document.materials().empty()) faults.emplace_back("it has no material");
        for (const std::string& material : document.materials())
        {
            std::vector<std::string> own;
            for (const char* word : {"doc", "kind", "source"})
                if (document.attribute(material, word).empty())
                    own.push_back(fmt::format("it has no '{}'", word));
            std::vector<DocumentNote> notes;
            VaryingTree surface = document.surface(material, notes);
            for (const DocumentNote& note : notes)
                if (note.text.find("subsurface") == std::string::npos) own.push_back(note.text);
            const bool is_metal = document.attribute(material, "kind") == "metal";
            for (int k = 0; k < surface.lobes(); ++k)
            {
                const auto& one = surface.tree.material(k);
                if (const auto* m = std::get_if<MicrofacetMaterial>(&one))
                    for (std::string& fault : faults_of(*m, is_metal))
                        own.push_back(std::move(fault));
                else
                    std::visit(
                        [&](const auto& s) {
                            if (!is_within(s.color, 0, 1))
                                own.push_back(
                                    fmt::format("the colour {} is outside [0, 1]", text(s.color)));
                        },
                        std::get<PlainMaterial>(one).surface);
            }
            surface.tree.bind_tables(true);
            if (own.empty()) check_energy(surface, own);
            for (const std::string& fault : own) faults.push_back(material + ": " + fault);
        }
    }
    catch (const DocumentError& e)
    {
        faults.emplace_back(e.what());
    }
    return faults;
}

}  // namespace regain::tools
