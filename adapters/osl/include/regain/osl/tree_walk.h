// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Flattens a tree of closures to weighted components, layers included:
///
///     Ci = sum_k w_k f_k,   w_k the product of all weights on the way from the root
///
/// a component's own `w` among them, that of a layer, too; no product is more than 1e6. Below the
/// top of a layer the weight is multiplied by 1 - E_top per channel, E_top being what the top's
/// components reflect and let through towards wo, each by its own weight, compensation included: a
/// compensated top takes from its base what it really keeps, and a white one over a white base
/// returns 1.
///
/// Memory is fixed and trees of any shape end: chains of sums and products take no depth where they
/// go on at closureA, as shaders build them; layers and the other side of sums may be in one
/// another `deepest` deep; `most_nodes` are looked at. What is beyond is left out, and said
/// (problems.h).

#pragma once

#include <regain/closures/number.h>
#include <regain/osl/closure_params.h>
#include <regain/osl/problems.h>

#include <algorithm>

REGAIN_NAMESPACE_BEGIN
namespace osl {

/// leaf(component, weight, asked) makes what it can of a component, which is no layer, whose weight
/// is finite, not negative, and above 0 in a channel; where `asked`, it answers the albedo towards
/// wo of the component without that weight.
template <class Leaf>
class TreeWalk
{
public:
    static constexpr int deepest = 64, most_nodes = 4096;

    explicit TreeWalk(const Leaf& leaf) : _leaf(leaf) {}

    void walk(const ClosureColor* root) { walk(root, Imath::C3f(1.0f), 0, false); }
    Problems problems() const { return _problems; }

private:
    // Answers the energy of the node where `asked`, as if `weight` were 1.
    Imath::C3f walk(const ClosureColor* node, const Imath::C3f& weight, int depth, bool asked)
    {
        Imath::C3f energy(0.0f), factor(1.0f);
        if (depth > deepest)
        {
            if (node) _problems |= too_deep;
            return energy;
        }
        while (node)
        {
            if (weight * factor == Imath::C3f(0.0f)) return energy;
            if (++_nodes > most_nodes)
            {
                _problems |= too_many_nodes;
                return energy;
            }
            if (node->id == ClosureColor::mul)
            {
                const auto& m = *static_cast<const ClosureMul*>(node);
                factor = limited(factor * clean(m.weight));
                node = m.closure;
            }
            else if (node->id == ClosureColor::add)
            {
                const auto& sum = *static_cast<const ClosureAdd*>(node);
                energy += factor * walk(sum.closureB, limited(weight * factor), depth + 1, asked);
                node = sum.closureA;
            }
            else if (node->id < 0)
            {
                _problems |= unknown_closure;
                return energy;
            }
            else
                return energy + component(*static_cast<const ClosureComponent*>(node), weight,
                                          factor, depth, asked);
        }
        return energy;
    }

    Imath::C3f component(const ClosureComponent& c, const Imath::C3f& weight, Imath::C3f factor,
                         int depth, bool asked)
    {
        factor = limited(factor * clean({c.w.x, c.w.y, c.w.z}));
        const Imath::C3f whole = limited(weight * factor);
        if (whole == Imath::C3f(0.0f)) return Imath::C3f(0.0f);
        if (c.id != layer_id) return factor * _leaf(c, whole, asked);

        const auto& layer = c.as<LayerParams>();
        const Imath::C3f top = walk(layer.top, whole, depth + 1, true);
        Imath::C3f rest;
        for (int i = 0; i < 3; ++i) rest[i] = 1 - regain::detail::saturate(top[i]);
        return factor * (top + rest * walk(layer.base, whole * rest, depth + 1, asked));
    }

    static constexpr float most_weight = 1e6f;

    // Of weights that are finite and not negative.
    static Imath::C3f limited(const Imath::C3f& product)
    {
        Imath::C3f c;
        for (int i = 0; i < 3; ++i) c[i] = std::min(product[i], most_weight);
        return c;
    }
    Imath::C3f clean(const Imath::C3f& weight)
    {
        Imath::C3f c;
        for (int i = 0; i < 3; ++i)
        {
            c[i] = regain::detail::sanitised(weight[i], 0, most_weight, 0);
            if (!(weight[i] >= 0)) _problems |= bad_weight;
        }
        return c;
    }

    const Leaf& _leaf;
    Problems _problems = 0;
    int _nodes = 0;
};

}  // namespace osl
REGAIN_NAMESPACE_END
