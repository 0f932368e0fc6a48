// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a walk returns bounce by bounce: the albedo of light that met one facet, two, three ..., on
/// either side of the surface, and the mean number of bounces. Order 1 is single scattering.

#pragma once

#include <regain/closures/microsurface_walk.h>

REGAIN_NAMESPACE_BEGIN

template <class Real>
struct WalkOrders
{
    static constexpr int tracked = 32;

    Albedo<Real> order[tracked];  ///< of k + 1 bounces
    Albedo<Real> rest;            ///< of more than `tracked` bounces
    Real mean_bounces;            ///< of all walks, whatever they weigh

    REGAIN_HOST_DEVICE Albedo<Real> total() const
    {
        Albedo<Real> sum = rest;
        for (const Albedo<Real>& a : order)
        {
            sum.reflect += a.reflect;
            sum.transmit += a.transmit;
        }
        return sum;
    }
};

/// The mean of `walks` walks, 1 to 2^31, of a prepared Walk or DielectricWalk. The standard error
/// of an order that is p of the whole is at most sqrt(p (1 - p) / walks): the numbers of the first
/// bounce are spread evenly. `seed` selects other walks.
template <class Prepared>
REGAIN_HOST_DEVICE auto walk_orders(const Prepared& prepared, int walks, std::uint32_t seed = 0)
{
    using Real = typename std::decay_t<decltype(prepared.wo())>::BaseType;
    using Scalar = ScalarOf<Real>;
    const Color3<Real> none(Real(0));

    const auto add = [](WalkOrders<Real>& to, const WalkOrders<Real>& from, Real scale) {
        const auto each = [scale](Albedo<Real>& a, const Albedo<Real>& b) {
            a.reflect += b.reflect * scale;
            a.transmit += b.transmit * scale;
        };
        for (int k = 0; k < WalkOrders<Real>::tracked; ++k) each(to.order[k], from.order[k]);
        each(to.rest, from.rest);
        to.mean_bounces += from.mean_bounces * scale;
    };
    WalkOrders<Real> zero;
    for (Albedo<Real>& a : zero.order) a = {none, none};
    zero.rest = {none, none};
    zero.mean_bounces = Real(0);

    // Summed in blocks, for what a float adds to a million is rounded, and always alike.
    constexpr int block = 1024;
    const int n = walks < 1 ? 1 : walks;
    RandomStream<Real> stream({detail::constant<Real>(seed * 0x1p-32), Real(0.5f), Real(0.25f)});
    const Vec3<Real> start = stream.next3();
    WalkOrders<Real> result = zero, sum = zero;
    for (int i = 0; i < n; ++i)
    {
        const WalkPath<Real> p = prepared.path(detail::shifted_numbers(start, i));
        const Color3<Real> w = detail::select(p.escaped, p.weight, none);
        const Color3<Real> R = detail::select(p.transmitted, none, w),
                           T = detail::select(p.transmitted, w, none);
        sum.mean_bounces += p.bounces;
        MaskOf<Real> left(true);
        for (int k = 0; k < WalkOrders<Real>::tracked && detail::any<Real>(left); ++k)
        {
            const MaskOf<Real> here =
                detail::both<Real>(left, p.bounces < Real(static_cast<Scalar>(k + 1.5)));
            sum.order[k].reflect += detail::select(here, R, none);
            sum.order[k].transmit += detail::select(here, T, none);
            left = detail::both<Real>(left, !here);
        }
        sum.rest.reflect += detail::select(left, R, none);
        sum.rest.transmit += detail::select(left, T, none);
        if (i % block == block - 1 || i == n - 1)
        {
            add(result, sum, Real(static_cast<Scalar>(1.0 / n)));
            sum = zero;
        }
    }
    return result;
}

REGAIN_NAMESPACE_END
