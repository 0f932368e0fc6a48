// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The adapter for closures of Regain's own shape (closure.h), of float or double:
///
///     std::unique_ptr<TestedClosure> c = adapt(Diffuse<float>(Color3<float>(0.5f)));

#pragma once

#include <regain/conformance/tested_closure.h>

#include <cmath>
#include <memory>
#include <optional>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

template <class Closure>
class Adapted final : public TestedClosure
{
public:
    using Real = typename Closure::Real;

    explicit Adapted(const Closure& closure) : _closure(closure) {}

    Traits traits() const override { return _closure.traits(); }
    void prepare(const Direction& wo) override { _prepared.emplace(_closure.prepare(rounded(wo))); }

    Color eval(const Direction& wi, const Direction& u) const override
    {
        return Color(evaluate(*_prepared, rounded(wi), numbers(u)));
    }
    double pdf(const Direction& wi) const override
    {
        return static_cast<double>(_prepared->pdf(rounded(wi)));
    }
    Sample<double> sample(const Direction& u) const override
    {
        const Sample<Real> s = _prepared->sample(numbers(u));
        Sample<double> wide;
        wide.wi = Direction(s.wi);
        wide.weight = Color(s.weight);
        wide.pdf = static_cast<double>(s.pdf);
        wide.valid = s.valid;
        wide.delta = s.delta;
        wide.transmitted = s.transmitted;
        return wide;
    }
    Albedo<double> albedo() const override
    {
        const Albedo<Real> a = _prepared->albedo();
        return {Color(a.reflect), Color(a.transmit)};
    }

private:
    static Vec3<Real> rounded(const Direction& w)
    {
        return {static_cast<Real>(w.x), static_cast<Real>(w.y), static_cast<Real>(w.z)};
    }
    // A number below 1 stays below 1; anything else is passed on as it is.
    static Vec3<Real> numbers(const Direction& u)
    {
        Vec3<Real> r = rounded(u);
        for (int k = 0; k < 3; ++k)
            if (std::isless(u[k], 1.0) && !std::isless(r[k], Real(1)))
                r[k] = std::nextafter(Real(1), Real(0));
        return r;
    }

    Closure _closure;
    std::optional<typename Closure::Prepared> _prepared;
};

template <class Closure>
std::unique_ptr<TestedClosure> adapt(const Closure& closure)
{
    return std::make_unique<Adapted<Closure>>(closure);
}

}  // namespace conformance
REGAIN_NAMESPACE_END
