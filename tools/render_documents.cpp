// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "render_documents.h"

#include "errors.h"
#include "render_checks.h"
#include "texture_file.h"

#include <regain/shaders/document.h>
#include <regain/shaders/presets.h>

#include <algorithm>
#include <set>

namespace regain::tools {

using shaders::DocumentError;
using shaders::DocumentNote;
using shaders::DocumentSettings;
using shaders::MaterialDocument;
using shaders::VaryingTree;

namespace {

bool lets_through(const VaryingTree& surface)
{
    if (!surface.is_all_there()) return true;
    for (int k = 0; k < surface.lobes(); ++k)
    {
        const auto& material = surface.tree.material(k);
        if (const auto* m = std::get_if<shaders::MicrofacetMaterial>(&material))
        {
            const auto* i = std::get_if<shaders::InterfaceSurface>(&m->surface);
            if (i && i->mode != ScatterMode::R) return true;
            continue;
        }
        const auto& plain = std::get<shaders::PlainMaterial>(material).surface;
        if (std::holds_alternative<shaders::TranslucentSurface>(plain) ||
            std::holds_alternative<shaders::TransparentSurface>(plain))
            return true;
    }
    return false;
}

}  // namespace

RenderDocuments::RenderDocuments(const RenderOptions& options, const shaders::ColorConfig& config)
    : _method(options.method), _columns(static_cast<int>(options.columns))
{
    check_count("--columns", options.columns, 1, 16);
    if (!options.method.empty() && !shaders::compensation_named(options.method))
        refuse("--method", options.method,
               fmt::format("no such method; there are {}",
                           fmt::join(shaders::compensation_names(), ", ")));
    const TextureFiles textures(config);
    for (const std::string& one : options.documents) add(one, options, config, textures.loader());
    for (const std::string& wanted : options.selected)
        if (std::none_of(_surfaces.begin(), _surfaces.end(),
                         [&](const Surface& s) { return s.name == wanted; }))
            refuse("--select", wanted, "no document has a material of that name");
    if (_surfaces.empty()) throw BadInput("the documents have no material");
    if (static_cast<int>(_surfaces.size()) > most_objects)
        throw BadInput(fmt::format("{} materials: at most {} are shown; --select NAME chooses",
                                   _surfaces.size(), most_objects));
}

void RenderDocuments::add(const std::string& given, const RenderOptions& options,
                          const shaders::ColorConfig& config,
                          const shaders::TextureLoader& textures)
{
    DocumentSettings settings(config);
    settings.textures = textures;
    settings.folders = shaders::preset_folders();
    if (!options.method.empty()) settings.method = shaders::compensation_named(options.method);
    try
    {
        const auto document = MaterialDocument::read(shaders::document_or_preset(given), settings);
        std::vector<DocumentNote> notes;
        for (const std::string& name : document.materials())
        {
            if (!options.selected.empty() &&
                std::find(options.selected.begin(), options.selected.end(), name) ==
                    options.selected.end())
                continue;
            Surface s{name, document.surface(name, notes)};
            s.tree.tree.bind_tables();
            _is_transparent = _is_transparent || lets_through(s.tree);
            _surfaces.push_back(std::move(s));
        }
        std::set<std::string> said;
        for (const DocumentNote& note : notes)
            if (said.insert(note.message()).second)
                fmt::print(stderr, "regain: {}\n", note.message());
    }
    catch (const DocumentError& e)
    {
        throw BadInput(e.what());
    }
    _given.push_back(given);
}

int RenderDocuments::rows() const
{
    return (static_cast<int>(_surfaces.size()) + _columns - 1) / _columns;
}

// Rows are as even as they can be.
int RenderDocuments::objects(int row) const
{
    const int n = static_cast<int>(_surfaces.size());
    return n * (row + 1) / rows() - n * row / rows();
}

std::vector<std::unique_ptr<preview::BoundMaterial>> RenderDocuments::bind(int row) const
{
    const int n = static_cast<int>(_surfaces.size()), first = n * row / rows();
    std::vector<std::unique_ptr<preview::BoundMaterial>> all;
    for (int i = 0; i < objects(row); ++i)
        all.push_back(preview::bind(_surfaces[static_cast<std::size_t>(first + i)].tree));
    return all;
}

std::vector<std::string> RenderDocuments::names(int row) const
{
    const int first = static_cast<int>(_surfaces.size()) * row / rows();
    std::vector<std::string> all;
    for (int i = 0; i < objects(row); ++i)
    {
        std::string name = _surfaces[static_cast<std::size_t>(first + i)].name;
        std::replace(name.begin(), name.end(), '_', ' ');
        all.push_back(std::move(name));
    }
    return all;
}

void RenderDocuments::describe(Metadata& metadata) const
{
    auto& e = metadata.entries;
    e.emplace_back("documents", fmt::format("{}", fmt::join(_given, ", ")));
    std::vector<std::string> names;
    for (const Surface& s : _surfaces) names.push_back(s.name);
    e.emplace_back("materials", fmt::format("{}", fmt::join(names, ", ")));
    e.emplace_back("method", _method.empty() ? "recommended" : _method);
}

}  // namespace regain::tools
