// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The energy that single scattering loses, 1 - E(mu), as a function of the cosine: its average
/// and, for sampling what gives it back, a density close to
///
///   p(mu) = (1 - E(mu)) mu / int_0^1 (1 - E) mu' dmu'
///
/// Cosines are placed by s = ln(1 + mu / alpha) / ln(1 + 1 / alpha), which follows the loss from
/// mu ~ alpha, where it is largest for every alpha, over the decades up to mu = 1, where a
/// distribution with a long tail loses most. The density is linear in s between `cells` + 1 equal
/// steps, so it is inverted in closed form and known exactly. A cosine-weighted density in its
/// place would give weights of over a hundred at small alpha.
///
/// Measured with the look-ups of the four distributions, alpha in [1e-3, 1]: see tests.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class MissingEnergy
{
public:
    using Real = RealType;
    static constexpr int cells = 16;

    /// Nothing is missing.
    MissingEnergy() : MissingEnergy(Real(1), [](Real) { return Real(0); }) {}

    /// loss(mu) = 1 - E(mu) in [0, 1] for mu in [0, 1]; it is asked `cells` times. alpha in (0, 1].
    template <class Loss>
    MissingEnergy(Real alpha, const Loss& loss) : _alpha(alpha)
    {
        _log_range = detail::log1p(Real(1) / alpha);
        _inv_log_range = Real(1) / _log_range;

        // (1 - E) mu dmu/ds; it vanishes at mu = 0. From node to node alpha + mu grows by a factor.
        const Real step = detail::exp(_log_range * detail::constant<Real>(1.0 / cells));
        Real sum(0), corrected(0), shifted = alpha;
        _node[0] = Real(0);
        for (int i = 1; i <= cells; ++i)
        {
            shifted *= step;
            const Real mu = detail::min(shifted - alpha, Real(1));
            _node[i] = loss(mu) * mu * shifted * _log_range;
            sum += _node[i] * detail::constant<Real>((i == cells ? 0.5 : 1.0) / cells);
            // Gregory's end correction: the integrand begins like s^2, but ends anywhere.
            corrected += _node[i] * detail::constant<Real>(gregory(cells - i) / cells);
        }
        _average = Real(2) * detail::max(corrected, Real(0));

        // Between two nodes that see no loss there may be some: nothing that is evaluated may be
        // out of reach of samples.
        const Real floor =
            detail::max(sum * detail::constant<Real>(least_density), detail::constant<Real>(1e-30));
        for (Real& node : _node) node = detail::max(node, floor);
        Real total = Real(0.5f) * (_node[0] + _node[cells]);
        for (int i = 1; i < cells; ++i) total += _node[i];
        const Real scale = Real(float(cells)) / total;
        for (Real& node : _node) node *= scale;
    }

    /// 2 int_0^1 (1 - E) mu dmu = 1 - E_avg, of this very E: what integrates to 1 has to be
    /// normalised by what is looked up, and a table of E_avg is not precise enough where next to
    /// nothing is missing.
    Real average() const { return _average; }

    /// Density of mu in [0, 1]; integrates to 1.
    Real density(Real mu) const
    {
        using Number = NumberTraits<Real>;
        const Real s = detail::log1p(mu / _alpha) * _inv_log_range * Real(float(cells));
        const Real cell = Number::to_real(Number::at_most(Number::truncate(s), cells - 1));
        Real low = _node[0], high = _node[1];
        for (int i = 1; i < cells; ++i)
        {
            const MaskOf<Real> reached = cell >= Real(float(i));
            low = detail::select(reached, _node[i], low);
            high = detail::select(reached, _node[i + 1], high);
        }
        const Real fraction = detail::min(s - cell, Real(1));
        return (low + (high - low) * fraction) * _inv_log_range / (_alpha + mu);
    }

    /// A cosine in (0, 1] for u in [0, 1].
    Real sample(Real u) const
    {
        Real sum(0), below(0), low = _node[0], high = _node[1], cell(0);
        for (int i = 1; i < cells; ++i)
        {
            sum += (_node[i - 1] + _node[i]) * detail::constant<Real>(0.5 / cells);
            const MaskOf<Real> reached = sum <= u;
            below = detail::select(reached, sum, below);
            low = detail::select(reached, _node[i], low);
            high = detail::select(reached, _node[i + 1], high);
            cell = detail::select(reached, Real(float(i)), cell);
        }
        // low x + (high - low) x^2 / 2 = area, by the root that does not cancel.
        const Real area = (u - below) * Real(float(cells));
        const Real discriminant = low * low + Real(2) * (high - low) * area;
        const Real x = Real(2) * area / (low + detail::sqrt(detail::max(discriminant, Real(0))));
        const Real s = (cell + detail::saturate(x)) * detail::constant<Real>(1.0 / cells);
        return detail::max(cosine_at(s), detail::constant<Real>(2 * detail::horizon));
    }

private:
    // Share of the average, below which no node's density falls.
    static constexpr double least_density = 0.02;

    static constexpr double gregory(int from_end)
    {
        return from_end == 0 ? 3.0 / 8 : from_end == 1 ? 7.0 / 6 : from_end == 2 ? 23.0 / 24 : 1;
    }

    Real cosine_at(Real s) const
    {
        return detail::min(_alpha * detail::expm1(s * _log_range), Real(1));
    }

    Real _alpha, _log_range, _inv_log_range, _average;
    Real _node[cells + 1];  // the density of s at i / cells
};

REGAIN_NAMESPACE_END
