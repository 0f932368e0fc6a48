// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What the objects of `regain render` are made of: the options that say so, checked one by one and
/// against each other.

#pragma once

#include "picture.h"
#include "preview/bound_material.h"
#include "render_options.h"

#include <regain/shaders/color_config.h>

#include <memory>
#include <vector>

namespace regain::tools {

class RenderMaterial
{
public:
    /// Throws BadInput. A metal whose colour had to be limited is told on standard error.
    RenderMaterial(const RenderOptions&, const shaders::ColorConfig&);

    /// One a row, top first: the one asked for, or what the material is best shown by.
    const std::vector<shaders::Compensation>& methods() const { return _methods; }

    bool is_glass() const { return _material.is_interface(); }

    /// In the row: one for each alpha, or weight of sheen.
    int objects() const { return static_cast<int>(_varied.size()); }
    /// From left to right, with their tables.
    std::vector<std::unique_ptr<preview::BoundMaterial>> bind(const shaders::Compensation&) const;

    /// What differs, in words: "0.4".
    std::vector<std::string> names() const;

    /// Adds what the materials are.
    void describe(Metadata&) const;

private:
    void read_metal(const RenderOptions&, const shaders::ColorConfig&);
    void read_glass(const RenderOptions&);
    void read_sheen(const RenderOptions&);
    void read_facets(const RenderOptions&);
    void check_methods() const;

    std::string _name, _metal;
    std::vector<shaders::Compensation> _methods;
    shaders::MicrofacetMaterial _material;  // but for method and what is varied
    std::vector<double> _varied;            // alphas, or weights of sheen
    double _alpha_ratio = 1, _base = 0;
};

}  // namespace regain::tools
