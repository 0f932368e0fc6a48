// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// More random numbers from those that the host passed. A few of what is sampled here takes a
/// number of random numbers that is known only afterwards: rejection, a walk of any length. Such
/// code uses the host's numbers first and then a stream that they determine, so that the same
/// arguments give the same answer and nothing is hidden.
///
/// The stream hashes a counter with a key (two rounds of the 32-bit mixer "lowbias32", Wellons
/// 2018); the key is a hash of the bits of the numbers.

#pragma once

#include <regain/closures/vector.h>

REGAIN_NAMESPACE_BEGIN

template <class Real>
class RandomStream
{
public:
    using Bits = BitsOf<Real>;

    /// To be assigned to.
    RandomStream() = default;

    /// u: numbers in [0, 1). Streams of different u are as good as independent.
    REGAIN_HOST_DEVICE explicit RandomStream(const Vec3<Real>& u)
    {
        using Number = NumberTraits<Real>;
        _key = mixed(Number::bits(u.x));
        _key = mixed((_key ^ Number::bits(u.y)) + Bits(0x9E3779B9u));
        _key = mixed((_key ^ Number::bits(u.z)) + Bits(0x3C6EF372u));
    }

    /// The next number, uniform in [0, 1).
    REGAIN_HOST_DEVICE Real next()
    {
        using Number = NumberTraits<Real>;
        const Bits a = bits();
        if constexpr (sizeof(ScalarOf<Real>) == 4)
            return Number::unit(a, a);
        else
            return Number::unit(a, bits());
    }
    REGAIN_HOST_DEVICE Vec2<Real> next2()
    {
        const Real x = next();
        return {x, next()};
    }
    REGAIN_HOST_DEVICE Vec3<Real> next3()
    {
        const Real x = next(), y = next();
        return {x, y, next()};
    }

    /// All that it is, for keeping streams lane by lane: the key, and a count that is the same in
    /// all lanes.
    REGAIN_HOST_DEVICE Bits& key() { return _key; }
    REGAIN_HOST_DEVICE std::uint32_t& count() { return _counter; }

private:
    REGAIN_HOST_DEVICE Bits bits() { return mixed(_key ^ mixed(Bits(_counter += 0x9E3779B9u))); }

    REGAIN_HOST_DEVICE static Bits mixed(Bits x)
    {
        x ^= x >> 16;
        x *= Bits(0x7FEB352Du);
        x ^= x >> 15;
        x *= Bits(0x846CA68Bu);
        x ^= x >> 16;
        return x;
    }

    Bits _key = Bits(0);
    std::uint32_t _counter = 0;
};

REGAIN_NAMESPACE_END
