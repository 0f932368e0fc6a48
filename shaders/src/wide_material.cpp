// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/wide_material.h>

#include "wide/wide_sets.h"

#include <algorithm>
#include <cstdlib>

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

constexpr struct
{
    InstructionSet set;
    std::string_view name;
} set_names[] = {{InstructionSet::scalar, "scalar"},
                 {InstructionSet::sse4_2, "sse4.2"},
                 {InstructionSet::avx2, "avx2"},
                 {InstructionSet::avx512, "avx512"},
                 {InstructionSet::neon, "neon"}};

// Of one instruction set.
struct Makers
{
    const WideMaker *ggx, *beckmann, *gtr, *std, *plain;

    const WideMaker* of(const ClosureTree::Material& material) const
    {
        const auto* m = std::get_if<MicrofacetMaterial>(&material);
        if (!m) return plain;
        switch (m->distribution)
        {
            case DistributionKind::beckmann: return beckmann;
            case DistributionKind::gtr: return gtr;
            case DistributionKind::std: return std;
            case DistributionKind::ggx: break;
        }
        return ggx;
    }
};

// Of distributions with a tail RegainWide.cmake builds those of one instruction set.
#ifdef REGAIN_HAS_SSE4_2
constexpr Makers sse4_2{&wide::ggx_sse4_2, &wide::beckmann_sse4_2, nullptr, nullptr,
                        &wide::plain_sse4_2};
#endif
#ifdef REGAIN_HAS_AVX2
constexpr Makers avx2{&wide::ggx_avx2, &wide::beckmann_avx2, &wide::gtr_avx2, &wide::std_avx2,
                      &wide::plain_avx2};
#endif
#ifdef REGAIN_HAS_AVX512
constexpr Makers avx512{&wide::ggx_avx512, &wide::beckmann_avx512, &wide::gtr_avx2, &wide::std_avx2,
                        &wide::plain_avx512};
#endif
#ifdef REGAIN_HAS_NEON
constexpr Makers neon{&wide::ggx_neon, &wide::beckmann_neon, &wide::gtr_neon, &wide::std_neon,
                      &wide::plain_neon};
#endif

// Null of what was not built.
const Makers* makers_of([[maybe_unused]] InstructionSet set)
{
    switch (set)
    {
#ifdef REGAIN_HAS_SSE4_2
        case InstructionSet::sse4_2: return &sse4_2;
#endif
#ifdef REGAIN_HAS_AVX2
        case InstructionSet::avx2: return &avx2;
#endif
#ifdef REGAIN_HAS_AVX512
        case InstructionSet::avx512: return &avx512;
#endif
#ifdef REGAIN_HAS_NEON
        case InstructionSet::neon: return &neon;
#endif
        default: return nullptr;
    }
}

// What the processor has and the operating system keeps.
bool runs_here(InstructionSet set)
{
    switch (set)
    {
#if defined(__x86_64__) || defined(__i386__)
        case InstructionSet::sse4_2: return __builtin_cpu_supports("sse4.2");
        case InstructionSet::avx2:
            return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
        case InstructionSet::avx512:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512vl");
#endif
        case InstructionSet::neon:  // every processor that it is built for has it
        case InstructionSet::scalar: return true;
        default: return false;
    }
}

bool is_to_be_had(InstructionSet set)
{
    const auto& sets = instruction_sets();
    return std::find(sets.begin(), sets.end(), set) != sets.end();
}

}  // namespace

std::string_view name(InstructionSet set)
{
    for (const auto& known : set_names)
        if (known.set == set) return known.name;
    return "";
}

std::optional<InstructionSet> instruction_set_named(std::string_view wanted)
{
    for (const auto& known : set_names)
        if (known.name == wanted) return known.set;
    return std::nullopt;
}

const std::vector<InstructionSet>& instruction_sets()
{
    static const std::vector<InstructionSet> sets = [] {
        std::vector<InstructionSet> found{InstructionSet::scalar};
        for (const auto& known : set_names)
            if (makers_of(known.set) && runs_here(known.set)) found.push_back(known.set);
        return found;
    }();
    return sets;
}

InstructionSet preferred_instruction_set()
{
    static const InstructionSet preferred = [] {
        if (const char* wanted = std::getenv("REGAIN_INSTRUCTION_SET"))
            if (const auto set = instruction_set_named(wanted); set && is_to_be_had(*set))
                return *set;
        return instruction_sets().back();
    }();
    return preferred;
}

const WideMaker* wide_maker(const ClosureTree::Material& material, InstructionSet set)
{
    const Makers* makers = is_to_be_had(set) ? makers_of(set) : nullptr;
    return makers ? makers->of(material) : nullptr;
}

}  // namespace shaders
REGAIN_NAMESPACE_END
