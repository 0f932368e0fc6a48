// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "document_source.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t(64) << 20, most_elements = 200000;
constexpr int deepest_element = 64;
constexpr std::size_t most_open = 16, most_files = 256;

std::string quoted(const fs::path& file) { return "'" + file.string() + "'"; }

std::string read_whole(const fs::path& file)
{
    std::error_code ec;
    if (fs::is_directory(file, ec)) throw DocumentError(quoted(file) + " is a folder");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw DocumentError("cannot read " + quoted(file) + ": " + std::strerror(errno));
    std::string text;
    char block[1 << 16];
    while (in.read(block, sizeof block) || in.gcount() > 0)
    {
        text.append(block, static_cast<std::size_t>(in.gcount()));
        if (text.size() > most_bytes)
            throw DocumentError(quoted(file) + " is larger than " +
                                std::to_string(most_bytes >> 20) + " MiB");
    }
    return text;
}

bool is_include(const pugi::xml_node& node)
{
    return std::strcmp(node.name(), "xi:include") == 0 || std::strcmp(node.name(), "include") == 0;
}

}  // namespace

std::unique_ptr<DocumentSource> DocumentSource::of_file(const fs::path& file,
                                                        const DocumentSettings& settings)
{
    std::unique_ptr<DocumentSource> source(new DocumentSource(settings));
    std::vector<fs::path> open;
    source->load(file, open);
    source->index();
    return source;
}

std::unique_ptr<DocumentSource> DocumentSource::of_text(const std::string& text,
                                                        const fs::path& name,
                                                        const DocumentSettings& settings)
{
    std::unique_ptr<DocumentSource> source(new DocumentSource(settings));
    std::vector<fs::path> open{name};
    source->add(text, name, open);
    source->index();
    return source;
}

void DocumentSource::load(const fs::path& file, std::vector<fs::path>& open)
{
    std::error_code ec;
    fs::path whole = fs::weakly_canonical(file, ec);
    if (ec) whole = file;
    if (std::find(open.begin(), open.end(), whole) != open.end())
        throw DocumentError(quoted(file) + " includes itself");
    if (open.size() > most_open)
        throw DocumentError(quoted(file) + ": documents include one another more than " +
                            std::to_string(most_open) + " deep");
    // What two documents include is there once.
    for (const File& f : _files)
        if (f.folder / fs::path(f.name).filename() == whole) return;
    open.push_back(whole);
    add(read_whole(file), file, open);
    open.pop_back();
}

void DocumentSource::add(const std::string& text, const fs::path& name, std::vector<fs::path>& open)
{
    if (_files.size() == most_files)
        throw DocumentError(quoted(name) + ": more than " + std::to_string(most_files) +
                            " documents in one");
    _bytes += text.size();
    if (_bytes > most_bytes)
        throw DocumentError(quoted(name) + ": documents of more than " +
                            std::to_string(most_bytes >> 20) + " MiB in all");
    File file;
    file.name = name.string();
    file.folder = open.back().parent_path();
    file.xml = std::make_unique<pugi::xml_document>();
    for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 1))
        file.line_ends.push_back(i);
    const pugi::xml_parse_result parsed = file.xml->load_buffer(text.data(), text.size());
    const auto line_at = [&](std::ptrdiff_t offset) {
        const auto end =
            std::lower_bound(file.line_ends.begin(), file.line_ends.end(),
                             static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
        return std::to_string(end - file.line_ends.begin() + 1);
    };
    if (!parsed)
        throw DocumentError(file.name + ":" + line_at(parsed.offset) +
                            ": this is no XML: " + parsed.description());
    const pugi::xml_node root = file.xml->document_element();
    if (std::strcmp(root.name(), "materialx") != 0)
        throw DocumentError(file.name + ":" + line_at(root.offset_debug()) +
                            ": this is no MaterialX document: its root is <" + root.name() + ">");
    // Before anything goes into it by recursion.
    struct Counter : pugi::xml_tree_walker
    {
        std::size_t count = 0;
        bool too_deep = false;
        bool for_each(pugi::xml_node& node) override
        {
            count += node.type() == pugi::node_element;
            too_deep = too_deep || depth() > deepest_element;
            return !too_deep;
        }
    } counter;
    file.xml->traverse(counter);
    _elements += counter.count;
    if (counter.too_deep)
        throw DocumentError(file.name + ": elements are in one another more than " +
                            std::to_string(deepest_element) + " deep");
    if (_elements > most_elements)
        throw DocumentError(file.name + ": more than " + std::to_string(most_elements) +
                            " elements");

    const std::string version = root.attribute("version").value();
    if (version.empty())
        throw DocumentError(file.name + ":" + line_at(root.offset_debug()) +
                            ": it does not say which version of MaterialX it is; accepted: 1.38 "
                            "and 1.39");
    int major = 0, minor = 0;
    if (std::sscanf(version.c_str(), "%d.%d", &major, &minor) != 2 || major != 1 || minor < 36)
        throw DocumentError(file.name + ":" + line_at(root.offset_debug()) + ": version '" +
                            version + "' of MaterialX is not known; accepted: 1.38 and 1.39");
    file.version = minor;
    const std::string space = root.attribute("namespace").value();
    if (!space.empty()) file.space = space + ":";

    for (const pugi::xml_node& node : root.children())
        if (is_include(node))
        {
            const std::string href = node.attribute("href").value();
            const auto fail = [&](const std::string& what) {
                throw DocumentError(file.name + ":" + line_at(node.offset_debug()) + ": " + what);
            };
            if (href.empty()) fail("an include does not say what it includes");
            std::vector<fs::path> folders{file.folder};
            folders.insert(folders.end(), _folders.begin(), _folders.end());
            const auto there = std::find_if(folders.begin(), folders.end(), [&](const fs::path& f) {
                std::error_code ec;
                return fs::exists(f / href, ec);
            });
            if (there == folders.end()) fail("there is no document '" + href + "' to include");
            load(*there / href, open);
        }
    const int at = static_cast<int>(_files.size());
    _files.push_back(std::move(file));
    for (const pugi::xml_node& node : root.children())
        if (node.type() == pugi::node_element && !is_include(node)) _top.push_back({node, at});
}

void DocumentSource::index()
{
    for (const Element& e : _top)
    {
        if (e.has("name"))
            _by_name.emplace(_files[static_cast<std::size_t>(e.file)].space + e.name(), e);
        if (e.category() == "nodedef") _definitions[e.attribute("node")].push_back(e);
    }
    for (const Element& e : _top)
    {
        if (!e.has("nodedef")) continue;
        if (e.category() == "nodegraph") _graphs.emplace(e.attribute("nodedef"), e);
        if (e.category() != "implementation" || !e.has("nodegraph")) continue;
        if (const Element graph = named(e.attribute("nodegraph"), e))
            _graphs.emplace(e.attribute("nodedef"), graph);
    }
}

const std::vector<Element>& DocumentSource::definitions(const std::string& category) const
{
    static const std::vector<Element> none;
    const auto found = _definitions.find(category);
    return found == _definitions.end() ? none : found->second;
}

Element DocumentSource::graph_of(const Element& definition) const
{
    const auto found = _graphs.find(definition.name());
    return found == _graphs.end() ? Element() : found->second;
}

Element DocumentSource::named(const std::string& name, const Element& from) const
{
    const auto own = _by_name.find(_files[static_cast<std::size_t>(from.file)].space + name);
    if (own != _by_name.end()) return own->second;
    const auto any = _by_name.find(name);
    return any != _by_name.end() ? any->second : Element();
}

Element DocumentSource::child_named(const Element& graph, const std::string& name) const
{
    const auto [at, is_new] = _children.try_emplace(graph.xml.hash_value());
    if (is_new)
        for (const pugi::xml_node& child : graph.xml.children())
            at->second.emplace(child.attribute("name").value(), child);
    const auto found = at->second.find(name);
    return found == at->second.end() ? Element() : Element{found->second, graph.file};
}

Element DocumentSource::input(const Element& node, const std::string& name)
{
    for (const pugi::xml_node& child : node.xml.children())
    {
        const char* kind = child.name();
        if (std::strcmp(kind, "input") != 0 && std::strcmp(kind, "parameter") != 0) continue;
        if (name == child.attribute("name").value()) return {child, node.file};
    }
    return {};
}

Element DocumentSource::parent(const Element& e) const { return {e.xml.parent(), e.file}; }

std::string DocumentSource::inherited(const Element& e, const char* attribute)
{
    for (pugi::xml_node node = e.xml; node; node = node.parent())
        if (const auto a = node.attribute(attribute)) return a.value();
    return {};
}

std::string DocumentSource::prefixes(const Element& e, const char* attribute)
{
    std::string all;
    for (pugi::xml_node node = e.xml; node; node = node.parent())
        all = node.attribute(attribute).value() + all;
    return all;
}

fs::path DocumentSource::resolved(const std::string& file, const Element& from) const
{
    if (fs::path(file).is_absolute()) return file;
    const fs::path own = _files[static_cast<std::size_t>(from.file)].folder / file;
    std::error_code ec;
    if (fs::exists(own, ec)) return own;
    for (const fs::path& folder : _folders)
        if (fs::exists(folder / file, ec)) return folder / file;
    return own;
}

int DocumentSource::line(const Element& e) const
{
    const File& f = _files[static_cast<std::size_t>(e.file)];
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(e.xml.offset_debug(), 0));
    return static_cast<int>(std::lower_bound(f.line_ends.begin(), f.line_ends.end(), offset) -
                            f.line_ends.begin()) +
           1;
}

std::string DocumentSource::place(const Element& e) const
{
    return file_name(e) + ":" + std::to_string(line(e));
}

void DocumentSource::fail(const Element& e, const std::string& what) const
{
    throw DocumentError(place(e) + ": " + (e.has("name") ? e.name() + ": " : "") + what);
}

}  // namespace shaders
REGAIN_NAMESPACE_END
