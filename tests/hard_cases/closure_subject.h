// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A closure as a Subject. Of a closure for vectors the first lane takes the hard case and the
/// others stay ordinary: what they answer is compared with a vector in which all are ordinary, for
/// no lane may feel what stands in another.

#pragma once

#include "subject.h"

#include <regain/closures/xsimd.h>

namespace regain::tests {

using Batch = xsimd::batch<float>;

/// A number for a closure: `hard` in the first lane, `ordinary` in the rest.
template <class Number>
Number mixed(double hard, double ordinary)
{
    if constexpr (std::is_floating_point_v<Number>)
        return static_cast<Number>(hard);
    else
    {
        alignas(64) float lanes[Number::size];
        for (float& lane : lanes) lane = static_cast<float>(ordinary);
        lanes[0] = static_cast<float>(hard);
        return Number::load_aligned(lanes);
    }
}
template <class Number>
Color3<Number> mixed(const Color3<double>& hard, const Color3<double>& ordinary)
{
    return {mixed<Number>(hard.x, ordinary.x), mixed<Number>(hard.y, ordinary.y),
            mixed<Number>(hard.z, ordinary.z)};
}

/// A scalar closure.
template <class Closure>
class ClosureSubject : public Subject<typename Closure::Real>
{
public:
    using Real = typename Closure::Real;

    template <class Make>
    ClosureSubject(const Make& make, const Parameters& parameters) : _closure(make(parameters))
    {}

    Traits traits() const override { return _closure.traits(); }

protected:
    Color3<Real> do_eval(const Vec3<Real>& wo, const Vec3<Real>& wi,
                         const Vec3<Real>& u) const override
    {
        return evaluate(_closure.prepare(wo), wi, u);
    }
    Real do_pdf(const Vec3<Real>& wo, const Vec3<Real>& wi) const override
    {
        return _closure.pdf(wo, wi);
    }
    Sample<Real> do_sample(const Vec3<Real>& wo, const Vec3<Real>& u) const override
    {
        return _closure.prepare(wo).sample(u);
    }
    Albedo<Real> do_albedo(const Vec3<Real>& wo) const override
    {
        return _closure.prepare(wo).albedo();
    }

private:
    Closure _closure;
};

/// A closure for vectors of floats.
template <class Closure>
class LanesSubject : public Subject<float>
{
public:
    template <class Make>
    LanesSubject(const Make& make, const Parameters& parameters)
        : _closure(make(parameters)), _ordinary(make(Parameters()))
    {}

    Traits traits() const override { return _closure.traits(); }

protected:
    Color3<float> do_eval(const Vec3<float>& wo, const Vec3<float>& wi,
                          const Vec3<float>& u) const override
    {
        const auto f =
            evaluate(_closure.prepare(lanes(wo, away)), lanes(wi, towards), lanes(u, numbers));
        const auto calm = evaluate(_ordinary.prepare(lanes(away, away)), lanes(towards, towards),
                                   lanes(numbers, numbers));
        for (int i = 0; i < 3; ++i) undisturbed(f[i], calm[i], "eval");
        return {f.x.get(0), f.y.get(0), f.z.get(0)};
    }
    float do_pdf(const Vec3<float>& wo, const Vec3<float>& wi) const override
    {
        const Batch p = _closure.pdf(lanes(wo, away), lanes(wi, towards));
        undisturbed(p, _ordinary.pdf(lanes(away, away), lanes(towards, towards)), "pdf");
        return p.get(0);
    }
    Sample<float> do_sample(const Vec3<float>& wo, const Vec3<float>& u) const override
    {
        const auto s = _closure.prepare(lanes(wo, away)).sample(lanes(u, numbers));
        const auto calm = _ordinary.prepare(lanes(away, away)).sample(lanes(numbers, numbers));
        for (int i = 0; i < 3; ++i)
        {
            undisturbed(s.wi[i], calm.wi[i], "a sampled direction");
            undisturbed(s.weight[i], calm.weight[i], "the weight of a sample");
        }
        undisturbed(s.pdf, calm.pdf, "the pdf of a sample");
        Sample<float> first;
        first.wi = {s.wi.x.get(0), s.wi.y.get(0), s.wi.z.get(0)};
        first.weight = {s.weight.x.get(0), s.weight.y.get(0), s.weight.z.get(0)};
        first.pdf = s.pdf.get(0);
        first.valid = s.valid.get(0);
        first.delta = s.delta.get(0);
        first.transmitted = s.transmitted.get(0);
        return first;
    }
    Albedo<float> do_albedo(const Vec3<float>& wo) const override
    {
        const auto a = _closure.prepare(lanes(wo, away)).albedo();
        return {{a.reflect.x.get(0), a.reflect.y.get(0), a.reflect.z.get(0)},
                {a.transmit.x.get(0), a.transmit.y.get(0), a.transmit.z.get(0)}};
    }

private:
    static Vec3<Batch> lanes(const Vec3<float>& hard, const Vec3<float>& ordinary)
    {
        return {mixed<Batch>(hard.x, ordinary.x), mixed<Batch>(hard.y, ordinary.y),
                mixed<Batch>(hard.z, ordinary.z)};
    }
    // How many steps an iteration takes is decided by all lanes, so the last digits may differ.
    static void undisturbed(const Batch& mixed, const Batch& calm, const char* what)
    {
        for (std::size_t lane = 1; lane < Batch::size; ++lane)
        {
            const float a = mixed.get(lane), b = calm.get(lane);
            if (!is_finite(a) || std::abs(a - b) > 1e-5f * (1 + std::abs(b)))
                ADD_FAILURE() << what << " of another lane is " << a << " in place of " << b;
        }
    }

    inline static const Vec3<float> away{0.48f, 0.36f, 0.8f}, towards{-0.64f, 0.48f, 0.6f},
        numbers{0.3f, 0.6f, 0.2f};
    Closure _closure, _ordinary;
};

template <class Closure>
struct SubjectOf
{
    using type = std::conditional_t<std::is_floating_point_v<typename Closure::Real>,
                                    ClosureSubject<Closure>, LanesSubject<Closure>>;
};

/// The maker of a Kind, from a function of a parameters that returns the closure.
template <class Make>
auto maker_of(const Make& make)
{
    using Closure = decltype(make(Parameters()));
    using Real = ScalarOf<typename Closure::Real>;
    return [make](const Parameters& parameters) -> std::unique_ptr<Subject<Real>> {
        return std::make_unique<typename SubjectOf<Closure>::type>(make, parameters);
    };
}

}  // namespace regain::tests
