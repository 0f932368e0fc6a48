// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Tables of more axes than three, as the closures see them: a view of numbers that somebody else
/// owns. Look-ups are linear along every axis; nodes stand at both ends of each. What TableView is
/// to the albedos of isotropic lobes this is to what anisotropy changes of them, over two
/// coordinates of a direction, two widths and a gamma or an index.
///
/// A look-up reads 2^Axes numbers.

#pragma once

#include <regain/closures/number.h>

REGAIN_NAMESPACE_BEGIN

/// A table of 16-bit numbers over `Axes` axes of size[0] to size[Axes - 1] nodes, the first fastest
/// and of at least 2. Along an axis of one node the value is the same, and costs nothing. A value
/// is offset + scale * stored. The default is no table.
template <int Axes>
struct GridView
{
    static_assert(Axes >= 1);

    const std::uint16_t* data = nullptr;
    int size[Axes] = {};
    float offset = 0, scale = 1.0f / 65535;

    REGAIN_HOST_DEVICE explicit operator bool() const { return data != nullptr; }

    /// Value at coordinates that are limited to [0, 1], a NaN to 0; the table is not empty.
    template <class Real>
    REGAIN_HOST_DEVICE Real at(const Real (&x)[Axes]) const
    {
        using Number = NumberTraits<Real>;
        IndexOf<Real> low[Axes];
        Real fraction[Axes];
        for (int axis = 0; axis < Axes; ++axis)
        {
            const int cells = size[axis] - 1;
            const Real place = detail::saturate(x[axis]) * Real(static_cast<ScalarOf<Real>>(cells));
            low[axis] = Number::at_most(Number::truncate(place), cells > 0 ? cells - 1 : 0);
            fraction[axis] = place - Number::to_real(low[axis]);
        }
        const Real stored = blend<Axes - 1, Real>(low, fraction, low[Axes - 1]);
        return detail::constant<Real>(offset) + detail::constant<Real>(scale) * stored;
    }

private:
    // Over the axes up to Axis, at the node `outer` of it and all that are slower.
    template <int Axis, class Real>
    REGAIN_HOST_DEVICE Real blend(const IndexOf<Real> (&low)[Axes], const Real (&fraction)[Axes],
                                  const IndexOf<Real>& outer) const
    {
        Real a, b;
        if constexpr (Axis == 0)
        {
            NumberTraits<Real>::gather_pair(data, outer, a, b);
        }
        else
        {
            a = blend<Axis - 1>(low, fraction, outer * size[Axis - 1] + low[Axis - 1]);
            if (size[Axis] == 1) return a;
            b = blend<Axis - 1>(low, fraction, (outer + 1) * size[Axis - 1] + low[Axis - 1]);
        }
        return a + (b - a) * fraction[Axis];
    }
};

REGAIN_NAMESPACE_END
