// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What of a tree of closures is not rendered as asked. Shading goes on and keeps the bits; a host
/// gathers them and says each once.

#pragma once

#include <regain/closures/version.h>

#include <cstdint>

REGAIN_NAMESPACE_BEGIN
namespace osl {

enum Problem : std::uint32_t {
    too_many_bsdfs = 1u << 0,
    too_deep = 1u << 1,
    too_many_nodes = 1u << 2,
    bad_weight = 1u << 3,
    bad_normal = 1u << 4,
    unknown_closure = 1u << 5,
    unknown_distribution = 1u << 6,
    unknown_compensation = 1u << 7,
    no_tables = 1u << 8,
    thin_film = 1u << 9,
    schlick_transmission = 1u << 10,
    subsurface_stand_in = 1u << 11
};
constexpr int problem_kinds = 12;

/// Any of the above together.
using Problems = std::uint32_t;

/// A sentence for a warning, of one bit.
inline const char* message(Problem problem)
{
    switch (problem)
    {
        case too_many_bsdfs:
            return "a surface has more closures than fit; those met last are left out";
        case too_deep: return "layers and sums are in one another too deep; the rest is left out";
        case too_many_nodes: return "a tree of closures has too many nodes; the rest is left out";
        case bad_weight:
            return "a closure has a weight that is negative or no number; it counts as 0";
        case bad_normal:
            return "a closure has a normal of no length, or no number; the surface's is taken";
        case unknown_closure:
            return "a closure has an identifier that nobody knows; it is left out";
        case unknown_distribution:
            return "a closure has a distribution that is unknown or has no tables; another is "
                   "taken";
        case unknown_compensation:
            return "a closure has a compensation that is unknown or has no tables; another is "
                   "taken";
        case no_tables:
            return "a closure is of a kind that no tables are bound for; it is left out";
        case thin_film: return "thin films are not simulated; thinfilm_thickness has no effect";
        case schlick_transmission:
            return "generalized_schlick_bsdf reflects only; transmission_tint has no effect";
        case subsurface_stand_in:
            return "subsurface scattering is shown as diffuse reflection of the same colour";
    }
    return "";
}

}  // namespace osl
REGAIN_NAMESPACE_END
