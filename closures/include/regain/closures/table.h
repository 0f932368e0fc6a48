// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Albedo tables as the closures see them: a view of numbers that somebody else owns, and the axes
/// along which they lie. Look-ups are bilinear; nodes stand at both ends of an axis.
///
/// Axes. The energy that single scattering loses lies at mu ~ alpha for every alpha, so the cosine
/// axis is stretched by alpha:
///     x = sqrt(mu / (mu + alpha (1 - mu)))   in [0, 1]
///     y = sqrt(alpha)                        in [0, 1]
/// with mu = |cos theta_o| in [0, 1], alpha in [0, 1].

#pragma once

#include <regain/closures/vector.h>

#include <cstdint>

REGAIN_NAMESPACE_BEGIN

/// x above; mu and alpha in [0, 1], not both 0.
template <class Real>
Real stretched_cosine(Real mu, Real alpha)
{
    return detail::sqrt(mu / (mu + alpha * (Real(1) - mu)));
}

/// A table of `width` x `height` 16-bit numbers, x fastest; height 1 for a single axis. A value is
/// offset + scale * stored. The default is no table.
struct TableView
{
    const std::uint16_t* data = nullptr;
    int width = 0, height = 0;
    float offset = 0, scale = 1.0f / 65535;

    explicit operator bool() const { return data != nullptr; }

    /// Value at x along the first axis, in [0, 1]; the table has one axis and is not empty.
    template <class Real>
    Real at(Real x) const
    {
        const Cell<Real> i(x, width);
        return value(row(i, 0));
    }

    /// Value at (x, y), each in [0, 1]; the table has two axes and is not empty.
    template <class Real>
    Real at(Real x, Real y) const
    {
        const Cell<Real> i(x, width), j(y, height);
        const auto line = j.low * width;
        const Real a = row(i, line), b = row(i, line + width);
        return value(a + (b - a) * j.fraction);
    }

private:
    // The two nodes about a coordinate.
    template <class Real>
    struct Cell
    {
        Cell(Real coordinate, int nodes)
        {
            using Number = NumberTraits<Real>;
            const Real at = coordinate * Real(static_cast<ScalarOf<Real>>(nodes - 1));
            low = Number::at_most(Number::truncate(at), nodes - 2);
            fraction = at - Number::to_real(low);
        }
        IndexOf<Real> low;
        Real fraction;
    };

    template <class Real, class Line>
    Real row(const Cell<Real>& i, Line line) const
    {
        using Number = NumberTraits<Real>;
        const Real a = Number::gather(data, line + i.low),
                   b = Number::gather(data, line + i.low + 1);
        return a + (b - a) * i.fraction;
    }

    template <class Real>
    Real value(Real stored) const
    {
        return detail::constant<Real>(offset) + detail::constant<Real>(scale) * stored;
    }
};

/// What is tabulated of one distribution. A view that is empty is a table nobody needs.
struct MicrofacetTables
{
    TableView E_ss;   ///< single-scattering albedo with F = 1, over (x, y); limit look-ups to 1
    TableView E_avg;  ///< 2 int_0^1 E_ss mu dmu, over y
    /// Over (x, y): the moments of fresnel_moments.h over all that is scattered once, each less its
    /// value at mu.
    TableView falloff, dip;
};

REGAIN_NAMESPACE_END
