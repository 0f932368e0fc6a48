// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The benchmarks, each part in a file of its own because it takes long to compile, and each
/// compiled once per number type. Names are paths, the last parts of which are the number type
/// ("float", "avx2" or "avx512") and the question:
///
///     ggx/schlick/turquin/0.5/float/eval         distribution, lobe, method, alpha
///     plain/eon/none/0.5/avx2/sample             closures without microfacets
///     table/ggx/E_ss/float/look-up
///     threads/ggx/schlick/turquin/0.5/float/eval
///
/// Questions are construct (the closure, its gain with it), prepare, build (both), eval, sample,
/// pdf and albedo. The counter `points` says how many points an iteration is for; items are points.

#pragma once

#include <regain/closures/xsimd.h>

namespace regain::bench {

using Scalar = float;

template <class Real>
struct NumberName
{
    static constexpr const char* value = "float";
};

#if defined(__AVX512BW__) && defined(__AVX512CD__) && defined(__AVX512DQ__)
using Vector = xsimd::batch<float, xsimd::avx512bw>;
template <>
struct NumberName<Vector>
{
    static constexpr const char* value = "avx512";
};
#elif defined(__AVX2__) && defined(__FMA__)
using Vector = xsimd::batch<float, xsimd::fma3<xsimd::avx2>>;
template <>
struct NumberName<Vector>
{
    static constexpr const char* value = "avx2";
};
#endif

template <template <class> class Distribution, class Real>
void add_microfacets();
template <class Real>
void add_plain();
template <class Real>
void add_look_ups();

/// On 1, 2, 4 and so on threads up to the processor's number.
void add_threads();

}  // namespace regain::bench
