// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The XML of a document and of all that it includes, by names.

#pragma once

#include <regain/shaders/document.h>

#include <pugixml.hpp>

#include <map>
#include <unordered_map>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// An element, and which file it is in.
struct Element
{
    pugi::xml_node xml;
    int file = -1;

    explicit operator bool() const { return static_cast<bool>(xml); }
    std::string name() const { return xml.attribute("name").value(); }
    /// <CATEGORY ...>, or the other way to write it, <node nodetype="CATEGORY" ...>.
    std::string category() const
    {
        const pugi::xml_attribute type = xml.attribute("nodetype");
        return type && std::string(xml.name()) == "node" ? type.value() : xml.name();
    }
    std::string attribute(const char* which) const { return xml.attribute(which).value(); }
    bool has(const char* attribute) const { return !xml.attribute(attribute).empty(); }
};

class DocumentSource
{
public:
    static std::unique_ptr<DocumentSource> of_file(const std::filesystem::path&,
                                                   const DocumentSettings&);
    static std::unique_ptr<DocumentSource> of_text(const std::string&,
                                                   const std::filesystem::path& name,
                                                   const DocumentSettings&);

    /// Elements at the top of all files, in order; those that are included come before.
    const std::vector<Element>& top() const { return _top; }
    /// One of them by its name, as `from` calls it; none where there is none.
    Element named(const std::string& name, const Element& from) const;
    /// The document's own definitions of a category of nodes, in order.
    const std::vector<Element>& definitions(const std::string& category) const;
    /// The graph that does what a definition says; none where there is none.
    Element graph_of(const Element& definition) const;
    /// A child of a graph by its name.
    Element child_named(const Element& graph, const std::string& name) const;
    /// The input of a node; none where it is not given.
    static Element input(const Element& node, const std::string& name);
    Element parent(const Element&) const;
    bool is_at_top(const Element& e) const { return is_root(parent(e)); }
    static bool is_root(const Element& e) { return e.category() == "materialx"; }

    /// An attribute that holds for all that is inside: the nearest one up to the root.
    static std::string inherited(const Element&, const char* attribute);
    /// All of them, the outermost first, one after the other.
    static std::string prefixes(const Element&, const char* attribute);
    /// Minor version of MaterialX 1 that the file is written in.
    int version(const Element& e) const { return _files[static_cast<std::size_t>(e.file)].version; }

    /// Where pictures of that name are to be looked for.
    std::filesystem::path resolved(const std::string& file, const Element& from) const;

    int line(const Element&) const;
    std::string place(const Element&) const;  ///< "FILE:LINE"
    const std::string& file_name(const Element& e) const
    {
        return _files[static_cast<std::size_t>(e.file)].name;
    }
    [[noreturn]] void fail(const Element&, const std::string& what) const;

private:
    struct File
    {
        std::string name;
        std::filesystem::path folder;
        std::unique_ptr<pugi::xml_document> xml;
        std::vector<std::size_t> line_ends;
        std::string space;  // the namespace of what it defines, with its colon
        int version = 39;
    };

    explicit DocumentSource(const DocumentSettings& settings) : _folders(settings.folders) {}
    void load(const std::filesystem::path&, std::vector<std::filesystem::path>& open);
    void add(const std::string& text, const std::filesystem::path& name,
             std::vector<std::filesystem::path>& open);
    void index();

    std::vector<std::filesystem::path> _folders;
    std::vector<File> _files;
    std::vector<Element> _top;
    std::map<std::string, Element> _by_name;
    std::map<std::string, std::vector<Element>> _definitions;  // by category
    std::map<std::string, Element> _graphs;                    // by the name of the definition
    mutable std::unordered_map<std::size_t, std::unordered_map<std::string, pugi::xml_node>>
        _children;
    std::size_t _bytes = 0, _elements = 0;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
