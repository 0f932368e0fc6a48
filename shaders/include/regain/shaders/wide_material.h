// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material's closure at many shading points, by the widest vectors of floats that the machine
/// has:
///
///     const WideMaker* wide = wide_maker(material);              // null: there are none
///     WidePoints* points = wide->prepare(material, 1.0f, n, {wo}, memory);
///
/// The instruction set is chosen once, when the first of them is asked for, among those that were
/// built and that the processor has. The environment variable REGAIN_INSTRUCTION_SET names another:
/// scalar, sse4.2, avx2, avx512 or neon.

#pragma once

#include <regain/closures/wide_points.h>
#include <regain/shaders/closure_tree.h>

#include <optional>
#include <string_view>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// Sets of vector instructions; scalar: none of them, and no wide closures.
enum class InstructionSet { scalar, sse4_2, avx2, avx512, neon };

REGAIN_SHADERS_API std::string_view name(InstructionSet);
REGAIN_SHADERS_API std::optional<InstructionSet> instruction_set_named(std::string_view);

/// Those that were built and that this processor has, the widest last; the first is scalar.
REGAIN_SHADERS_API const std::vector<InstructionSet>& instruction_sets();

/// The widest of them; or what REGAIN_INSTRUCTION_SET says, if it is one of them.
REGAIN_SHADERS_API InstructionSet preferred_instruction_set();

/// Makes WidePoints of the materials of one kind.
struct WideMaker
{
    using Material = ClosureTree::Material;

    int lanes;  ///< points that are computed together

    /// n points, at a strength of the compensation. Null where memory is spent. What the tables
    /// are bound to outlives the result.
    WidePoints* (*prepare)(const Material&, float strength, int n, const WideSurface&,
                           const WideMemory&);
};

/// For the material as it is now, its tables bound; null where the instruction set is scalar or not
/// to be had, and of GTR and STD by SSE4.2. With AVX-512 these take AVX2.
REGAIN_SHADERS_API const WideMaker* wide_maker(const ClosureTree::Material&,
                                               InstructionSet = preferred_instruction_set());

}  // namespace shaders
REGAIN_NAMESPACE_END
