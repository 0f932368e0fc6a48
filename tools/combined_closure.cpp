// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "combined_closure.h"

#include "errors.h"

#include <algorithm>
#include <cmath>

namespace regain::tools {
namespace {

ColorD total(const Albedo<double>& a) { return a.reflect + a.transmit; }

// f = w_1 f_1 + w_2 f_2, sampled as sum.h does.
class Combined final : public AnyClosure
{
public:
    Combined(const Combination& combination, std::unique_ptr<AnyClosure> first,
             std::unique_ptr<AnyClosure> second)
        : _kind(combination.kind),
          _constant(combination.weight),
          _first(std::move(first)),
          _second(std::move(second))
    {}

    Traits traits() const override
    {
        Traits t = _first->traits();
        t.random_numbers = 3;
        if (!_second) return t;
        const Traits other = _second->traits();
        t.reciprocal = t.reciprocal && other.reciprocal && _kind != CombinationKind::layer;
        t.energy_preserving = false;
        t.exact_pdf = t.exact_pdf && other.exact_pdf;
        t.delta = t.delta || other.delta;
        t.transmissive = t.transmissive || other.transmissive;
        t.anisotropic = t.anisotropic || other.anisotropic;
        return t;
    }

    void prepare(const Imath::V3d& wo) override
    {
        _first->prepare(wo);
        const Albedo<double> first = _first->albedo();
        _weight[0] = _weight[1] = ColorD(1.0);
        if (_kind == CombinationKind::multiply || _kind == CombinationKind::mix)
            _weight[0] = _constant;
        if (_kind == CombinationKind::mix) _weight[1] = ColorD(1.0) - _constant;
        if (_kind == CombinationKind::layer)
            for (int c = 0; c < 3; ++c) _weight[1][c] = 1 - std::clamp(total(first)[c], 0.0, 1.0);
        _albedo = {first.reflect * _weight[0], first.transmit * _weight[0]};
        _p = 1;
        if (!_second) return;

        _second->prepare(wo);
        const Albedo<double> second = _second->albedo();
        const ColorD a = total(first) * _weight[0], b = total(second) * _weight[1];
        const double one = a.x + a.y + a.z, other = b.x + b.y + b.z;
        // An estimate is no reason to starve a lobe.
        if (other > 0) _p = one > 0 ? std::clamp(one / (one + other), least, 1 - least) : 0;
        _albedo.reflect += second.reflect * _weight[1];
        _albedo.transmit += second.transmit * _weight[1];
    }

    ColorD eval(const Imath::V3d& wi, const Imath::V3d& u) const override
    {
        ColorD value = _first->eval(wi, u) * _weight[0];
        if (_second) value += _second->eval(wi, u) * _weight[1];
        return value;
    }

    double pdf(const Imath::V3d& wi) const override
    {
        if (_p == 1) return _first->pdf(wi);
        return _p * _first->pdf(wi) + (1 - _p) * _second->pdf(wi);
    }

    Sample<double> sample(const Imath::V3d& u) const override
    {
        if (!_second)
        {
            Sample<double> s = _first->sample(u);
            s.weight *= _weight[0];
            return s;
        }
        // A number that is none is 0.
        const double pick = regain::detail::saturate(u.z);
        const bool first = pick < _p || _p == 1;
        const double chosen = first ? _p : 1 - _p;
        const double z = std::clamp((first ? pick : pick - _p) / chosen, 0.0, last);
        Sample<double> s = (first ? *_first : *_second).sample(Imath::V3d(u.x, u.y, z));
        if (!s.valid) return s;
        if (s.delta)
        {
            s.weight = s.weight * _weight[first ? 0 : 1] / chosen;
            s.pdf *= chosen;
            return s;
        }
        s.pdf = pdf(s.wi);
        s.valid = s.pdf > 0;
        s.weight = s.valid ? eval(s.wi, u) / s.pdf : ColorD(0.0);
        return s;
    }

    Albedo<double> albedo() const override { return _albedo; }

    GainAnswer gain(const std::optional<Imath::V3d>&) const override
    {
        throw BadInput(
            "what is combined of closures has no gain of its own: ask for those of its "
            "parts");
    }
    int bounces(const Imath::V3d&) const override { return 1; }

private:
    static constexpr double least = 1.0 / 32, last = 1 - 0x1p-53;

    CombinationKind _kind;
    ColorD _constant;
    std::unique_ptr<AnyClosure> _first, _second;
    ColorD _weight[2];
    Albedo<double> _albedo{ColorD(0.0), ColorD(0.0)};
    double _p = 1;
};

}  // namespace

std::unique_ptr<AnyClosure> make_combined_closure(const ClosureSpec& spec)
{
    const Combination& c = *spec.combination;
    const auto part = [&](const std::shared_ptr<const ClosureSpec>& of) {
        if (!of) return std::unique_ptr<AnyClosure>();
        ClosureSpec whole = *of;
        whole.precision = spec.precision;
        whole.transport = spec.transport;
        // Albedos are asked for with every direction.
        return make_closure(whole, true);
    };
    return std::make_unique<Combined>(c, part(c.first), part(c.second));
}

}  // namespace regain::tools
