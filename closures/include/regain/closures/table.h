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
/// with mu = |cos theta_o| in [0, 1], alpha in [0, 1]. Beckmann's dip is narrower, and needs no
/// root:
///     x = mu / (mu + alpha (1 - mu))
///
/// A distribution with a tail parameter gamma has a third axis z in [0, 1], its tail(): see
/// distribution.h and tail.h. Its tail matters at slopes of 1 whatever alpha is, and near normal
/// incidence its E_ss is linear in theta, not mu. So the other two axes are logarithms, with a part
/// that holds the nodes together where the logarithm is flat:
///     x = 3/4 (1 + ln((k + s) / (1 + s)) / ln(1 / k)) + 1/4 s / (1 + s),
///                                            s = cot theta_o, k = 0.004 sqrt(alpha)
///     y = gtr_width(alpha) or std_width(alpha)

#pragma once

#include <regain/closures/analytic_albedo.h>
#include <regain/closures/distribution.h>
#include <regain/closures/fresnel_moments.h>
#include <regain/closures/grid_view.h>
#include <regain/closures/tail.h>

#include <cstdint>

REGAIN_NAMESPACE_BEGIN

/// x above; mu and alpha in [0, 1], not both 0.
template <class Real>
REGAIN_HOST_DEVICE Real stretched_cosine(Real mu, Real alpha)
{
    return detail::sqrt(mu / (mu + alpha * (Real(1) - mu)));
}

/// x above of Beckmann; arguments as before.
template <class Real>
REGAIN_HOST_DEVICE Real plain_cosine(Real mu, Real alpha)
{
    return mu / (mu + alpha * (Real(1) - mu));
}

/// x above of distributions with a tail; mu in [0, 1], alpha in (0, 1].
template <class Real>
REGAIN_HOST_DEVICE Real tail_cosine(Real mu, Real alpha)
{
    const Real s = mu, c = detail::sqrt(detail::max((Real(1) - mu) * (Real(1) + mu), Real(0)));
    const Real k = detail::constant<Real>(0.004) * detail::sqrt(alpha), scale = Real(1) / (s + c);
    const Real l = Real(1) - detail::log((k * c + s) * scale) / detail::log(k);
    return detail::saturate(Real(0.75f) * l + Real(0.25f) * s * scale);
}
/// A table of `width` x `height` x `depth` 16-bit numbers, x fastest; an axis that is not there has
/// length 1. A value is offset + scale * stored. The default is no table.
struct TableView
{
    const std::uint16_t* data = nullptr;
    int width = 0, height = 0, depth = 1;
    float offset = 0, scale = 1.0f / 65535;

    REGAIN_INLINE explicit operator bool() const { return data != nullptr; }

    /// Value at x along the first axis, in [0, 1]; the table has one axis and is not empty.
    template <class Real>
    REGAIN_INLINE Real at(Real x) const
    {
        const Cell<Real> i(x, width);
        return value(row(i, 0));
    }

    /// Value at (x, y), each in [0, 1]; the table has two axes and is not empty.
    template <class Real>
    REGAIN_INLINE Real at(Real x, Real y) const
    {
        const Cell<Real> i(x, width), j(y, height);
        return value(plane(i, j.fraction, j.low * width));
    }

    /// Value at (x, y, z), each in [0, 1]; the table has three axes and is not empty.
    template <class Real>
    REGAIN_INLINE Real at(Real x, Real y, Real z) const
    {
        const Cell<Real> i(x, width), j(y, height), k(z, depth);
        const auto line = (k.low * height + j.low) * width;
        const Real a = plane(i, j.fraction, line), b = plane(i, j.fraction, line + height * width);
        return value(a + (b - a) * k.fraction);
    }

    /// The table with all coordinates fixed but the first.
    template <class Real>
    class Row;

    /// Row at y, of two axes, and at (y, z), of three; each in [0, 1]. The table is not empty.
    template <class Real>
    REGAIN_INLINE Row<Real> row_at(Real y) const
    {
        return Row<Real>(*this, y);
    }
    template <class Real>
    REGAIN_INLINE Row<Real> row_at(Real y, Real z) const
    {
        return Row<Real>(*this, y, z);
    }

private:
    // The two nodes about a coordinate.
    template <class Real>
    struct Cell
    {
        REGAIN_INLINE Cell(Real coordinate, int nodes)
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
    REGAIN_INLINE Real row(const Cell<Real>& i, Line line) const
    {
        using Number = NumberTraits<Real>;
        Real a, b;
        Number::gather_pair(data, line + i.low, a, b);
        return a + (b - a) * i.fraction;
    }

    // Line is the index of the first node of the row below.
    template <class Real, class Line>
    REGAIN_INLINE Real plane(const Cell<Real>& i, const Real& fraction, const Line& line) const
    {
        const Real a = row(i, line), b = row(i, line + width);
        return a + (b - a) * fraction;
    }

    template <class Real>
    REGAIN_INLINE Real value(Real stored) const
    {
        return detail::constant<Real>(offset) + detail::constant<Real>(scale) * stored;
    }
};

template <class Real>
class TableView::Row
{
public:
    /// Of no table; it may not be asked.
    Row() = default;

    /// Value at x in [0, 1].
    REGAIN_INLINE Real at(Real x) const
    {
        const Cell<Real> i(x, _table.width);
        Real a = _table.plane(i, _y, _line);
        if (_table.depth > 1)
        {
            const Real b = _table.plane(i, _y, _line + _table.height * _table.width);
            a += (b - a) * _z;
        }
        return _table.value(a);
    }

private:
    friend TableView;

    REGAIN_INLINE Row(const TableView& table, Real y) : _table(table)
    {
        const Cell<Real> j(y, table.height);
        _line = j.low * table.width;
        _y = j.fraction;
    }
    REGAIN_INLINE Row(const TableView& table, Real y, Real z) : Row(table, y)
    {
        const Cell<Real> k(z, table.depth);
        _line = _line + k.low * table.height * table.width;
        _z = k.fraction;
    }

    TableView _table;
    IndexOf<Real> _line = IndexOf<Real>(0);
    Real _y = Real(0), _z = Real(0);
};

/// Where a distribution lies on the axes of its tables: all but the cosine.
template <class RealType>
class TableAxes
{
public:
    using Real = RealType;

    template <class Distribution>
    REGAIN_INLINE explicit TableAxes(const Distribution& distribution)
        : _alpha(distribution.effective_alpha()),
          _width_axis(detail::WidthAxisOf<Distribution>::value),
          _width(width_of(_alpha)),
          _tail(detail::tail_of(distribution)),
          _has_tail(Distribution::has_tail),
          _cosine(detail::CosineAxisOf<Distribution>::value)
    {}

    REGAIN_HOST_DEVICE Real alpha() const { return _alpha; }
    /// Coordinate of gamma along the third axis; 0 where there is none.
    REGAIN_HOST_DEVICE Real tail() const { return _tail; }
    REGAIN_HOST_DEVICE bool has_tail() const { return _has_tail; }
    /// Coordinate of a width in (0, 1] along the second axis.
    REGAIN_HOST_DEVICE Real width_of(Real alpha) const
    {
        return _width_axis == WidthAxis::gtr   ? gtr_width(alpha)
               : _width_axis == WidthAxis::std ? std_width(alpha)
                                               : detail::sqrt(alpha);
    }

    /// The same of another width, in (0, 1].
    REGAIN_HOST_DEVICE TableAxes of_alpha(Real alpha) const
    {
        TableAxes other = *this;
        other._alpha = alpha;
        other._width = width_of(alpha);
        return other;
    }

    /// mu in [0, 1].
    REGAIN_INLINE Real directional(const TableView& table, Real mu) const
    {
        const Real x = cosine(mu);
        return _has_tail ? table.at(x, _width, _tail) : table.at(x, _width);
    }
    /// The row of `table` that directional() looks into, over cosine(mu).
    REGAIN_INLINE TableView::Row<Real> row_of(const TableView& table) const
    {
        return _has_tail ? table.row_at(_width, _tail) : table.row_at(_width);
    }
    /// Coordinate of mu in [0, 1] along the first axis.
    REGAIN_INLINE Real cosine(Real mu) const
    {
        return _cosine == CosineAxis::tail    ? tail_cosine(mu, _alpha)
               : _cosine == CosineAxis::plain ? plain_cosine(mu, _alpha)
                                              : stretched_cosine(mu, _alpha);
    }
    /// Of what changes slowly, q_ms and mu_ms, the first axis is sqrt(mu); mu in [0, 1].
    REGAIN_HOST_DEVICE Real later(const TableView& table, Real mu) const
    {
        const Real x = detail::sqrt(mu);
        return _has_tail ? table.at(x, _width, _tail) : table.at(x, _width);
    }
    REGAIN_HOST_DEVICE Real average(const TableView& table) const
    {
        return _has_tail ? table.at(_width, _tail) : table.at(_width);
    }

private:
    Real _alpha;
    WidthAxis _width_axis;
    Real _width, _tail;
    bool _has_tail;
    CosineAxis _cosine;
};

/// What single scattering loses: the part of MicrofacetTables that a gain keeps. Closures keep no
/// more of them than they ask, as they are built at every shading point.
struct LossTables
{
    TableView E_ss;  ///< single-scattering albedo with F = 1, over (x, y[, z])
    /// E_ss and E_avg hold natural logarithms: where they fall to a few hundredths, straight lines
    /// between those err less.
    bool logarithmic = false;
    /// Formulas in place of all tables, which are then not read: see analytic_tables.h.
    const MicrofacetFits* fits = nullptr;
    /// What anisotropic lobes have besides: see anisotropy.h. Without it they do with a formula.
    const GridView<5>* anisotropy = nullptr;

    /// What can be asked below.
    REGAIN_HOST_DEVICE bool has_albedo() const { return fits || E_ss; }

    /// E_ss at the cosine mu in [0, 1], at most 1.
    template <class Real>
    REGAIN_INLINE Real albedo(const TableAxes<Real>& axes, Real mu) const
    {
        return fits ? fits->E_ss(mu, axes.alpha()) : albedo_of(axes.directional(E_ss, mu));
    }
    /// E_ss by the number that the table holds of it.
    template <class Real>
    REGAIN_INLINE Real albedo_of(Real number) const
    {
        return detail::min(value(number), Real(1));
    }

    /// q_ms and mu_ms at the cosine mu in [0, 1], of MicrofacetTables with these.
    template <class Real>
    REGAIN_HOST_DEVICE Real later_share(const TableView& q_ms, const TableAxes<Real>& axes,
                                        Real mu) const
    {
        return fits ? fits->q_ms(mu, axes.alpha()) : axes.later(q_ms, mu);
    }
    template <class Real>
    REGAIN_HOST_DEVICE Real later_cosine(const TableView& mu_ms, const TableAxes<Real>& axes,
                                         Real mu) const
    {
        return fits ? fits->mu_ms(mu, axes.alpha()) : axes.later(mu_ms, mu);
    }

protected:
    template <class Real>
    REGAIN_HOST_DEVICE Real value(Real number) const
    {
        return logarithmic ? detail::exp(number) : number;
    }
};

/// What a lobe needs of them to know its own albedo.
struct AlbedoTables : LossTables
{
    /// Over (x, y[, z]): the moments of fresnel_moments.h over all that is scattered once, each
    /// less its value at mu.
    TableView falloff, dip;

    REGAIN_HOST_DEVICE bool has_moments() const { return fits || (falloff && dip); }

    /// The Fresnel moments of what is scattered once, at the cosine mu in [0, 1].
    template <class Real>
    REGAIN_HOST_DEVICE FresnelMoments<Real> moments(const TableAxes<Real>& axes, Real mu) const
    {
        if (fits) return fits->moments(mu, axes.alpha());
        FresnelMoments<Real> m = FresnelMoments<Real>::at(mu);
        m.falloff += axes.directional(falloff, mu);
        m.dip += axes.directional(dip, mu);
        return m;
    }
};

/// What is tabulated of one distribution. A view that is empty is a table nobody needs.
struct MicrofacetTables : AlbedoTables
{
    TableView E_avg;  ///< 2 int_0^1 E_ss mu dmu, over (y[, z])
    /// What leaves single scattering reciprocal and without loss, over (x, y[, z]): see
    /// balanced_gain.h.
    TableView balance;
    /// Of the bounces after the first, over (sqrt(mu), y[, z]): see directional_gain.h.
    TableView q_ms, mu_ms;
    /// Of the same bounces, over (y[, z]): see azimuth_spread.h and fitted_tail.h.
    TableView spread, forward, tilt;
    /// What those of any distribution have besides `balance`: see anisotropic_balance.h.
    const GridView<5>* balance_anisotropy = nullptr;

    /// What can be asked below.
    REGAIN_HOST_DEVICE bool has_average_albedo() const { return fits || E_avg; }
    REGAIN_HOST_DEVICE bool has_later_bounces() const { return fits || (q_ms && mu_ms); }
    REGAIN_HOST_DEVICE bool has_later_shape() const { return fits || (spread && forward && tilt); }

    template <class Real>
    REGAIN_HOST_DEVICE Real average_albedo(const TableAxes<Real>& axes) const
    {
        return fits ? fits->E_avg(axes.alpha()) : value(axes.average(E_avg));
    }
    /// q_ms and mu_ms at the cosine mu in [0, 1].
    template <class Real>
    REGAIN_HOST_DEVICE Real later_share(const TableAxes<Real>& axes, Real mu) const
    {
        return LossTables::later_share(q_ms, axes, mu);
    }
    template <class Real>
    REGAIN_HOST_DEVICE Real later_cosine(const TableAxes<Real>& axes, Real mu) const
    {
        return LossTables::later_cosine(mu_ms, axes, mu);
    }
    /// spread, forward and tilt.
    template <class Real>
    REGAIN_HOST_DEVICE Real later_spread(const TableAxes<Real>& axes) const
    {
        return fits ? fits->spread(axes.alpha()) : axes.average(spread);
    }
    template <class Real>
    REGAIN_HOST_DEVICE Real later_forward(const TableAxes<Real>& axes) const
    {
        return fits ? fits->forward(axes.alpha()) : axes.average(forward);
    }
    template <class Real>
    REGAIN_HOST_DEVICE Real later_tilt(const TableAxes<Real>& axes) const
    {
        return fits ? fits->tilt(axes.alpha()) : axes.average(tilt);
    }
};

REGAIN_NAMESPACE_END
