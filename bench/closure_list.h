// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Every closure by every method that goes with it: calls visit(lobe, method, bytes of tables,
/// make), where make(alpha) builds the closure as a host does at a shading point. Closures without
/// microfacets take alpha for their roughness.

#pragma once

#include "lobes.h"

#include <regain/closures/balanced_gain.h>
#include <regain/closures/bounded_dielectric_walk.h>
#include <regain/closures/bounded_walk.h>
#include <regain/closures/burley_diffuse.h>
#include <regain/closures/compensated.h>
#include <regain/closures/conty_kulla_sheen.h>
#include <regain/closures/dielectric_gain.h>
#include <regain/closures/dielectric_kulla_conty.h>
#include <regain/closures/dielectric_tail.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/closures/diffuse.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/layer.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/closures/sheen.h>
#include <regain/closures/translucent.h>
#include <regain/closures/transparent.h>
#include <regain/closures/walk.h>
#include <regain/closures/zeltner_sheen.h>

#include <string>

namespace regain::bench {

/// A mirror, lobe(alpha, tables), by the methods that take its place or add to it.
template <class Real, class Lobe, class Visit>
void visit_mirror(const std::string& name, const TableSets& tables, const Lobe& lobe,
                  const Visit& visit)
{
    const Real all(1);
    visit(name, "none", bytes_of(tables.albedo),
          [=, t = tables.albedo](const Real& alpha) { return lobe(alpha, t); });
    for (const Method method : all_methods)
        if (method != Method::none)
            visit(name, std::string(regain::name(method)), bytes_of(tables.albedo),
                  [=, t = tables.albedo](const Real& alpha) {
                      return build_compensated([&] { return lobe(alpha, t); }, method, t, all);
                  });
    visit(name, "directional", bytes_of(tables.directional),
          [=, t = tables.directional](const Real& alpha) {
              return build_directional([&] { return lobe(alpha, t); }, t, all);
          });
    visit(name, "balanced", bytes_of(tables.balanced), [=, t = tables.balanced](const Real& alpha) {
        return build_balanced([&] { return lobe(alpha, t); }, t, all);
    });
    for (const KullaContyForm form : all_kulla_conty_forms)
        visit(name, std::string(regain::name(form)), bytes_of(tables.albedo),
              [=, t = tables.albedo](const Real& alpha) {
                  return kulla_conty(lobe(alpha, t), form, t, all);
              });
    visit(name, "tail", bytes_of(tables.tail),
          [=, t = tables.tail](const Real& alpha) { return fitted_tail(lobe(alpha, t), t, all); });
    visit(name, "burley-sheen", bytes_of(tables.albedo),
          [=, t = tables.albedo](const Real& alpha) { return burley_sheen(lobe(alpha, t), all); });
    visit(name, "walk", bytes_of(tables.albedo), [=, t = tables.albedo](const Real& alpha) {
        const auto once = lobe(alpha, t);
        return Walk(once.distribution(), once.fresnel(), 1, t);
    });
    visit(name, "walk-bounded", bytes_of(tables.tail), [=, t = tables.tail](const Real& alpha) {
        const auto once = lobe(alpha, t);
        return BoundedWalk(once.distribution(), once.fresnel(), 1, t);
    });
}

/// The interface and the sheet. Tables of gtr and std interfaces are nobody's until somebody bakes
/// them: of these there is what needs none.
template <template <class> class Distribution, class Real, class Visit>
void visit_glass(const TableSets& tables, const Visit& visit)
{
    using L = Lobes<Distribution, Real>;
    using D = Distribution<Real>;
    const Real all(1);
    const Color3<Real> one(all);
    constexpr Method gains[] = {Method::normalise, Method::turquin};
    visit("sheet", "none", bytes_of(tables.albedo),
          [=, t = tables.albedo](const Real& alpha) { return L::sheet(alpha, t); });
    for (const Method method : gains)
        visit("sheet", std::string(name(method)), bytes_of(tables.albedo),
              [=, t = tables.albedo](const Real& alpha) {
                  return compensated(L::sheet(alpha, t), method, t, all);
              });
    visit("glass-beta", "walk", std::size_t(0), [=](const Real& alpha) {
        return DielectricWalk<D>(distribution_of<Distribution>(alpha), L::eta(), one, one);
    });
    visit("glass-beta", "walk-bounded", bytes_of(tables.beta) + bytes_of(tables.tail),
          [=, t = tables.beta, shape = tables.tail](const Real& alpha) {
              return BoundedDielectricWalk<D>(distribution_of<Distribution>(alpha), L::eta(), one,
                                              one, 1, t, shape);
          });
    for (const auto shadowing : {TransmissionShadowing::correlated, TransmissionShadowing::beta})
    {
        const bool beta = shadowing == TransmissionShadowing::beta;
        const std::string lobe = beta ? "glass-beta" : "glass";
        const DielectricTables& own = beta ? tables.beta : tables.correlated;
        visit(lobe, "none", bytes_of(own),
              [=, t = own](const Real& alpha) { return L::glass(alpha, shadowing, t); });
        if (!own) continue;
        for (const Method method : gains)
            visit(lobe, std::string(name(method)), bytes_of(own), [=, t = own](const Real& alpha) {
                return build_compensated([&] { return L::glass(alpha, shadowing, t); }, method, t,
                                         LossTables{}, all);
            });
        visit(lobe, "kulla-conty", bytes_of(own), [=, t = own](const Real& alpha) {
            return kulla_conty(L::glass(alpha, shadowing, t), t, all);
        });
    }
    if (tables.beta_tail)
        visit("glass-beta", "tail", bytes_of(tables.beta_tail),
              [=, t = tables.beta_tail](const Real& alpha) {
                  return fitted_tail(L::glass(alpha, TransmissionShadowing::beta, t), t, all);
              });
}

template <template <class> class Distribution, class Real, class Visit>
void visit_microfacets(const Visit& visit)
{
    using L = Lobes<Distribution, Real>;
    static const TableSets tables(Named<Distribution>::name);
    visit("white", "none", bytes_of(tables.albedo),
          [t = tables.albedo](const Real& alpha) { return L::white(alpha, t); });
    visit_mirror<Real>("schlick", tables, L::schlick, visit);
    visit_mirror<Real>("conductor", tables, L::conductor, visit);
    visit_glass<Distribution, Real>(tables, visit);
}

template <class Real, class Visit>
void visit_plain(const Visit& visit)
{
    const Color3<Real> grey(Real(0.5f));
    const auto plain = [&](const char* lobe, const auto& make) {
        visit(lobe, "none", std::size_t(0), make);
    };
    plain("diffuse", [=](const Real&) { return Diffuse<Real>(grey); });
    plain("oren-nayar", [=](const Real& a) { return OrenNayarDiffuse<Real>(grey, a); });
    plain("eon", [=](const Real& a) { return OrenNayarDiffuse<Real>(grey, a, true); });
    plain("burley-diffuse", [=](const Real& a) { return BurleyDiffuse<Real>(grey, a); });
    plain("translucent", [=](const Real&) { return Translucent<Real>(grey); });
    plain("transparent", [=](const Real&) { return Transparent<Real>(grey); });
    plain("burley-sheen", [=](const Real&) { return Sheen<Real>(Real(1), grey); });
    plain("conty-kulla-sheen", [=](const Real& a) { return ContyKullaSheen<Real>(grey, a); });
    plain("zeltner-sheen", [=](const Real& a) { return ZeltnerSheen<Real>(grey, a); });
    const TableSets tables("ggx");
    visit("schlick-over-diffuse", "turquin", bytes_of(tables.albedo),
          [=, t = tables.albedo](const Real& a) {
              const auto top = compensated(Lobes<GGX, Real>::schlick(a, t), Method::turquin, t);
              return layer(top, Diffuse<Real>(grey));
          });
}

}  // namespace regain::bench
