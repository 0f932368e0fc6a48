// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A shader as the integrator knows it: it writes a tree of closures into Ci, and the renderer
/// makes of that what it samples.

#pragma once

#include <regain/osl/closure_library.h>
#include <regain/shaders/varying_tree.h>

namespace regain::tools::preview {

class OslShader
{
public:
    explicit OslShader(osl::ClosureLibrary library) : _library(std::move(library)) {}
    virtual ~OslShader() = default;

    /// Ci at a point. Null is black.
    virtual const osl::ClosureColor* shade(const osl::ShaderGlobals&, osl::NodePool&) const = 0;
    /// Some light goes straight on.
    virtual bool lets_by() const = 0;

    /// Ci as what a renderer samples, at the end of what `composite` has.
    osl::Problems flatten(const osl::ClosureColor* Ci, const osl::ShaderGlobals&,
                          osl::CompositeBsdf& composite) const;

private:
    osl::ClosureLibrary _library;
};

/// What stands in for a compiled shader: it describes a material by the closures that it is made
/// of.
class TreeShader final : public OslShader
{
public:
    /// The tables of the material's closures are bound; throws as bind_tables.
    explicit TreeShader(const shaders::VaryingTree&);
    explicit TreeShader(const shaders::ClosureTree& tree) : TreeShader(as_varying(tree)) {}

    const osl::ClosureColor* shade(const osl::ShaderGlobals&, osl::NodePool&) const override;
    bool lets_by() const override { return _lets_by; }

private:
    static shaders::VaryingTree as_varying(const shaders::ClosureTree& tree)
    {
        shaders::VaryingTree varying;
        varying.tree = tree;
        return varying;
    }

    shaders::VaryingTree _tree;
    bool _lets_by = false;
};

}  // namespace regain::tools::preview
