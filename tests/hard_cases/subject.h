// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Any closure behind one interface, so that each hard case runs over all of them and each closure
/// is compiled once. What comes out of a subject has been examined (examined.h), and where the
/// program is built with REGAIN_HARD_CASES_TRAPS, floating-point exceptions stopped the program
/// while the library ran.

#pragma once

#include "../support/trapped.h"
#include "examined.h"
#include "parameters.h"

#include <regain/closures/dielectric.h>
#include <regain/closures/method_gain.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace regain::tests {

#ifdef REGAIN_HARD_CASES_TRAPS
using WhileLibraryRuns = Trapped;
#else
struct WhileLibraryRuns
{
    WhileLibraryRuns() {}
};
#endif

template <class Real>
class Subject
{
public:
    virtual ~Subject() = default;

    virtual Traits traits() const = 0;

    /// u is read where the closure's eval is an estimate.
    Color3<Real> eval(const Vec3<Real>& wo, const Vec3<Real>& wi,
                      const Vec3<Real>& u = {Real(0.3), Real(0.6), Real(0.2)}) const
    {
        const Color3<Real> f = guarded([&] { return do_eval(wo, wi, u); });
        examine(f, "eval");
        return f;
    }
    Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        const Real p = guarded([&] { return do_pdf(wo, wi); });
        examine(p, "pdf");
        return p;
    }
    Sample<Real> sample(const Vec3<Real>& wo, const Vec3<Real>& u) const
    {
        const Sample<Real> s = guarded([&] { return do_sample(wo, u); });
        examine(s);
        return s;
    }
    Albedo<Real> albedo(const Vec3<Real>& wo) const
    {
        const Albedo<Real> a = guarded([&] { return do_albedo(wo); });
        examine(a);
        return a;
    }

protected:
    virtual Color3<Real> do_eval(const Vec3<Real>& wo, const Vec3<Real>& wi,
                                 const Vec3<Real>& u) const = 0;
    virtual Real do_pdf(const Vec3<Real>& wo, const Vec3<Real>& wi) const = 0;
    virtual Sample<Real> do_sample(const Vec3<Real>& wo, const Vec3<Real>& u) const = 0;
    virtual Albedo<Real> do_albedo(const Vec3<Real>& wo) const = 0;

private:
    template <class F>
    static auto guarded(const F& f)
    {
        const WhileLibraryRuns guard;
        return f();
    }
};

enum class Lobe { conductor, schlick, dielectric, sheet, diffuse, sheen, sheened };

/// One lobe with one method on one distribution in one number type.
template <class Real>
struct Kind
{
    std::string name;  ///< of all that follows
    Lobe lobe;
    std::string distribution;  ///< "ggx", "beckmann", "gtr", "std", or empty
    std::string method;        ///< as on the command line
    ScatterMode mode = ScatterMode::R;
    TransmissionShadowing shadowing = TransmissionShadowing::correlated;
    bool batch = false;  ///< a vector of floats, of which this is the first lane
    std::function<std::unique_ptr<Subject<Real>>(const Parameters&)> maker;

    std::unique_ptr<Subject<Real>> make(const Parameters& parameters) const
    {
        const WhileLibraryRuns guard;
        return maker(parameters);
    }

    bool is_mirror() const { return lobe == Lobe::conductor || lobe == Lobe::schlick; }
    bool has_two_sides() const { return lobe == Lobe::dielectric || lobe == Lobe::sheet; }
    bool has_tail() const { return distribution == "gtr" || distribution == "std"; }
    bool is_walk() const { return method.rfind("walk", 0) == 0; }
    bool is_bare() const { return method == "none"; }
    bool has_added_lobe() const { return method == "tail" || method.rfind("kulla-conty", 0) == 0; }
};

/// Every combination that docs/support.md lists; of vectors, those of the shortest code.
template <class Real>
const std::vector<Kind<Real>>& kinds();

/// f(kind) of each kind for which wanted(kind).
template <class Real, class Wanted, class F>
void for_each_kind(const Wanted& wanted, const F& f)
{
    int met = 0;
    for (const Kind<Real>& kind : kinds<Real>())
    {
        if (!wanted(kind)) continue;
        ++met;
        SCOPED_TRACE(kind.name);
        f(kind);
    }
    ASSERT_GT(met, 0) << "nothing was tested";
}
template <class Real, class F>
void for_each_kind(const F& f)
{
    for_each_kind<Real>([](const auto&) { return true; }, f);
}

}  // namespace regain::tests
