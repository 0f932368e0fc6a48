// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The MaterialX documents and presets that `regain render` is given: every material of every
/// document is one object, in rows of so many columns; for every method anew, and with a wedge one
/// row of a material each.

#pragma once

#include "picture.h"
#include "preview/bound_material.h"
#include "render_options.h"

#include <regain/shaders/color_config.h>
#include <regain/shaders/method_costs.h>
#include <regain/shaders/varying_tree.h>

#include <memory>
#include <optional>
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

    bool empty() const { return _rows.empty(); }
    int rows() const { return static_cast<int>(_rows.size()); }
    /// Objects of a row, 0 the top.
    int objects(int row) const
    {
        return static_cast<int>(_rows[static_cast<std::size_t>(row)].size());
    }
    /// Of some, light comes out on the other side.
    bool is_transparent() const { return _is_transparent; }
    std::vector<std::unique_ptr<preview::BoundMaterial>> bind(int row) const;
    std::vector<std::string> names(int row) const;

    /// Adds what is shown.
    void describe(Metadata&) const;

private:
    struct Surface
    {
        std::string label;
        shaders::VaryingTree tree;
    };
    using Row = std::vector<Surface>;
    void arrange(Row, bool apart, int columns);
    void plan(Surface&, const shaders::MethodCosts&);

    std::vector<Row> _rows;
    std::vector<std::string> _given, _names;
    std::string _method, _set, _wedge;
    std::optional<double> _tolerance;
    std::vector<std::string> _planned;  // of each object what was chosen
    bool _is_transparent = false;
};

}  // namespace regain::tools
