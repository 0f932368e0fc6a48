// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// MaterialX documents (1.38 and 1.39) as trees of closures:
///
///     const MaterialDocument document = MaterialDocument::read("car.mtlx", settings);
///     for (const std::string& name : document.materials())
///         VaryingTree surface = document.surface(name, notes);
///
/// What is understood: the closures of pbrlib with their numbers, layer, mix, add and multiply;
/// graphs of stdlib's mathematics, colour and picture nodes, the document's own node definitions;
/// the shaders standard_surface, open_pbr_surface, gltf_pbr and UsdPreviewSurface, put together of
/// the same closures. Colours are converted from the space that the document declares to
/// scene_linear, indices of refraction never. Everything else is noted, with what stands in for it.
///
/// Beyond MaterialX, the `distribution` of a closure may be beckmann, gtr or std as well, with an
/// input `gamma`, and a conductor_bsdf may have an input `metal`, one of metals.h: its index is
/// then that of the metal's spectrum in the working space, and `ior` and `extinction` are for
/// others.

#pragma once

#include <regain/shaders/color_config.h>
#include <regain/shaders/export.h>
#include <regain/shaders/texture.h>
#include <regain/shaders/varying_tree.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// What makes a document, or a material of it, useless: "FILE:LINE: what is wrong".
struct REGAIN_SHADERS_API DocumentError : std::runtime_error
{
    using std::runtime_error::runtime_error;
};

/// What is not shown as the document says.
struct DocumentNote
{
    std::string file;
    int line = 0;
    std::string node;  ///< its name, or its category where it has none
    std::string text;  ///< what is not supported, and what was used instead
    /// The override that is no input of any node of the material; empty of all other notes.
    std::string unused = {};

    /// "FILE:LINE: NODE: text".
    REGAIN_SHADERS_API std::string message() const;
};

struct DocumentSettings
{
    explicit DocumentSettings(ColorConfig c) : config(std::move(c)) {}

    ColorConfig config;
    /// Reads pictures; where it is empty, defaults stand in for them, which is noted.
    TextureLoader textures;
    /// Of closures that it goes with; without one, what docs/methods.md recommends for each.
    std::optional<Compensation> method;
    /// Inputs that have another value than the document says: "NODE.INPUT" or, of any node,
    /// "INPUT", and numbers, a word or true and false as a document has them; colours are in
    /// scene_linear. An input that is not there gets it all the same. One that no node asks for is
    /// noted.
    std::vector<std::pair<std::string, std::string>> overrides;
    /// Folders to look for included documents and pictures in, after the document's own.
    std::vector<std::filesystem::path> folders;
};

class REGAIN_SHADERS_API MaterialDocument
{
public:
    /// The file and what it includes. Throws DocumentError: it cannot be read, is no XML or no
    /// MaterialX, includes itself, is larger than 64 MiB or has more than 200,000 elements.
    static MaterialDocument read(const std::filesystem::path& file, const DocumentSettings&);
    /// The same of text; `name` stands for the file in messages, and relative names start there.
    static MaterialDocument parse(const std::string& text, const std::filesystem::path& name,
                                  const DocumentSettings&);

    /// Names of its surface materials, in order; of its surface shaders where it has none, and
    /// where there are none either, of its closures that no other node uses.
    const std::vector<std::string>& materials() const;

    /// An attribute of the material, such as `doc`; empty where it has none. Throws as surface.
    std::string attribute(const std::string& material, const char* name) const;

    /// A material of it; tables are not bound. Adds to `notes` what is not as the document says.
    /// Throws DocumentError: there is no such material, nodes form a cycle, a number is none, there
    /// are more closures or operations than fit.
    VaryingTree surface(const std::string& material, std::vector<DocumentNote>& notes) const;

private:
    struct Impl;
    explicit MaterialDocument(std::shared_ptr<const Impl> impl) : _impl(std::move(impl)) {}
    std::shared_ptr<const Impl> _impl;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
