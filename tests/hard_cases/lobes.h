// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The kinds of one distribution: each lobe with each method that docs/support.md lists for it.

#pragma once

#include "../support/coarse_glass.h"
#include "closure_subject.h"

#include <regain/closures/balanced_gain.h>
#include <regain/closures/bounded_dielectric_walk.h>
#include <regain/closures/bounded_walk.h>
#include <regain/closures/conductor.h>
#include <regain/closures/dielectric_gain.h>
#include <regain/closures/dielectric_kulla_conty.h>
#include <regain/closures/dielectric_tail.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/generalized_schlick.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/thin_dielectric.h>
#include <regain/closures/walk.h>
#include <regain/luts/library.h>

namespace regain::tests {

template <class Distribution>
class KindsOf
{
public:
    using Number = typename Distribution::Real;
    using Real = ScalarOf<Number>;
    static constexpr bool batch = !std::is_floating_point_v<Number>;

    KindsOf(std::vector<Kind<Real>>& out, const std::string& distribution)
        : _out(out), _name(distribution)
    {}

    void add_all()
    {
        const std::string d = _name;
        for (Method method : all_methods)
        {
            add(Lobe::conductor, name(method), [=](const Parameters& s) {
                return compensated(conductor(s), method, mirror_tables(d), strength(s));
            });
            add(Lobe::schlick, name(method), [=](const Parameters& s) {
                return compensated(schlick(s), method, mirror_tables(d), strength(s));
            });
        }
        add(Lobe::schlick, "directional", [=](const Parameters& s) {
            MicrofacetTables tables = mirror_tables(d);
            luts::add_later_bounces(tables, d);
            return directional(schlick(s), tables, strength(s));
        });
        add(Lobe::schlick, "balanced", [=](const Parameters& s) {
            MicrofacetTables tables = mirror_tables(d);
            luts::add_later_bounces(tables, d);
            luts::add_balance(tables, d);
            luts::add_balance_anisotropy(tables, d);
            return balanced(schlick(s), tables, strength(s));
        });
        for (KullaContyForm form : all_kulla_conty_forms)
            add(Lobe::schlick, name(form), [=](const Parameters& s) {
                return kulla_conty(schlick(s), form, mirror_tables(d), strength(s));
            });
        add(Lobe::schlick, "tail", [=](const Parameters& s) {
            MicrofacetTables tables = mirror_tables(d);
            luts::add_later_bounces(tables, d);
            luts::add_later_shape(tables, d);
            return fitted_tail(schlick(s), tables, strength(s));
        });
        add_glass();
        if (!Distribution::has_tail) add_glass_tail();
        add(Lobe::schlick, "walk", [=](const Parameters& s) {
            return Walk<Distribution, SchlickFresnel<Number>>(distribution(s), schlick_curve(s), 1,
                                                              mirror_tables(d));
        });
        add(Lobe::schlick, "walk-bounded", [=](const Parameters& s) {
            MicrofacetTables tables = mirror_tables(d);
            luts::add_later_bounces(tables, d);
            luts::add_later_shape(tables, d);
            return BoundedWalk<Distribution, SchlickFresnel<Number>>(distribution(s),
                                                                     schlick_curve(s), 1, tables);
        });
        add(Lobe::dielectric, "walk-bounded", ScatterMode::RT, TransmissionShadowing::beta,
            [=](const Parameters& s) {
                MicrofacetTables tables = mirror_tables(d);
                luts::add_later_shape(tables, d);
                return BoundedDielectricWalk<Distribution>(
                    distribution(s), number(s, &Parameters::eta),
                    color(s, &Parameters::reflection_tint),
                    color(s, &Parameters::transmission_tint), 1,
                    glass_tables(d, TransmissionShadowing::beta), tables);
            });
        add(Lobe::dielectric, "walk", ScatterMode::RT, TransmissionShadowing::beta,
            [=](const Parameters& s) {
                return DielectricWalk<Distribution>(distribution(s), number(s, &Parameters::eta),
                                                    color(s, &Parameters::reflection_tint),
                                                    color(s, &Parameters::transmission_tint));
            });
    }

private:
    void add_glass()
    {
        const std::string d = _name;
        const auto correlated = TransmissionShadowing::correlated;
        for (ScatterMode mode : {ScatterMode::R, ScatterMode::T, ScatterMode::RT})
            for (Method method : {Method::none, Method::turquin})
            {
                for (auto shadowing : {correlated, TransmissionShadowing::beta})
                    add(Lobe::dielectric, name(method), mode, shadowing, [=](const Parameters& s) {
                        return compensated(dielectric(s, mode, shadowing), method,
                                           glass_tables(d, shadowing), mirror_tables(d),
                                           strength(s));
                    });
                add(Lobe::sheet, name(method), mode, correlated, [=](const Parameters& s) {
                    return compensated(
                        ThinDielectric<Distribution>(distribution(s), number(s, &Parameters::eta),
                                                     mode, color(s, &Parameters::reflection_tint),
                                                     color(s, &Parameters::transmission_tint)),
                        method, mirror_tables(d), strength(s));
                });
            }
        for (auto shadowing : {correlated, TransmissionShadowing::beta})
            add(Lobe::dielectric, "kulla-conty", ScatterMode::RT, shadowing,
                [=](const Parameters& s) {
                    return kulla_conty(dielectric(s, ScatterMode::RT, shadowing),
                                       glass_tables(d, shadowing), strength(s));
                });
    }

    void add_glass_tail()
    {
        const std::string d = _name;
        const auto beta = TransmissionShadowing::beta;
        add(Lobe::dielectric, "tail", ScatterMode::RT, beta, [=](const Parameters& s) {
            DielectricTables tables = glass_tables(d, beta);
            luts::add_later_split(tables, d);
            return fitted_tail(dielectric(s, ScatterMode::RT, beta), tables, strength(s));
        });
    }

    template <class Make>
    void add(Lobe lobe, std::string_view method, const Make& make)
    {
        add(lobe, method, ScatterMode::R, TransmissionShadowing::correlated, make);
    }
    template <class Make>
    void add(Lobe lobe, std::string_view method, ScatterMode mode, TransmissionShadowing shadowing,
             const Make& make)
    {
        static constexpr const char* lobes[] = {"conductor", "schlick", "dielectric", "sheet"};
        static constexpr const char* modes[] = {" R", " T", " RT"};
        std::string full = _name + " " + lobes[int(lobe)];
        if (lobe == Lobe::dielectric || lobe == Lobe::sheet) full += modes[int(mode)];
        if (shadowing == TransmissionShadowing::beta) full += " beta";
        full += " " + std::string(method) + (batch ? ", in vectors" : "");
        _out.push_back(
            {full, lobe, _name, std::string(method), mode, shadowing, batch, maker_of(make)});
    }

    static Number number(const Parameters& s, double Parameters::*member)
    {
        return mixed<Number>(s.*member, Parameters().*member);
    }
    static Color3<Number> color(const Parameters& s, Color3<double> Parameters::*member)
    {
        return mixed<Number>(s.*member, Parameters().*member);
    }
    static Number strength(const Parameters& s) { return number(s, &Parameters::strength); }
    static Distribution distribution(const Parameters& s)
    {
        const Number x = number(s, &Parameters::alpha_x), y = number(s, &Parameters::alpha_y);
        if constexpr (Distribution::has_tail)
            return Distribution(x, y, number(s, &Parameters::gamma));
        else
            return Distribution(x, y);
    }
    static Conductor<Number, Distribution> conductor(const Parameters& s)
    {
        return {distribution(s),
                ConductorFresnel<Number>(color(s, &Parameters::n), color(s, &Parameters::k))};
    }
    static SchlickFresnel<Number> schlick_curve(const Parameters& s)
    {
        return SchlickFresnel<Number>(color(s, &Parameters::color0), color(s, &Parameters::color82),
                                      color(s, &Parameters::color90),
                                      number(s, &Parameters::exponent));
    }
    static GeneralizedSchlick<Number, Distribution> schlick(const Parameters& s)
    {
        return {distribution(s), schlick_curve(s)};
    }
    static Dielectric<Distribution> dielectric(const Parameters& s, ScatterMode mode,
                                               TransmissionShadowing shadowing)
    {
        return {distribution(s),
                number(s, &Parameters::eta),
                mode,
                color(s, &Parameters::reflection_tint),
                color(s, &Parameters::transmission_tint),
                shadowing};
    }
    static MicrofacetTables mirror_tables(const std::string& distribution)
    {
        MicrofacetTables tables = luts::microfacet_tables(distribution);
        luts::add_anisotropy(tables, distribution);
        return tables;
    }
    static DielectricTables glass_tables(const std::string& distribution,
                                         TransmissionShadowing shadowing)
    {
        if (Distribution::has_tail) return coarse_dielectric_tables();
        DielectricTables tables = luts::dielectric_tables(distribution, shadowing);
        luts::add_anisotropy(tables, distribution, shadowing);
        return tables;
    }

    std::vector<Kind<Real>>& _out;
    std::string _name;
};

}  // namespace regain::tests
