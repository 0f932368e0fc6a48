// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Vectors of floats: include this header to instantiate closures for xsimd::batch. Every number in
/// a closure, its parameters included, then differs by lane. Needs xsimd; nothing else in the
/// closures does.

#pragma once

#include <regain/closures/number.h>

#include <xsimd/xsimd.hpp>

REGAIN_NAMESPACE_BEGIN

template <class T, class Arch>
struct NumberTraits<xsimd::batch<T, Arch>>
{
    using Batch = xsimd::batch<T, Arch>;
    using Scalar = T;
    using Mask = typename Batch::batch_bool_type;
    using Index = xsimd::batch<xsimd::as_integer_t<T>, Arch>;
    using Bits = xsimd::batch<xsimd::as_unsigned_integer_t<T>, Arch>;

    static Batch select(const Mask& mask, const Batch& a, const Batch& b)
    {
        return xsimd::select(mask, a, b);
    }
    static bool all(const Mask& mask) { return xsimd::all(mask); }
    static bool any(const Mask& mask) { return xsimd::any(mask); }
    static Mask both(const Mask& a, const Mask& b) { return a & b; }
    static Mask quiet_less(const Batch& a, const Batch& b)
    {
        // Of SSE's comparisons only those for equality take a NaN without an exception.
        const Mask numbers = (a == a) & (b == b);
        const Batch zero(T(0));
        return numbers & (xsimd::select(numbers, a, zero) < xsimd::select(numbers, b, zero));
    }

    static Batch min(const Batch& a, const Batch& b) { return xsimd::min(a, b); }
    static Batch max(const Batch& a, const Batch& b) { return xsimd::max(a, b); }
    static Batch abs(const Batch& x) { return xsimd::abs(x); }
    static Batch sqrt(const Batch& x) { return xsimd::sqrt(x); }
    static Batch sin(const Batch& x) { return xsimd::sin(x); }
    static Batch cos(const Batch& x) { return xsimd::cos(x); }
    static Batch asin(const Batch& x) { return xsimd::asin(x); }
    /// x not negative.
    static Batch pow(const Batch& x, const Batch& y)
    {
        const Batch zero(T(0)), one(T(1));
        const Mask positive = x > zero;
        const Batch power = exp(y * xsimd::log(xsimd::select(positive, x, one)));
        return xsimd::select(positive, power, xsimd::select(y > zero, zero, one));
    }
    static Batch exp(const Batch& x)
    {
        // Where the result underflows xsimd may make an int of what is too large for one, an
        // invalid operation, and then drop it.
        const Batch lowest(T(-87));
        return xsimd::select(x < lowest, Batch(T(0)), xsimd::exp(xsimd::max(x, lowest)));
    }
    static Batch log(const Batch& x) { return xsimd::log(x); }
    static Batch expm1(const Batch& x) { return xsimd::expm1(x); }
    static Batch log1p(const Batch& x) { return xsimd::log1p(x); }
    static Batch erf(const Batch& x) { return xsimd::erf(x); }
    /// From 9 on it is 4e-37: see exp.
    static Batch erfc(const Batch& x) { return xsimd::erfc(xsimd::min(x, Batch(T(9)))); }

    static Bits bits(const Batch& x) { return xsimd::bitwise_cast<Bits>(x); }
    static Batch unit(const Bits& a, const Bits&)
    {
        return to_real(xsimd::bitwise_cast<Index>(a >> 8)) * Batch(T(0x1p-24));
    }

    static Index truncate(const Batch& x) { return xsimd::to_int(x); }
    static Batch to_real(const Index& i) { return xsimd::to_float(i); }
    static Index at_most(const Index& i, int limit) { return xsimd::min(i, Index(limit)); }

    static Batch gather(const std::uint16_t* data, const Index& i)
    {
        // There is no 16-bit gather; the lanes are few.
        alignas(Arch::alignment()) xsimd::as_integer_t<T> at[Batch::size];
        alignas(Arch::alignment()) T values[Batch::size];
        i.store_aligned(at);
        for (std::size_t lane = 0; lane < Batch::size; ++lane)
            values[lane] = static_cast<T>(data[at[lane]]);
        return Batch::load_aligned(values);
    }
};

REGAIN_NAMESPACE_END
