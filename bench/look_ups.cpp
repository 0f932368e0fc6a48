// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Look-ups in tables, of REGAIN_BENCH_NUMBER: by coordinates alone, and of what closures ask.

#include "measure.h"
#include "table_sets.h"

#include <memory>

namespace regain::bench {

namespace {

template <class Real, class F>
void add(const std::string& name, const F& look_up)
{
    benchmark::RegisterBenchmark(
        ("table/" + name + "/" + NumberName<Real>::value + "/look-up").c_str(),
        [=](benchmark::State& state) { loop<Real>(state, look_up); });
}

// x, y and so on in [0, 1) of the i-th input.
template <class Real>
Vec3<Real> place(std::size_t i)
{
    return inputs().sample_numbers.at<Real>(i);
}

template <template <class> class Distribution, class Real>
void add_albedos()
{
    const std::string name = Named<Distribution>::name;
    const TableSets tables(name);
    const auto axes = std::make_shared<TableAxes<Real>>(distribution_of<Distribution>(Real(0.5f)));
    add<Real>(name + "/E_ss", [=, t = tables.albedo](std::size_t i) {
        return t.albedo(*axes, inputs().above.wo.at<Real>(i).z);
    });
    add<Real>(name + "/q_ms", [=, t = tables.directional](std::size_t i) {
        return t.later_share(*axes, inputs().above.wo.at<Real>(i).z);
    });
    add<Real>(name + "/balance", [=, t = tables.balanced](std::size_t i) {
        return axes->directional(t.balance, inputs().above.wo.at<Real>(i).z);
    });
}

template <class Real>
void add_glass(const std::string& name, const DielectricTables& tables)
{
    for (const float eta : {1.5f, 1 / 1.5f})
    {
        const std::string side = eta > 1 ? "-outside" : "-inside";
        add<Real>("ggx/E_S-" + name + side, [=](std::size_t i) {
            return tables.albedo(Real(0.5f), Real(eta), inputs().above.wo.at<Real>(i).z);
        });
        add<Real>("ggx/R_share-" + name + side, [=](std::size_t i) {
            return tables.reflected_share(Real(0.5f), Real(eta), inputs().above.wo.at<Real>(i).z);
        });
    }
}

}  // namespace

template <class Real>
void add_look_ups()
{
    const TableSets ggx("ggx"), gtr("gtr");
    add<Real>("view/2-D", [t = ggx.albedo.E_ss](std::size_t i) {
        const Vec3<Real> at = place<Real>(i);
        return t.at(at.x, at.y);
    });
    add<Real>("view/3-D", [t = gtr.albedo.E_ss](std::size_t i) {
        const Vec3<Real> at = place<Real>(i);
        return t.at(at.x, at.y, at.z);
    });
    MicrofacetTables anisotropic[] = {ggx.albedo, gtr.albedo};
    luts::add_anisotropy(anisotropic[0], "ggx");
    luts::add_anisotropy(anisotropic[1], "gtr");
    for (const MicrofacetTables& t : anisotropic)
        add<Real>(t.anisotropy->size[4] > 1 ? "grid/5-D" : "grid/4-D",
                  [grid = *t.anisotropy](std::size_t i) {
                      const Vec3<Real> a = place<Real>(i), b = inputs().eval_numbers.at<Real>(i);
                      const Real at[] = {a.x, a.y, a.z, b.x, b.y};
                      return grid.at(at);
                  });
    add_albedos<GGX, Real>();
    add_albedos<Beckmann, Real>();
    add_albedos<GTR, Real>();
    add_albedos<STD, Real>();
    add_glass<Real>("correlated", ggx.correlated);
    add_glass<Real>("beta", ggx.beta);
}

template void add_look_ups<REGAIN_BENCH_NUMBER>();

}  // namespace regain::bench
