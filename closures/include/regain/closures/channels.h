// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Colours in the middle of a computation. What closures take and return is Imath's Color3, but
/// three floats are no length that processors have instructions for. ChannelsOf<float> holds four,
/// of which the last is a copy of the third: it meets what that one meets and raises no exception
/// of its own. Of double, and of vectors, it is Color3 itself. For both there are
///
///     channels(color), color(channels)      there and back
///     + - *                                 of two, and * with a number
///     per_channel(channels, f, more...)     f of each channel; where a processor does all at once,
///                                           f is asked about one number that stands for them
///
/// Each channel meets the same operations in the same order either way, so the bits are the same.

#pragma once

#include <regain/closures/vector.h>

#include <utility>

// Host code has them even where a GPU's compiler makes it: how a FourFloats is passed to functions
// depends on it, and one program may have parts by both.
#if defined(__SSE2__) && !defined(__CUDA_ARCH__) && !defined(__HIP_DEVICE_COMPILE__)
#include <emmintrin.h>
#define REGAIN_HAS_FOUR_FLOATS 1
#else
#define REGAIN_HAS_FOUR_FLOATS 0
#endif

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// Laid out alike on a GPU.
class FourFloats
{
public:
#if REGAIN_HAS_FOUR_FLOATS
    REGAIN_INLINE FourFloats() : _v(_mm_setzero_ps()) {}
    REGAIN_INLINE explicit FourFloats(float x) : _v(_mm_set1_ps(x)) {}
    REGAIN_INLINE explicit FourFloats(__m128 v) : _v(v) {}
    REGAIN_INLINE explicit FourFloats(const Color3<float>& c) : _v(_mm_set_ps(c.z, c.z, c.y, c.x))
    {}
    REGAIN_INLINE Color3<float> color() const
    {
        return {_mm_cvtss_f32(_v), _mm_cvtss_f32(_mm_shuffle_ps(_v, _v, 1)),
                _mm_cvtss_f32(_mm_movehl_ps(_v, _v))};
    }
    REGAIN_INLINE __m128 value() const { return _v; }

    struct Mask
    {
        __m128 bits;
    };
    friend REGAIN_INLINE Mask operator>(FourFloats a, FourFloats b)
    {
        return {_mm_cmpgt_ps(a._v, b._v)};
    }
    friend REGAIN_INLINE Mask operator>=(FourFloats a, FourFloats b)
    {
        return {_mm_cmpge_ps(a._v, b._v)};
    }

    friend REGAIN_INLINE FourFloats operator+(FourFloats a, FourFloats b)
    {
        return FourFloats(_mm_add_ps(a._v, b._v));
    }
    friend REGAIN_INLINE FourFloats operator-(FourFloats a, FourFloats b)
    {
        return FourFloats(_mm_sub_ps(a._v, b._v));
    }
    friend REGAIN_INLINE FourFloats operator*(FourFloats a, FourFloats b)
    {
        return FourFloats(_mm_mul_ps(a._v, b._v));
    }
    friend REGAIN_INLINE FourFloats operator/(FourFloats a, FourFloats b)
    {
        return FourFloats(_mm_div_ps(a._v, b._v));
    }

private:
    __m128 _v;
#else
    REGAIN_HOST_DEVICE FourFloats() : FourFloats(0.0f) {}
    REGAIN_HOST_DEVICE explicit FourFloats(float x) : _v{x, x, x, x} {}
    REGAIN_HOST_DEVICE explicit FourFloats(const Color3<float>& c) : _v{c.x, c.y, c.z, c.z} {}
    REGAIN_HOST_DEVICE Color3<float> color() const { return {_v[0], _v[1], _v[2]}; }

    friend REGAIN_HOST_DEVICE FourFloats operator+(const FourFloats& a, const FourFloats& b)
    {
        return FourFloats(a.color() + b.color());
    }
    friend REGAIN_HOST_DEVICE FourFloats operator-(const FourFloats& a, const FourFloats& b)
    {
        return FourFloats(a.color() - b.color());
    }
    friend REGAIN_HOST_DEVICE FourFloats operator*(const FourFloats& a, const FourFloats& b)
    {
        return FourFloats(a.color() * b.color());
    }

private:
    alignas(16) float _v[4];
#endif

public:
    friend REGAIN_INLINE FourFloats operator*(FourFloats a, float b) { return a * FourFloats(b); }
};

}  // namespace detail

#if REGAIN_HAS_FOUR_FLOATS
/// For functions of numbers that are asked about all channels at once: what such functions need.
template <>
struct NumberTraits<detail::FourFloats>
{
    using Four = detail::FourFloats;
    using Scalar = float;
    using Mask = detail::FourFloats::Mask;

    REGAIN_INLINE static Four select(Mask mask, Four a, Four b)
    {
        return Four(
            _mm_or_ps(_mm_and_ps(mask.bits, a.value()), _mm_andnot_ps(mask.bits, b.value())));
    }
    // Operands in the order in which a NaN, and a zero of either sign, comes out as of one float.
    REGAIN_INLINE static Four min(Four a, Four b) { return Four(_mm_min_ps(b.value(), a.value())); }
    REGAIN_INLINE static Four max(Four a, Four b) { return Four(_mm_max_ps(b.value(), a.value())); }
    REGAIN_INLINE static Four abs(Four x)
    {
        return Four(_mm_andnot_ps(_mm_set1_ps(-0.0f), x.value()));
    }
    REGAIN_INLINE static Four sqrt(Four x) { return Four(_mm_sqrt_ps(x.value())); }
};
#endif

namespace detail {

template <class Real>
struct Channels
{
    using Type = Color3<Real>;
};
template <>
struct Channels<float>
{
    using Type = FourFloats;
};
template <class Real>
using ChannelsOf = typename Channels<Real>::Type;

template <class Real>
REGAIN_INLINE const Color3<Real>& color(const Color3<Real>& c)
{
    return c;
}
REGAIN_INLINE Color3<float> color(const FourFloats& c) { return c.color(); }

template <class Real>
REGAIN_INLINE ChannelsOf<Real> channels(const Color3<Real>& c)
{
    return ChannelsOf<Real>(c);
}

REGAIN_INLINE FourFloats select(bool mask, const FourFloats& a, const FourFloats& b)
{
    return mask ? a : b;
}

/// f(channel of a, channel of each of `more`); f is a generic function of numbers.
template <class Real, class F, class... More>
REGAIN_INLINE Color3<Real> each_channel(const F& f, const Color3<Real>& a, const More&... more)
{
    return {f(a.x, more.x...), f(a.y, more.y...), f(a.z, more.z...)};
}
template <class F, class... More>
REGAIN_INLINE FourFloats each_channel(const F& f, const FourFloats& a, const More&... more)
{
#if REGAIN_HAS_FOUR_FLOATS
    return f(a, more...);
#else
    return FourFloats(each_channel(f, a.color(), more.color()...));
#endif
}

/// What a Fresnel term answers to at(mu), as channels; one that has them has channels_at(mu), too.
template <class Fresnel, class = void>
struct FresnelChannels
{
    using Real = typename Fresnel::Real;
    REGAIN_INLINE static ChannelsOf<Real> of(const Fresnel& fresnel, const Real& mu)
    {
        return channels(fresnel.at(mu));
    }
};
template <class Fresnel>
struct FresnelChannels<Fresnel, std::void_t<decltype(std::declval<const Fresnel&>().channels_at(
                                    typename Fresnel::Real(1)))>>
{
    using Real = typename Fresnel::Real;
    REGAIN_INLINE static ChannelsOf<Real> of(const Fresnel& fresnel, const Real& mu)
    {
        return fresnel.channels_at(mu);
    }
};
template <class Fresnel>
REGAIN_INLINE ChannelsOf<typename Fresnel::Real> fresnel_channels(const Fresnel& fresnel,
                                                                  const typename Fresnel::Real& mu)
{
    return FresnelChannels<Fresnel>::of(fresnel, mu);
}

/// Channels in [0, 1] of any colour; a NaN becomes 0. Raises no exception for a quiet NaN.
template <class Real>
REGAIN_INLINE Color3<Real> saturated_channels(const Color3<Real>& c)
{
    return per_channel(c, [](const Real& v) { return saturate(v); });
}
REGAIN_INLINE FourFloats saturated_channels(const Color3<float>& c)
{
#if REGAIN_HAS_FOUR_FLOATS
    const __m128 given = FourFloats(c).value();
    const __m128 number = _mm_and_ps(given, _mm_cmpord_ps(given, given));
    return FourFloats(_mm_max_ps(_mm_min_ps(number, _mm_set1_ps(1)), _mm_setzero_ps()));
#else
    return FourFloats(per_channel(c, [](float v) { return saturate(v); }));
#endif
}

}  // namespace detail

REGAIN_NAMESPACE_END
