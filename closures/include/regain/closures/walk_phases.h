// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// How deep a walk on a Smith microsurface is, without its depth being drawn.
///
/// In optical depth (microsurface_walk.h) every step of a ray is exponential: the first hit lies
/// Exp(a) below the top, and a ray that goes down at the rate r adds Exp(r). So the depth of a path
/// is a sum of exponential phases. A ray that goes up at the rate b uses phases up, the lowest
/// first. In one of rate r it meets a facet with the probability b / (b + r), and what is left of
/// that phase has the law Exp(r) again, because an exponential law has no memory; otherwise it goes
/// on into the next, and its own step has no memory either. Beyond the uppermost it has left:
///
///   P(leaves at the rate b) = product of r_j / (r_j + b) over all phases
///
/// The state of a walk is a stack of rates, then, exact in law; no step takes a logarithm. And
/// what leaves along a given direction is known as the mean over all depths that a path may have,
/// so an estimate that joins a path with a direction has none of the noise of one depth.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN
namespace detail {

/// The phases of a walk of at most `capacity` facets, lane by lane. Rays are told by z, which is
/// |cos theta| > 0, and area, which is sigma of the direction that is against them; area / z is
/// their rate.
template <class RealType, int capacity>
class WalkPhases
{
public:
    using Real = RealType;
    using Mask = MaskOf<Real>;

    /// At the first facet that a ray meets; z and area of what is against it.
    REGAIN_HOST_DEVICE WalkPhases(const Real& z, const Real& area) : _size(Real(1)), _most(1)
    {
        _rate[0] = area / z;
    }

    /// Probability that a ray from here leaves upwards.
    REGAIN_HOST_DEVICE Real escape_probability(const Real& z, const Real& area) const
    {
        Real p(1);
        for (int j = 0; j < _most; ++j)
        {
            const Real out = _rate[j] * z;
            const Real passes = out / (out + area);
            p *= j == 0 ? passes : select(reaches(j), passes, Real(1));
        }
        return p;
    }

    /// Probability that it does not, which keeps its digits where it is small.
    REGAIN_HOST_DEVICE Real stay_probability(const Real& z, const Real& area) const
    {
        Real p(0);
        for (int j = _most - 1; j >= 0; --j) p += met(j, z, area) * (Real(1) - p);
        return p;
    }

    /// The ray goes up in these lanes and meets a facet where u is below stay_probability; returns
    /// where it does not, and has left.
    REGAIN_HOST_DEVICE Mask rise(const Real& z, const Real& area, const Real& u, const Mask& lanes)
    {
        Mask going = lanes;
        Real p(0);
        for (int j = _most - 1; j >= 0 && any<Real>(going); --j)
        {
            p += met(j, z, area) * (Real(1) - p);
            const Mask stops = both<Real>(both<Real>(going, reaches(j)), u < p);
            _size = select(stops, Real(static_cast<ScalarOf<Real>>(j + 1)), _size);
            going = both<Real>(going, !stops);
        }
        return going;
    }

    /// The ray goes down in these lanes, to the next facet. No more than `capacity` - 1 times.
    REGAIN_HOST_DEVICE void sink(const Real& z, const Real& area, const Mask& lanes)
    {
        if (_most == capacity || !any<Real>(lanes)) return;
        const Real rate = area / z;
        _rate[_most] = rate;
        for (int j = 1; j < _most; ++j)
            _rate[j] = select(both<Real>(lanes, !reaches(j)), rate, _rate[j]);
        _size += select(lanes, Real(1), Real(0));
        ++_most;
    }

private:
    // Whether there is a phase j. Those beyond the last are never read before they are set.
    REGAIN_HOST_DEVICE Mask reaches(int j) const
    {
        return _size > Real(static_cast<ScalarOf<Real>>(j));
    }

    // Probability of a facet in phase j, 0 where there is none.
    REGAIN_HOST_DEVICE Real met(int j, const Real& z, const Real& area) const
    {
        return select(reaches(j), area / (_rate[j] * z + area), Real(0));
    }

    Real _rate[capacity];
    Real _size;  // phases, 1 or more
    int _most;   // in any lane
};

}  // namespace detail
REGAIN_NAMESPACE_END
