// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A tree of closures some of whose numbers depend on where the surface is shaded, as textures make
/// them:
///
///     V4f values[VaryingTree::most_values];
///     surface.values_at(point, values);                    // once a point
///     for k: surface.material(k, values).with_closure(...)  // closure k there
///     surface.lobe_weights(albedo, weight, values);
///
/// What the tree is made of does not depend on the point, and tables are bound once. A tree of
/// constants does not vary: it is shaded as a ClosureTree, by which nothing is looked up.

#pragma once

#include <regain/shaders/closure_tree.h>
#include <regain/shaders/value_program.h>

#include <cstdint>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// A number of a material that may vary. Which of them a material has, its surface says.
enum class MaterialNumber {
    alpha,  ///< two of them
    F0,
    F82,
    F90,
    exponent,
    n,
    k,
    eta,
    reflection_tint,
    transmission_tint,
    color,
    roughness
};

class VaryingTree
{
public:
    using Material = ClosureTree::Material;
    static constexpr int most_values = 96;

    /// Lobes are given by their constants, and set_root is called last.
    ClosureTree tree;
    ValueProgram program;

    /// That number of the lobe is the value's wherever it varies; alphas are isotropic where one
    /// component is meant. Throws std::length_error beyond most_values.
    REGAIN_SHADERS_API void vary(ClosureTree::Node lobe, MaterialNumber, const Value&);
    /// A weight for ClosureTree::multiply or an amount for mix.
    REGAIN_SHADERS_API ClosureTree::Parameter parameter(const Value&);
    /// Of the surface; one that does not vary goes to the tree.
    REGAIN_SHADERS_API void set_presence(const Value&);

    /// Cuts the unit square of texture coordinates into across x across tiles: where
    /// floor(across u) + across floor(across v) is i, closures are those of trees[tree_of[i]], and
    /// beyond the square those of `tree`; a coordinate that is no number counts as 0. The trees differ from it in methods of compensation and
    /// tables alone. Throws std::invalid_argument where a tile has no tree or a tree not its
    /// closures, std::length_error beyond most_values.
    REGAIN_SHADERS_API void set_tiles(int across, std::vector<std::uint8_t> tree_of,
                                      std::vector<ClosureTree> trees);
    const std::vector<ClosureTree>& trees_of_tiles() const { return _trees; }

    bool varies() const { return program.varies(); }
    bool has_varying_presence() const { return _presence >= 0; }
    /// Some of it may not be there.
    bool is_all_there() const { return _presence < 0 && tree.presence() >= 1; }

    int values() const { return program.outputs(); }
    void values_at(const SurfacePoint& point, Imath::V4f* values) const
    {
        program.run(point, values);
    }

    int lobes() const { return tree.lobes(); }
    const char* lobe_name(int k) const { return tree.lobe_name(k); }
    /// Closure k where values_at was asked; its tables are bound if those of the tree are.
    REGAIN_SHADERS_API Material material(int k, const Imath::V4f* values) const;
    /// As ClosureTree's.
    REGAIN_SHADERS_API Imath::C3f lobe_weights(const Imath::C3f* albedo, Imath::C3f* weight,
                                               const Imath::V4f* values) const;
    REGAIN_SHADERS_API double presence(const Imath::V4f* values) const;
    /// A parameter of the tree.
    REGAIN_SHADERS_API Imath::C3f weight(int parameter, const Imath::V4f* values) const;
    /// A lobe of the tree by its node.
    REGAIN_SHADERS_API Material material_of(ClosureTree::Node, const Imath::V4f* values) const;

private:
    struct Varied
    {
        ClosureTree::Node lobe;
        MaterialNumber number;
        int value;
    };
    void apply(ClosureTree::Node, Material&, const Imath::V4f* values) const;
    const ClosureTree& tree_at(const Imath::V4f* values) const;
    int add(const Value&);

    std::vector<Varied> _varied;
    std::vector<int> _parameters;  // values
    int _presence = -1;
    int _across = 0, _texcoord = -1;  // of tiles; a value
    std::vector<std::uint8_t> _tree_of;
    std::vector<ClosureTree> _trees;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
