// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What single scattering loses of one lobe, 1 - E_ss(w) with F = 1, as the lobes that give it back
/// ask for it: often, and always at the same width. An isotropic lobe has its row of the table
/// fixed when it is built; others look theirs up as anisotropy.h says.

#pragma once

#include <regain/closures/anisotropy.h>

REGAIN_NAMESPACE_BEGIN

template <class RealType>
class DirectionalLoss
{
public:
    using Real = RealType;

    /// Of `tables` it needs E_ss of this distribution.
    template <class Distribution>
    REGAIN_HOST_DEVICE DirectionalLoss(const Distribution& distribution, const LossTables& tables)
        : _tables(tables),
          _axes(distribution),
          _black(distribution.is_delta()),
          _bound(tables.has_albedo())
    {
        _has_row = _axes.isotropic() && !tables.fits && tables.E_ss;
        if (_has_row) _row = _axes.row_of(tables.E_ss);
    }

    REGAIN_HOST_DEVICE const DirectionAxes<Real>& axes() const { return _axes; }
    REGAIN_HOST_DEVICE bool bound() const { return _bound; }

    /// Of a unit w, w.z in [0, 1]; 0 of a mirror and without the table.
    REGAIN_INLINE Real at(const Vec3<Real>& w) const
    {
        if (!_bound) return Real(0);
        const Real E =
            _has_row ? _tables.albedo_of(_row.at(_axes.cosine(w.z))) : _axes.albedo(_tables, w);
        return detail::select(_black, Real(0), Real(1) - E);
    }

private:
    LossTables _tables;
    DirectionAxes<Real> _axes;
    TableView::Row<Real> _row;
    MaskOf<Real> _black;
    bool _bound, _has_row;
};

REGAIN_NAMESPACE_END
