// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The energy that single scattering loses, 1 - E(mu), as a function of the cosine: its average
/// and, for sampling what gives it back, a density close to
///
///   p(mu) = (1 - E(mu)) mu / int_0^1 (1 - E) mu' dmu'
///
/// Cosines are placed by
///
///   t = mu / (r + sqrt(r^2 - mu^2)),  r^2 = 1.01,    s = ln(1 + t / a) / ln(1 + l / a)
///
/// t is half of mu at grazing angles, and all but linear in theta near the normal, where the loss
/// of distributions with a long tail is linear in theta, too. s, with a = alpha / (2 r) and l =
/// t(1), follows the loss from mu ~ alpha, where it is largest for every alpha, over the decades up
/// to mu = 1. Inside a dielectric there is a second such place, the critical cosine; three pieces
/// then run from 0 up, from there down and from there up, each with the distance from its start for
/// t. The density is linear in s between equal steps, so it is inverted in closed form and known
/// exactly. A cosine-weighted density in its place would give weights of over a hundred at small
/// alpha; this one stays within 1.4 of (1 - E) mu for all four distributions, alpha >= 1e-3.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

/// `pieces` is 1, or 3 where there may be a critical cosine; `cells` steps to a piece.
template <class RealType, int pieces = 1, int cells = 28>
class MissingEnergy
{
public:
    using Real = RealType;
    static_assert(pieces == 1 || pieces == 3, "one piece, or three about a critical cosine");

    /// Nothing is missing, and the density is anything.
    REGAIN_HOST_DEVICE MissingEnergy()
        : _width(detail::constant<Real>(0.5 / radius)), _critical(Real(0)), _average(Real(0))
    {
        Piece& piece = _piece[pieces - 1];
        place(piece, Real(0), Real(1), along(Real(1)).t);
        for (Real& node : piece.node) node = Real(1);
    }

    /// Where integrals over what is missing are taken, kept as long as there are any to take:
    ///   2 int_0^1 g mu dmu  =  sum g(mu[i]) measure[i]
    struct Nodes
    {
        static constexpr int count = pieces * (cells + 1);
        Real mu[count], measure[count];
    };

    /// loss(mu) = 1 - E(mu) in [0, 1] for mu in [0, 1]; it is asked at each of the nodes, in their
    /// order. alpha in (0, 1]. critical in [0, 1) is the critical cosine, 0 where there is none.
    template <class Loss>
    REGAIN_HOST_DEVICE MissingEnergy(Real alpha, const Loss& loss, Real critical = Real(0),
                                     Nodes* nodes = nullptr)
        : _width(alpha * detail::constant<Real>(0.5 / radius))
    {
        const Real none(0);
        _critical = pieces == 1 ? none
                                : detail::select(critical > detail::constant<Real>(least_critical),
                                                 along(critical).t, none);
        const Real half = Real(0.5f) * _critical;
        if constexpr (pieces == 3)
        {
            place(_piece[0], none, Real(1), half);
            place(_piece[1], _critical, Real(-1), half);
        }
        place(_piece[pieces - 1], _critical, Real(1), along(Real(1)).t - _critical);

        Real mass(0), corrected(0);
        for (int i = 0; i < pieces; ++i)
            measure(_piece[i], loss, nodes, i * (cells + 1), mass, corrected);
        _average = Real(2) * detail::max(corrected, Real(0));

        // Between two nodes that see no loss there may be some: nothing that is evaluated may be
        // out of reach of samples.
        const Real floor = detail::max(mass * detail::constant<Real>(least_density),
                                       detail::constant<Real>(1e-30));
        Real total(0);
        for (Piece& piece : _piece)
        {
            const Real least =
                detail::select(piece.length > detail::constant<Real>(least_length), floor, Real(0));
            for (Real& node : piece.node) node = detail::max(node, least);
            for (int i = 0; i < cells; ++i) total += area(piece, i);
        }
        const Real scale = Real(1) / total;
        for (Piece& piece : _piece)
            for (Real& node : piece.node) node *= scale;
    }

    /// 2 int_0^1 (1 - E) mu dmu = 1 - E_avg, of this very E: what integrates to 1 has to be
    /// normalised by what is looked up, and a table of E_avg is not precise enough where next to
    /// nothing is missing.
    REGAIN_HOST_DEVICE Real average() const { return _average; }

    /// Density of mu in [0, 1]; integrates to 1.
    REGAIN_HOST_DEVICE Real density(Real mu) const
    {
        using Number = NumberTraits<Real>;
        const Place place = along(mu);
        const Piece& last = _piece[pieces - 1];
        Real start = last.start, sign(1), inv_range = last.inv_log_range;
        MaskOf<Real> first(false), second(false);
        if constexpr (pieces == 3)
        {
            second = place.t < _critical;
            first = place.t < Real(0.5f) * _critical;
            start = detail::select(first, Real(0), _critical);
            sign = detail::select(detail::both<Real>(second, !first), Real(-1), Real(1));
            inv_range = detail::select(second, _piece[0].inv_log_range, inv_range);
        }
        const Real distance = detail::max((place.t - start) * sign, Real(0));
        const Real s = detail::log1p(distance / _width) * inv_range * Real(float(cells));
        const auto index = Number::at_most(Number::truncate(s), cells - 1);
        const Real cell = Number::to_real(index);
        Real low(0), high(0);
        if constexpr (std::is_floating_point_v<Real>)
        {
            const Piece& piece = _piece[pieces == 1 || first ? 0 : second ? 1 : pieces - 1];
            low = piece.node[index];
            high = piece.node[index + 1];
        }
        else
            for (int i = 0; i < cells; ++i)
            {
                const MaskOf<Real> reached = cell >= Real(float(i));
                low = detail::select(reached, node(first, second, i), low);
                high = detail::select(reached, node(first, second, i + 1), high);
            }
        const Real fraction = detail::min(s - cell, Real(1));
        return (low + (high - low) * fraction) * inv_range /
               ((_width + distance) * place.derivative);
    }

    /// A cosine in (0, 1] for u in [0, 1].
    REGAIN_HOST_DEVICE Real sample(Real u) const
    {
        Real sum(0), below(0), low(0), high(0), cell(0);
        Real start(0), sign(1), range(1);
        for (const Piece& piece : _piece)
            for (int i = 0; i < cells; ++i)
            {
                const Real step = area(piece, i);
                const MaskOf<Real> reached = (sum <= u) & (step > Real(0));
                below = detail::select(reached, sum, below);
                low = detail::select(reached, piece.node[i], low);
                high = detail::select(reached, piece.node[i + 1], high);
                cell = detail::select(reached, Real(float(i)), cell);
                if constexpr (pieces > 1)
                {
                    start = detail::select(reached, piece.start, start);
                    sign = detail::select(reached, piece.sign, sign);
                    range = detail::select(reached, piece.log_range, range);
                }
                sum += step;
            }
        if constexpr (pieces == 1) range = _piece[0].log_range;

        // low x + (high - low) x^2 / 2 = area, by the root that does not cancel.
        const Real part = (u - below) * Real(float(cells));
        const Real discriminant = low * low + Real(2) * (high - low) * part;
        const Real x = Real(2) * part / (low + detail::sqrt(detail::max(discriminant, Real(0))));
        const Real s = (cell + detail::saturate(x)) * detail::constant<Real>(1.0 / cells);
        const Real mu = cosine(start + sign * _width * detail::expm1(s * range));
        return detail::max(detail::min(mu, Real(1)), detail::constant<Real>(2 * detail::horizon));
    }

private:
    static constexpr double radius = 1.00498756211208895;  // r

    // Share of the mass, below which no node's density falls; pieces too short to matter, and
    // critical cosines too low to.
    static constexpr double least_density = 0.02, least_length = 1e-6, least_critical = 2e-3;

    static constexpr bool vanishes = pieces == 1;  // what is missing, like mu^2 at its start

    struct Piece
    {
        Real start = Real(0), sign = Real(1), length = Real(0);
        Real log_range = Real(0), inv_log_range = Real(0);
        Real node[cells + 1] = {};  // the density of s at i / cells
    };

    REGAIN_HOST_DEVICE void place(Piece& piece, const Real& start, const Real& sign,
                                  const Real& length) const
    {
        piece.start = start;
        piece.sign = sign;
        piece.length = length;
        piece.log_range = detail::log1p(length / _width);
        piece.inv_log_range = Real(1) / detail::max(piece.log_range, detail::constant<Real>(1e-12));
    }

    // The nodes (1 - E) mu dmu/ds, their mass by the trapezoidal rule, which is that of the
    // density, and their integral with Gregory's corrections at the ends.
    template <class Loss>
    REGAIN_HOST_DEVICE void measure(Piece& piece, const Loss& loss, Nodes* nodes, int first,
                                    Real& mass, Real& integral) const
    {
        // From node to node width + distance grows by a factor.
        const Real step = detail::exp(piece.log_range * detail::constant<Real>(1.0 / cells));
        Real shifted = _width;
        for (int i = 0; i <= cells; ++i, shifted *= step)
        {
            const Real distance = detail::min(detail::max(shifted - _width, Real(0)), piece.length);
            const Real t = piece.start + piece.sign * distance;
            const Real mu = detail::saturate(cosine(t));
            const Real area = mu * (shifted * piece.log_range * derivative(t));
            piece.node[i] = loss(mu) * area;
            mass += piece.node[i] * detail::constant<Real>((i % cells ? 1.0 : 0.5) / cells);
            integral += piece.node[i] * corrected_weight(i);
            if (!nodes) continue;
            nodes->mu[first + i] = mu;
            nodes->measure[first + i] = Real(2) * area * corrected_weight(i);
        }
    }
    // Of a node in the integral over s.
    REGAIN_HOST_DEVICE static Real corrected_weight(int i)
    {
        return detail::constant<Real>(gregory(cells - i) * (vanishes ? 1 : gregory(i)) / cells);
    }
    // t of a cosine and dmu/dt there, and the ways back.
    struct Place
    {
        Real t, derivative;
    };
    REGAIN_HOST_DEVICE static Place along(Real mu)
    {
        const Real r = detail::constant<Real>(radius);
        const Real c = detail::sqrt(detail::constant<Real>(radius * radius) - mu * mu);
        return {mu / (r + c), c * (r + c) * detail::constant<Real>(1 / radius)};
    }
    REGAIN_HOST_DEVICE static Real cosine(Real t)
    {
        return detail::constant<Real>(2 * radius) * t / (Real(1) + t * t);
    }
    REGAIN_HOST_DEVICE static Real derivative(Real t)
    {
        const Real t2 = t * t, inv = Real(1) / (Real(1) + t2);
        return detail::constant<Real>(2 * radius) * (Real(1) - t2) * inv * inv;
    }
    REGAIN_HOST_DEVICE static constexpr double gregory(int from_end)
    {
        return from_end == 0 ? 3.0 / 8 : from_end == 1 ? 7.0 / 6 : from_end == 2 ? 23.0 / 24 : 1;
    }

    REGAIN_HOST_DEVICE static Real area(const Piece& piece, int i)
    {
        return (piece.node[i] + piece.node[i + 1]) * detail::constant<Real>(0.5 / cells);
    }

    REGAIN_HOST_DEVICE Real node([[maybe_unused]] const MaskOf<Real>& first,
                                 [[maybe_unused]] const MaskOf<Real>& second, int i) const
    {
        if constexpr (pieces == 1)
            return _piece[0].node[i];
        else
            return detail::select(first, _piece[0].node[i],
                                  detail::select(second, _piece[1].node[i], _piece[2].node[i]));
    }

    Real _width;     // a
    Real _critical;  // t of the critical cosine
    Real _average;
    Piece _piece[pieces];
};

REGAIN_NAMESPACE_END
