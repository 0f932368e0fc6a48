// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The balance g of balanced_gain.h, of any direction. An isotropic lobe's is a function of the
/// cosine alone, that of widths ax and ay has an azimuth, too:
///
///   g(w; ax, ay) = g(mu'; R) exp(c)
///   mu' = R w.z / sqrt(R^2 w.z^2 + X^2 + Y^2),    X = ax w.x,  Y = ay w.y
///   R^2 = (ax^2 + ay^2) / 2
///
/// mu' is the cosine of a direction that an isotropic lobe of width R masks the same, as in
/// anisotropy.h. c is what is left, -0.06 to 0.12 of GGX and Beckmann, in a table of its own over
///
///   x = the cosine axis of table.h, at mu' and R
///   y = s X^2 / (s X^2 + Y^2), if x is the narrower axis; s^4 = wider / narrower spreads what
///       changes next to the wider one
///   z = the width axis, at the wider of both
///   4   (1 - sqrt(narrower / wider)) / (1 - sqrt(1 / 20)), at most 1
///   5   the tail axis; of a distribution without a tail there are four
///
/// It is 0 where the widths are equal, which need not read it, and the same with the axes
/// exchanged; the single scattering itself looks the same in a mirror along either axis, and so
/// does g. Whatever c is, g is one function of a direction: what is made of it stays reciprocal.
///
/// Up to 20 : 1 white furnaces are within 3e-3 for GGX, 4e-3 for Beckmann, 1e-2 for STD; for GTR
/// within 1e-2 up to 10 : 1, 2e-2 up to 20 : 1. Without the table c is 0, and they are within 0.1
/// for GGX, 0.15 for Beckmann and STD.

#pragma once

#include <regain/closures/table.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// 1 / (1 - sqrt(1 / 20)): of the fourth axis above.
constexpr double balance_ratio_scale = 1.28800715552629;

}  // namespace detail

/// g of one lobe. Where the table `balance` is missing, it may not be asked.
template <class RealType>
class DirectionalBalance
{
public:
    using Real = RealType;

    template <class Distribution>
    REGAIN_HOST_DEVICE DirectionalBalance(const Distribution& distribution,
                                          const MicrofacetTables& tables)
        : _bound(bool(tables.balance)),
          _axes(distribution),
          _x(distribution.alpha_x()),
          _y(distribution.alpha_y())
    {
        _isotropic = detail::all<Real>(_x == _y);
        if (_bound) _row = _axes.row_of(tables.balance);
        if (_isotropic || !tables.balance_anisotropy) return;
        _anisotropy = *tables.balance_anisotropy;
        const Real wider = detail::max(_x, _y), narrower = detail::min(_x, _y);
        _width = _axes.width_of(wider);
        const Real root = detail::sqrt(narrower / wider);
        _ratio = (Real(1) - root) * detail::constant<Real>(detail::balance_ratio_scale);
        _narrow_share = Real(1) / detail::sqrt(root);
    }

    REGAIN_HOST_DEVICE explicit operator bool() const { return _bound; }

    /// w is unit, w.z in [0, 1].
    REGAIN_INLINE Real at(const Vec3<Real>& w) const
    {
        return _isotropic ? _row.at(_axes.cosine(w.z)) : of_two_widths(w);
    }

private:
    REGAIN_HOST_DEVICE Real of_two_widths(const Vec3<Real>& w) const
    {
        const Real X = _x * w.x, Y = _y * w.y, X2 = X * X, Y2 = Y * Y, z = _axes.alpha() * w.z;
        const Real tiny = detail::constant<Real>(1e-36), tangential = X2 + Y2;
        const Real mu = detail::select(
            _x == _y, w.z,
            detail::min(z / detail::sqrt(detail::max(z * z + tangential, tiny)), Real(1)));
        const Real g = _row.at(_axes.cosine(mu));
        if (!_anisotropy) return g;
        // Along the normal y is anything.
        const Real narrow = _narrow_share * detail::select(_x < _y, X2, Y2);
        const Real y = narrow / detail::max(narrow + detail::select(_x < _y, Y2, X2), tiny);
        const Real at[] = {_axes.cosine(mu), y, _width, _ratio, _axes.tail()};
        return g * detail::exp(_anisotropy.at(at));
    }

    bool _bound;
    TableView::Row<Real> _row;
    GridView<5> _anisotropy;
    TableAxes<Real> _axes;
    Real _x, _y;
    Real _width = Real(0), _ratio = Real(0);
    Real _narrow_share = Real(1);  // s above
    bool _isotropic;
};

REGAIN_NAMESPACE_END
