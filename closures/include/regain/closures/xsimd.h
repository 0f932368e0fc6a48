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

    REGAIN_INLINE static Batch select(const Mask& mask, const Batch& a, const Batch& b)
    {
        return xsimd::select(mask, a, b);
    }
    REGAIN_INLINE static bool all(const Mask& mask) { return xsimd::all(mask); }
    REGAIN_INLINE static bool any(const Mask& mask) { return xsimd::any(mask); }
    REGAIN_INLINE static Mask both(const Mask& a, const Mask& b) { return a & b; }
    REGAIN_INLINE static Mask quiet_less(const Batch& a, const Batch& b)
    {
        // Of SSE's comparisons only those for equality take a NaN without an exception; those of
        // AVX that xsimd takes do, too.
        if constexpr (std::is_base_of_v<xsimd::avx, Arch> ||
                      std::is_base_of_v<xsimd::avx512f, Arch>)
            return a < b;
        const Mask numbers = (a == a) & (b == b);
        const Batch zero(T(0));
        return numbers & (xsimd::select(numbers, a, zero) < xsimd::select(numbers, b, zero));
    }

    REGAIN_INLINE static Batch min(const Batch& a, const Batch& b) { return xsimd::min(a, b); }
    REGAIN_INLINE static Batch max(const Batch& a, const Batch& b) { return xsimd::max(a, b); }
    REGAIN_INLINE static Batch abs(const Batch& x) { return xsimd::abs(x); }
    REGAIN_INLINE static Batch sqrt(const Batch& x) { return xsimd::sqrt(x); }
    REGAIN_INLINE static Batch sin(const Batch& x) { return turned(x, 0); }
    REGAIN_INLINE static Batch cos(const Batch& x) { return turned(x, 1); }
    REGAIN_INLINE static Batch asin(const Batch& x) { return xsimd::asin(x); }
    /// x not negative.
    REGAIN_INLINE static Batch pow(const Batch& x, const Batch& y)
    {
        const Batch zero(T(0)), one(T(1));
        const Mask positive = x > zero;
        const Batch power = exp(y * xsimd::log(xsimd::select(positive, x, one)));
        return xsimd::select(positive, power, xsimd::select(y > zero, zero, one));
    }
    REGAIN_INLINE static Batch exp(const Batch& x)
    {
        // Where the result underflows xsimd may make an int of what is too large for one, an
        // invalid operation, and then drop it.
        const Batch lowest(T(-87));
        return xsimd::select(x < lowest, Batch(T(0)), xsimd::exp(xsimd::max(x, lowest)));
    }
    REGAIN_INLINE static Batch log(const Batch& x) { return xsimd::log(x); }
    REGAIN_INLINE static Batch expm1(const Batch& x) { return xsimd::expm1(x); }
    REGAIN_INLINE static Batch log1p(const Batch& x) { return xsimd::log1p(x); }
    REGAIN_INLINE static Batch erf(const Batch& x) { return xsimd::erf(x); }
    /// From 9 on it is 4e-37: see exp.
    REGAIN_INLINE static Batch erfc(const Batch& x)
    {
        return xsimd::erfc(xsimd::min(x, Batch(T(9))));
    }

    REGAIN_INLINE static Bits bits(const Batch& x) { return xsimd::bitwise_cast<Bits>(x); }
    REGAIN_INLINE static Batch unit(const Bits& a, const Bits&)
    {
        return to_real(xsimd::bitwise_cast<Index>(a >> 8)) * Batch(T(0x1p-24));
    }

    REGAIN_INLINE static Index truncate(const Batch& x) { return xsimd::to_int(x); }
    REGAIN_INLINE static Batch to_real(const Index& i) { return xsimd::to_float(i); }
    REGAIN_INLINE static Index at_most(const Index& i, int limit)
    {
        return xsimd::min(i, Index(limit));
    }

    REGAIN_INLINE static void gather_pair(const std::uint16_t* data, const Index& i, Batch& a,
                                          Batch& b)
    {
        // Neighbours are the two halves of one number of 32 bits, the first of them the lower one.
        const Index pair = pairs(data, i);
        a = to_real(pair & Index(0xFFFF));
        b = to_real(xsimd::bitwise_cast<Index>(xsimd::bitwise_cast<Bits>(pair) >> 16));
    }

private:
    REGAIN_INLINE static Index pairs(const std::uint16_t* data, const Index& i)
    {
#if XSIMD_WITH_AVX512F
        if constexpr (std::is_base_of_v<xsimd::avx512f, Arch> && sizeof(T) == 4)
            return Index(_mm512_i32gather_epi32(i, data, 2));
#endif
#if XSIMD_WITH_AVX2
        if constexpr (std::is_base_of_v<xsimd::avx2, Arch> && sizeof(T) == 4)
            return Index(_mm256_i32gather_epi32(reinterpret_cast<const int*>(data), i, 2));
#endif
        alignas(Arch::alignment()) xsimd::as_integer_t<T> at[Batch::size], found[Batch::size];
        i.store_aligned(at);
        for (std::size_t lane = 0; lane < Batch::size; ++lane)
        {
            const std::uint16_t* p = data + at[lane];
            found[lane] =
                static_cast<xsimd::as_integer_t<T>>(p[0] | static_cast<std::uint32_t>(p[1]) << 16);
        }
        return Index::load_aligned(found);
    }

    // sin(x + quarters pi / 2), |x| up to 100, to 1e-7. xsimd's own goes on to any x, through
    // functions of doubles that are the same for all instruction sets; where several are in one
    // program, the linker keeps one of them for all. Polynomials of Moshier's Cephes.
    REGAIN_INLINE static Batch turned(const Batch& x, int quarters)
    {
        if constexpr (sizeof(T) == 8) return quarters ? xsimd::cos(x) : xsimd::sin(x);
        const Batch part = xsimd::nearbyint(x * Batch(T(0.636619772367581343)));
        const Batch r = ((x - part * Batch(T(1.5703125))) - part * Batch(T(4.837512969970703e-4))) -
                        part * Batch(T(7.549789948768648e-8));
        const Batch r2 = r * r, one(T(1));
        const Batch sine =
            r + r * r2 *
                    (Batch(T(-1.6666654611e-1)) +
                     r2 * (Batch(T(8.3321608736e-3)) + r2 * Batch(T(-1.9515295891e-4))));
        const Batch cosine =
            (one - Batch(T(0.5)) * r2) +
            r2 * r2 *
                (Batch(T(4.166664568298827e-2)) +
                 r2 * (Batch(T(-1.388731625493765e-3)) + r2 * Batch(T(2.443315711809948e-5))));
        // Quarters of a turn, modulo 4, in floats.
        const Batch n = part + Batch(T(quarters)), half = xsimd::floor(n * Batch(T(0.5)));
        const Mask odd = (n - half - half) > Batch(T(0.5)),
                   second =
                       (half - Batch(T(2)) * xsimd::floor(half * Batch(T(0.5)))) > Batch(T(0.5));
        const Batch value = xsimd::select(odd, cosine, sine);
        return xsimd::select(second, -value, value);
    }
};

REGAIN_NAMESPACE_END
