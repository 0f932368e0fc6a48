// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/document.h>

#include "graph_closures.h"

#include <set>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

std::string DocumentNote::message() const
{
    return file + ":" + std::to_string(line) + ": " + node + ": " + text;
}

struct MaterialDocument::Impl
{
    std::unique_ptr<DocumentSource> source;
    DocumentSettings settings;
    std::vector<std::string> names;
    std::map<std::string, Element> materials;

    Impl(std::unique_ptr<DocumentSource> from, const DocumentSettings& s)
        : source(std::move(from)), settings(s)
    {
        collect([](const Element& e) { return e.category() == "surfacematerial"; });
        if (names.empty())
            collect([](const Element& e) { return e.attribute("type") == "surfaceshader"; });
        if (!names.empty()) return;
        std::set<std::string> used;
        for (const Element& e : source->top())
            for (const pugi::xml_node& child : e.xml.children())
                used.insert(child.attribute("nodename").value());
        collect([&](const Element& e) {
            return e.attribute("type") == "BSDF" && e.category() != "nodedef" &&
                   e.category() != "output" && used.count(e.name()) == 0;
        });
        for (const Element& e : source->top())
            if (names.empty() && e.category() == "material")
                source->fail(e,
                             "materials as before MaterialX 1.38, with shaderref, are not read; "
                             "accepted: surfacematerial");
    }

    template <class Wanted>
    void collect(const Wanted& wanted)
    {
        for (const Element& e : source->top())
            if (wanted(e) && e.has("name") && materials.emplace(e.name(), e).second)
                names.push_back(e.name());
    }
    const Element& material(const std::string& name) const
    {
        const auto found = materials.find(name);
        if (found != materials.end()) return found->second;
        std::string known;
        for (const std::string& n : names) known += (known.empty() ? "" : ", ") + n;
        throw DocumentError("there is no material '" + name + "'" +
                            (known.empty() ? ", nor any other" : "; accepted: " + known));
    }
};

MaterialDocument MaterialDocument::read(const std::filesystem::path& file,
                                        const DocumentSettings& settings)
{
    return MaterialDocument(
        std::make_shared<const Impl>(DocumentSource::of_file(file, settings), settings));
}

MaterialDocument MaterialDocument::parse(const std::string& text, const std::filesystem::path& name,
                                         const DocumentSettings& settings)
{
    return MaterialDocument(
        std::make_shared<const Impl>(DocumentSource::of_text(text, name, settings), settings));
}

const std::vector<std::string>& MaterialDocument::materials() const { return _impl->names; }

std::string MaterialDocument::attribute(const std::string& material, const char* name) const
{
    return _impl->material(material).attribute(name);
}

VaryingTree MaterialDocument::surface(const std::string& material,
                                      std::vector<DocumentNote>& notes) const
{
    const Element& e = _impl->material(material);
    VaryingTree surface;
    try
    {
        GraphValues values(*_impl->source, _impl->settings, surface.program, notes);
        ClosureBuilder builder(surface, values, _impl->settings.method);
        const ShadedSurface made = GraphClosures(values, builder).surface(e);
        values.note_unused_overrides(e);
        auto root = made.closure;
        if (root == ClosureBuilder::nothing)
            root = surface.tree.lobe(PlainMaterial{OrenNayarSurface{ColorD(0.0)}});
        surface.set_presence(made.presence);
        surface.tree.set_root(root);
    }
    catch (const std::length_error& error)
    {
        _impl->source->fail(e, error.what());
    }
    catch (const std::invalid_argument& error)
    {
        _impl->source->fail(e, error.what());
    }
    return surface;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
