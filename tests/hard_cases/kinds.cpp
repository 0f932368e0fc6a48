// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "kinds.h"

#include "closure_subject.h"

#include <regain/closures/conductor.h>
#include <regain/closures/diffuse.h>
#include <regain/closures/sheen.h>
#include <regain/closures/sum.h>
#include <regain/luts/builtin.h>

namespace regain::tests {
namespace {

/// Lobes without a distribution, and a metal under sheen.
template <class Number>
void add_others(std::vector<Kind<ScalarOf<Number>>>& out)
{
    constexpr bool batch = !std::is_floating_point_v<Number>;
    const auto add = [&](const char* name, Lobe lobe, const char* distribution, const char* method,
                         const auto& make) {
        out.push_back({std::string(name) + (batch ? ", in vectors" : ""), lobe, distribution,
                       method, ScatterMode::R, TransmissionShadowing::correlated, batch,
                       maker_of(make)});
    };
    const Parameters ordinary;
    const auto sheen = [=](const Parameters& s) {
        return Sheen<Number>(mixed<Number>(s.sheen_weight, ordinary.sheen_weight),
                             mixed<Number>(s.sheen_color, ordinary.sheen_color));
    };
    add("diffuse", Lobe::diffuse, "", "none", [=](const Parameters& s) {
        return Diffuse<Number>(mixed<Number>(s.albedo, ordinary.albedo));
    });
    add("sheen", Lobe::sheen, "", "none", sheen);
    add("ggx conductor burley-sheen", Lobe::sheened, "ggx", "burley-sheen",
        [=](const Parameters& s) {
            const GGX<Number> ggx(mixed<Number>(s.alpha_x, ordinary.alpha_x),
                                  mixed<Number>(s.alpha_y, ordinary.alpha_y));
            const ConductorFresnel<Number> metal(mixed<Number>(s.n, ordinary.n),
                                                 mixed<Number>(s.k, ordinary.k));
            // A sum asks for albedos to choose by, which without tables are integrals.
            return sum(Conductor<Number>(ggx, metal, luts::ggx_tables()), sheen(s));
        });
}

template <class Real>
std::vector<Kind<Real>> all_kinds()
{
    std::vector<Kind<Real>> all;
    add_ggx(all);
#ifndef REGAIN_HARD_CASES_OF_GGX
    add_beckmann(all);
    add_gtr(all);
    add_std(all);
#endif
    add_others<Real>(all);
    if constexpr (sizeof(Real) == 4) add_others<Batch>(all);
    if (vectors_are_promised) return all;
    std::vector<Kind<Real>> scalars;
    for (const Kind<Real>& kind : all)
        if (!kind.batch) scalars.push_back(kind);
    return scalars;
}

}  // namespace

template <>
const std::vector<Kind<float>>& kinds<float>()
{
    static const std::vector<Kind<float>> all = all_kinds<float>();
    return all;
}
template <>
const std::vector<Kind<double>>& kinds<double>()
{
    static const std::vector<Kind<double>> all = all_kinds<double>();
    return all;
}

}  // namespace regain::tests
