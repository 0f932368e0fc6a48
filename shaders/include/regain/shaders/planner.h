// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Accuracy bought where a scene calls for it. When a scene is loaded,
///
///     ScenePlan plan = plan_scene({{"car", car}, {"floor", floor}}, {0.01});
///     for (const MaterialPlan& m : plan.materials) use(m.surface);    // its tables are bound
///
/// finds for each material the closures and methods of compensation that cost least among those
/// whose predicted error is within the tolerance. An error is that of the directional albedo, of
/// reflection and transmission each, in any channel, along any direction with a cosine of at least
/// 0.05 that is seen; the reference is the random walk. docs/planner.md says what is predicted from
/// what.
///
/// What nothing calls for is not there: closures of weight 0, compensation that changes less than
/// the tolerance, tables that no closure reads. At a tolerance of 0 a plan is the reference: the
/// walk where it goes, elsewhere the method of least error.
///
/// Numbers that vary are planned over their range: over the unit square of texture coordinates, and
/// where that saves a twentieth of the price, tile by tile.

#pragma once

#include <regain/shaders/method_costs.h>
#include <regain/shaders/varying_tree.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

struct PlannerSettings
{
    double tolerance = 0.01;             ///< in [0, 1]
    const MethodCosts* costs = nullptr;  ///< null: those that are compiled in
};

struct NamedMaterial
{
    std::string name;
    VaryingTree surface;
};

/// What a closure, or a material by its closures, calls for.
struct CalledFor
{
    bool transmission = false;
    bool tint = false;                 ///< channels differ
    bool anisotropy = false;           ///< two widths
    bool tail = false;                 ///< of a distribution other than GGX and Beckmann
    bool multiple_scattering = false;  ///< without it the error would be beyond the tolerance
    bool layering = false;             ///< one closure is on another
    bool inside = false;               ///< can be seen from inside, not only from outside

    /// Their names, in this order.
    REGAIN_SHADERS_API std::vector<std::string> names() const;
};

struct PlannedLobe
{
    ClosureTree::Node node = -1;
    std::string name;     ///< for light path expressions
    std::string closure;  ///< MaterialX's name
    std::string distribution, method;
    bool left_out = false;
    CalledFor called_for;
    /// Within the material: times the largest weight that it can have. Empty where nothing near it
    /// was measured.
    std::optional<double> error, error_without;
    /// Over those of a white GGX mirror without compensation; 0 of what has no microfacets, which
    /// is the same in all plans.
    double eval = 0, sample = 0;
    std::string why;
};

/// A table that stays in memory.
struct PlannedTable
{
    std::string name;
    std::size_t bytes = 0;
    bool compiled_in = false;  ///< it is not loaded from a file
};

/// What was chosen for each tile of the unit square of texture coordinates; VaryingTree::set_tiles
/// says which they are. Beyond the square, methods are those of MaterialPlan::lobes.
struct PlannedTiles
{
    int across = 0;                                 ///< 0: one plan for all
    std::vector<std::size_t> choice_of;             ///< of each tile
    std::vector<std::vector<std::string>> choices;  ///< methods, by lobe; empty of those left out
    double error = 0, eval = 0, sample = 0;         ///< the worst; means
    double price_of_one = 0;                        ///< of one plan for all

    /// Tiles of that choice.
    REGAIN_SHADERS_API std::size_t count(std::size_t choice) const;
};

struct MaterialPlan
{
    std::string name;
    VaryingTree surface;  ///< as planned, its tables bound
    CalledFor called_for;
    std::vector<PlannedLobe> lobes;
    PlannedTiles tiles;
    double error = 0;       ///< predicted, of the closures that have an error
    bool is_known = true;   ///< they all have
    bool is_within = true;  ///< the tolerance; false, too, where it is not known
    double eval = 0, sample = 0;
    std::vector<PlannedTable> tables;
    std::vector<std::string> notes;  ///< what a plan does not know, or had to change

    double price() const { return eval + sample; }
};

struct ScenePlan
{
    std::vector<MaterialPlan> materials;
    std::vector<PlannedTable> tables;  ///< of all of them, each once
    std::vector<std::string> notes;

    REGAIN_SHADERS_API std::size_t loaded_bytes() const;
    REGAIN_SHADERS_API std::size_t compiled_in_bytes() const;
};

/// Materials that were put together, with or without tables. Throws std::invalid_argument for a
/// tolerance that is none, std::runtime_error where a table that is called for is missing.
REGAIN_SHADERS_API ScenePlan plan_scene(const std::vector<NamedMaterial>&,
                                        const PlannerSettings& = {});

}  // namespace shaders
REGAIN_NAMESPACE_END
