// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The WideMaker of every distribution and instruction set that may have been built.

#pragma once

#include <regain/shaders/wide_material.h>

REGAIN_NAMESPACE_BEGIN
namespace shaders { namespace wide {

#define REGAIN_WIDE_MAKERS(set) \
    extern const WideMaker ggx_##set, beckmann_##set, gtr_##set, std_##set, plain_##set

REGAIN_WIDE_MAKERS(sse4_2);
REGAIN_WIDE_MAKERS(avx2);
REGAIN_WIDE_MAKERS(avx512);
REGAIN_WIDE_MAKERS(neon);

#undef REGAIN_WIDE_MAKERS

/// The name of a maker in the file that is compiled for a set.
#if defined(REGAIN_WIDE_SSE4_2)
#define REGAIN_WIDE(distribution) distribution##_sse4_2
#elif defined(REGAIN_WIDE_AVX2)
#define REGAIN_WIDE(distribution) distribution##_avx2
#elif defined(REGAIN_WIDE_AVX512)
#define REGAIN_WIDE(distribution) distribution##_avx512
#elif defined(REGAIN_WIDE_NEON)
#define REGAIN_WIDE(distribution) distribution##_neon
#endif

}}  // namespace shaders::wide
REGAIN_NAMESPACE_END
