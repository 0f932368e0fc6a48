// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The MaterialX documents and presets that `regain render` is given: every material of every
/// document is one object.

#pragma once

#include "picture.h"
#include "preview/bound_material.h"
#include "render_options.h"

#include <regain/shaders/color_config.h>
#include <regain/shaders/varying_tree.h>

#include <memory>
#include <string>
#include <vector>

namespace regain::tools {

class RenderDocuments
{
public:
    static constexpr int most_objects = 256;

    /// None.
    RenderDocuments() = default;

    /// Throws BadInput: a document is wrong or not there, there are options that do not go with
    /// documents, a selected material is in none of them. What is not rendered as a document says
    /// is told on standard error.
    RenderDocuments(const RenderOptions&, const shaders::ColorConfig&);

    bool empty() const { return _surfaces.empty(); }
    int rows() const;
    /// Objects of a row, 0 the top.
    int objects(int row) const;
    /// Of some, light comes out on the other side.
    bool is_transparent() const { return _is_transparent; }
    std::vector<std::unique_ptr<preview::BoundMaterial>> bind(int row) const;
    std::vector<std::string> names(int row) const;

    /// Adds what is shown.
    void describe(Metadata&) const;

private:
    struct Surface
    {
        std::string name;
        shaders::VaryingTree tree;
    };
    void add(const std::string& file_or_preset, const RenderOptions&, const shaders::ColorConfig&,
             const shaders::TextureLoader&);

    std::vector<Surface> _surfaces;
    std::vector<std::string> _given;
    std::string _method;
    int _columns = 6;
    bool _is_transparent = false;
};

}  // namespace regain::tools
