// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a number is to the closures: float, double, or a vector of floats. Code that has to work
/// for all of them selects with masks instead of branching and calls the functions of `detail`
/// below. A vector type joins by specialising NumberTraits, as <regain/closures/xsimd.h> does.

#pragma once

#include <regain/closures/host_device.h>
#include <regain/closures/version.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__SSE2__) && !defined(__CUDACC__) && !defined(__HIPCC__)
#include <emmintrin.h>
#define REGAIN_HAS_SSE2 1
#else
#define REGAIN_HAS_SSE2 0
#endif

REGAIN_NAMESPACE_BEGIN

/// The types and operations that go with a number type; float and double here.
template <class Real, class = void>
struct NumberTraits;

template <class Real>
struct NumberTraits<Real, std::enable_if_t<std::is_floating_point_v<Real>>>
{
    using Scalar = Real;
    using Mask = bool;
    using Index = int;
    using Bits = std::uint32_t;

    REGAIN_INLINE static Real select(bool mask, Real a, Real b) { return mask ? a : b; }
    REGAIN_INLINE static bool all(bool mask) { return mask; }
    REGAIN_INLINE static bool any(bool mask) { return mask; }
    REGAIN_INLINE static bool both(bool a, bool b) { return a && b; }

    /// a < b, where a may be unchecked input: false for a quiet NaN, which raises no exception.
    REGAIN_INLINE static bool quiet_less(Real a, Real b)
    {
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
        return a < b;  // a GPU raises none
#else
        return std::isless(a, b);
#endif
    }

    /// lo <= x <= hi; of a quiet NaN as above.
    REGAIN_INLINE static bool is_within(Real x, Real lo, Real hi)
    {
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
        return lo <= x && x <= hi;
#else
        return std::isgreaterequal(x, lo) && std::islessequal(x, hi);
#endif
    }

    REGAIN_INLINE static Real min(Real a, Real b) { return b < a ? b : a; }
    REGAIN_INLINE static Real max(Real a, Real b) { return a < b ? b : a; }
    REGAIN_INLINE static Real abs(Real x) { return std::abs(x); }
    REGAIN_INLINE static Real sqrt(Real x)
    {
#if REGAIN_HAS_SSE2
        // Unless it is told that nobody reads errno, a compiler keeps a call beside the
        // instruction.
        if constexpr (sizeof(Real) == 4) return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x)));
        if constexpr (sizeof(Real) == 8)
            return _mm_cvtsd_f64(_mm_sqrt_sd(_mm_setzero_pd(), _mm_set_sd(x)));
#endif
        return std::sqrt(x);
    }
    REGAIN_INLINE static Real sin(Real x) { return std::sin(x); }
    REGAIN_INLINE static Real cos(Real x) { return std::cos(x); }
    REGAIN_INLINE static Real asin(Real x) { return std::asin(x); }
    REGAIN_INLINE static Real pow(Real x, Real y) { return std::pow(x, y); }
    REGAIN_INLINE static Real exp(Real x) { return std::exp(x); }
    REGAIN_INLINE static Real log(Real x) { return std::log(x); }
    REGAIN_INLINE static Real expm1(Real x) { return std::expm1(x); }
    REGAIN_INLINE static Real log1p(Real x) { return std::log1p(x); }
    REGAIN_INLINE static Real erf(Real x) { return std::erf(x); }
    REGAIN_INLINE static Real erfc(Real x) { return std::erfc(x); }

    /// Bits that differ where numbers differ, for hashing.
    REGAIN_INLINE static Bits bits(Real x)
    {
        if constexpr (sizeof(Real) == 4)
        {
            Bits b;
            std::memcpy(&b, &x, sizeof b);
            return b;
        }
        else
        {
            std::uint64_t b;
            std::memcpy(&b, &x, sizeof b);
            return static_cast<Bits>(b ^ (b >> 32));
        }
    }
    /// A number in [0, 1) from random bits; the second half serves where one is too short.
    REGAIN_INLINE static Real unit(Bits a, [[maybe_unused]] Bits b)
    {
        if constexpr (sizeof(Real) == 4)
            return static_cast<Real>(a >> 8) * Real(0x1p-24);
        else
            return (static_cast<Real>(a >> 5) * Real(0x1p26) + static_cast<Real>(b >> 6)) *
                   Real(0x1p-53);
    }

    /// Towards zero; x is within the range of int.
    REGAIN_INLINE static Index truncate(Real x) { return static_cast<int>(x); }
    REGAIN_INLINE static Real to_real(Index i) { return static_cast<Real>(i); }
    REGAIN_INLINE static Index at_most(Index i, int limit) { return i < limit ? i : limit; }

    /// data[i] and data[i + 1] as numbers.
    REGAIN_INLINE static void gather_pair(const std::uint16_t* data, Index i, Real& a, Real& b)
    {
#if REGAIN_HAS_SSE2
        if constexpr (sizeof(Real) == 4)
        {
            int pair;
            std::memcpy(&pair, data + i, sizeof pair);
            const __m128 both =
                _mm_cvtepi32_ps(_mm_unpacklo_epi16(_mm_cvtsi32_si128(pair), _mm_setzero_si128()));
            a = _mm_cvtss_f32(both);
            b = _mm_cvtss_f32(_mm_shuffle_ps(both, both, 1));
            return;
        }
#endif
        a = static_cast<Real>(data[i]);
        b = static_cast<Real>(data[i + 1]);
    }
};

template <class Real>
using MaskOf = typename NumberTraits<Real>::Mask;
template <class Real>
using ScalarOf = typename NumberTraits<Real>::Scalar;
template <class Real>
using IndexOf = typename NumberTraits<Real>::Index;
template <class Real>
using BitsOf = typename NumberTraits<Real>::Bits;

/// The functions by their own name, for all number types. A vector's library has some of the same
/// name, which the compiler prefers unless detail:: stands before: those of exponentials and
/// logarithms have to be called with it, for NumberTraits may know of more cases than the library.
namespace detail {

template <class T>
REGAIN_INLINE T select(const MaskOf<T>& mask, const T& a, const T& b)
{
    return NumberTraits<T>::select(mask, a, b);
}
template <class T>
REGAIN_INLINE MaskOf<T> quiet_less(const T& a, const T& b)
{
    return NumberTraits<T>::quiet_less(a, b);
}
template <class T>
REGAIN_INLINE T min(const T& a, const T& b)
{
    return NumberTraits<T>::min(a, b);
}
template <class T>
REGAIN_INLINE T max(const T& a, const T& b)
{
    return NumberTraits<T>::max(a, b);
}
template <class T>
REGAIN_INLINE T abs(const T& x)
{
    return NumberTraits<T>::abs(x);
}
template <class T>
REGAIN_INLINE T sqrt(const T& x)
{
    return NumberTraits<T>::sqrt(x);
}
template <class T>
REGAIN_INLINE T sin(const T& x)
{
    return NumberTraits<T>::sin(x);
}
template <class T>
REGAIN_INLINE T cos(const T& x)
{
    return NumberTraits<T>::cos(x);
}
/// x in [-1, 1].
template <class T>
REGAIN_INLINE T asin(const T& x)
{
    return NumberTraits<T>::asin(x);
}
template <class T>
REGAIN_INLINE T pow(const T& x, const T& y)
{
    return NumberTraits<T>::pow(x, y);
}
template <class T>
REGAIN_INLINE T exp(const T& x)
{
    return NumberTraits<T>::exp(x);
}
template <class T>
REGAIN_INLINE T log(const T& x)
{
    return NumberTraits<T>::log(x);
}
template <class T>
REGAIN_INLINE T expm1(const T& x)
{
    return NumberTraits<T>::expm1(x);
}
template <class T>
REGAIN_INLINE T log1p(const T& x)
{
    return NumberTraits<T>::log1p(x);
}
template <class T>
REGAIN_INLINE T erf(const T& x)
{
    return NumberTraits<T>::erf(x);
}
template <class T>
REGAIN_INLINE T erfc(const T& x)
{
    return NumberTraits<T>::erfc(x);
}

/// Both masks hold. The operator & says so too, but on two bools it is more often a slip.
template <class Real>
REGAIN_INLINE MaskOf<Real> both(const MaskOf<Real>& a, const MaskOf<Real>& b)
{
    return NumberTraits<Real>::both(a, b);
}

/// One mask holds and the other does not. The operators == and != of vectors' masks may compare
/// lanes as numbers, and one that is true is a NaN.
template <class Real>
REGAIN_INLINE MaskOf<Real> differ(const MaskOf<Real>& a, const MaskOf<Real>& b)
{
    const MaskOf<Real> first = both<Real>(a, !b), second = both<Real>(!a, b);
    return first | second;
}

/// Every lane, some lane.
template <class Real>
REGAIN_INLINE bool all(const MaskOf<Real>& mask)
{
    return NumberTraits<Real>::all(mask);
}
template <class Real>
REGAIN_INLINE bool any(const MaskOf<Real>& mask)
{
    return NumberTraits<Real>::any(mask);
}

/// A constant at the precision of Real.
template <class Real>
REGAIN_INLINE Real constant(double x)
{
    return Real(static_cast<ScalarOf<Real>>(x));
}

/// x limited to [lo, hi]; a NaN becomes `otherwise`. Raises no exception for a quiet NaN.
template <class Real>
REGAIN_INLINE Real sanitised(const Real& x, double lo, double hi, double otherwise)
{
    const Real low = constant<Real>(lo), high = constant<Real>(hi);
    // By far the most of it, and quickly told.
    if constexpr (std::is_floating_point_v<Real>)
        if (NumberTraits<Real>::is_within(x, low, high)) return x;
    // By ==: xsimd's != is false for a NaN where vectors are AVX's.
    const Real number = select(x == x, x, constant<Real>(otherwise));
    return select(quiet_less(number, low), low, select(quiet_less(high, number), high, number));
}

/// x limited to [lo, hi]; for what is known to be a number.
template <class Real>
REGAIN_INLINE Real clamped(const Real& x, double lo, double hi)
{
    return max(min(x, constant<Real>(hi)), constant<Real>(lo));
}

/// x limited to [0, 1]; a NaN becomes 0.
template <class Real>
REGAIN_INLINE Real saturate(const Real& x)
{
    return sanitised(x, 0, 1, 0);
}

}  // namespace detail

REGAIN_NAMESPACE_END
