// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// WideMaker of one distribution and one instruction set: what the files of this folder that are
/// compiled for each of them have in common. They may not leave code behind that the linker shares
/// with files for other processors: whatever is no template of the vector's type has to be inlined,
/// or be a member of a class in an unnamed namespace. A test looks into the objects.

#pragma once

#include <regain/closures/wide_closure.h>

#include "wide_sets.h"

REGAIN_NAMESPACE_BEGIN
namespace shaders { namespace wide { namespace {

#if defined(REGAIN_WIDE_SSE4_2)
using Arch = xsimd::sse4_2;
#elif defined(REGAIN_WIDE_AVX2)
using Arch = xsimd::fma3<xsimd::avx2>;
#elif defined(REGAIN_WIDE_AVX512)
using Arch = xsimd::avx512bw;
#elif defined(REGAIN_WIDE_NEON)
using Arch = xsimd::neon64;
#endif

using Real = xsimd::batch<float, Arch>;

/// With::call(material, strength, visit) calls visit with the material's closure in Real.
template <class With>
struct Makes
{
    static WidePoints* prepare(const WideMaker::Material& m, float strength, int points,
                               const WideSurface& surface, const WideMemory& memory)
    {
        return With::call(m, Real(strength), [&](const auto& closure) -> WidePoints* {
            return WideClosure<std::decay_t<decltype(closure)>>::create(closure, points, surface,
                                                                        memory);
        });
    }
    static constexpr WideMaker maker{int(Real::size), &prepare};
};

template <template <class> class Distribution>
struct WithDistribution
{
    template <class Visit>
    static decltype(auto) call(const WideMaker::Material& m, const Real& strength,
                               const Visit& visit)
    {
        return std::get_if<MicrofacetMaterial>(&m)->template with_closure_of<Distribution>(strength,
                                                                                           visit);
    }
};
struct WithPlain
{
    template <class Visit>
    static decltype(auto) call(const WideMaker::Material& m, const Real& strength,
                               const Visit& visit)
    {
        return std::get_if<PlainMaterial>(&m)->with_closure(strength, visit);
    }
};

}}}  // namespace shaders::wide
REGAIN_NAMESPACE_END
