// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What stands in for a compiled OSL shader: it writes a tree of closures into Ci, the one that a
/// material is made of. And the renderer's side of the same material: its closures' tables.

#pragma once

#include <regain/osl/closure_library.h>

namespace regain::tools::preview {

class OslShader
{
public:
    /// The tables of the material's closures are bound; throws as bind_tables.
    explicit OslShader(const shaders::ClosureTree&);

    /// Ci at a point. Null is black.
    const osl::ClosureColor* shade(const osl::ShaderGlobals&, osl::NodePool&) const;

    /// Ci as what a renderer samples, at the end of what `composite` has.
    osl::Problems flatten(const osl::ClosureColor* Ci, const osl::ShaderGlobals&,
                          osl::CompositeBsdf& composite) const;

    /// Some light goes straight on.
    bool lets_by() const { return _lets_by; }

private:
    shaders::ClosureTree _tree;
    bool _lets_by = false;
    osl::ClosureLibrary _library{osl::ClosureLibrary::Empty{}};
};

}  // namespace regain::tools::preview
