// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "c_subject.h"

#include <cmath>
#include <limits>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

static_assert(REGAIN_WHITE == static_cast<int>(Reflectance::white) &&
              REGAIN_SCHLICK == static_cast<int>(Reflectance::schlick) &&
              REGAIN_CONDUCTOR == static_cast<int>(Reflectance::conductor));
static_assert(REGAIN_FORM_NONE == static_cast<int>(Form::none) &&
              REGAIN_FORM_GAIN == static_cast<int>(Form::gain) &&
              REGAIN_FORM_ADDED == static_cast<int>(Form::added_lobe) &&
              REGAIN_FORM_REPLACED == static_cast<int>(Form::replaced) &&
              REGAIN_FORM_PAIR_GAIN == static_cast<int>(Form::pair_gain));

struct Three
{
    double x[3];
    explicit Three(const Direction& w) : x{w.x, w.y, w.z} {}
    operator const double*() const { return x; }
};

void copy(const Color& from, double to[3])
{
    for (int k = 0; k < 3; ++k) to[k] = from[k];
}
Color color(const double x[3]) { return {x[0], x[1], x[2]}; }

regain_parameters_v1 in_c(const Parameters& p)
{
    regain_parameters_v1 c = {};
    c.alpha_x = p.alpha_x;
    c.alpha_y = p.alpha_y;
    c.gamma = p.gamma;
    c.eta = p.eta;
    copy(p.F0, c.F0);
    copy(p.F82, c.F82);
    copy(p.n, c.n);
    copy(p.k, c.k);
    c.reflectance = static_cast<int32_t>(p.reflectance);
    c.in_double = p.in_double;
    return c;
}

class CClosure final : public TestedClosure
{
public:
    CClosure(const regain_subject_v1& c, std::shared_ptr<void> library, const Parameters& p)
        : _c(c), _library(std::move(library))
    {
        const regain_parameters_v1 parameters = in_c(p);
        _closure = _c.create(&parameters);
    }
    CClosure(const CClosure&) = delete;
    CClosure& operator=(const CClosure&) = delete;
    ~CClosure() override
    {
        if (_closure) _c.destroy(_closure);
    }

    Traits traits() const override
    {
        regain_traits_v1 t = {};
        t.random_numbers = 3;
        if (_closure) _c.traits(_closure, &t);
        Traits traits;
        traits.reciprocal = t.reciprocal;
        traits.energy_preserving = t.energy_preserving;
        traits.exact_pdf = t.exact_pdf;
        traits.stochastic_eval = t.stochastic_eval;
        traits.delta = t.delta;
        traits.transmissive = t.transmissive;
        traits.anisotropic = t.anisotropic;
        traits.random_numbers = t.random_numbers;
        return traits;
    }

    void prepare(const Direction& wo) override { _wo = wo; }

    // What was not written stays NaN, and is found out.
    Color eval(const Direction& wi, const Direction& u) const override
    {
        double f[3] = {nan, nan, nan};
        if (_closure) _c.eval(_closure, Three(_wo), Three(wi), Three(u), f);
        return color(f);
    }
    double pdf(const Direction& wi) const override
    {
        return _closure ? _c.pdf(_closure, Three(_wo), Three(wi)) : nan;
    }
    Sample<double> sample(const Direction& u) const override
    {
        Sample<double> sample;
        if (!_closure)
        {
            sample.wi = Direction(nan);
            sample.weight = Color(nan);
            sample.pdf = nan;
            sample.valid = true;
            return sample;
        }
        regain_sample_v1 s = {};
        _c.sample(_closure, Three(_wo), Three(u), &s);
        sample.wi = Direction(s.wi[0], s.wi[1], s.wi[2]);
        sample.weight = color(s.weight);
        sample.pdf = s.pdf;
        sample.valid = s.valid;
        sample.delta = s.delta;
        sample.transmitted = s.transmitted;
        return sample;
    }
    Albedo<double> albedo() const override
    {
        regain_albedo_v1 a = {{nan, nan, nan}, {nan, nan, nan}};
        if (_closure) _c.albedo(_closure, Three(_wo), &a);
        return {color(a.reflect), color(a.transmit)};
    }

private:
    const regain_subject_v1& _c;
    std::shared_ptr<void> _library;
    void* _closure = nullptr;
    Direction _wo{0, 0, 1};
};

std::optional<double> promised(double x)
{
    return std::isnan(x) ? std::nullopt : std::optional<double>(x);
}

}  // namespace

CSubject::CSubject(const regain_subject_v1& c, std::shared_ptr<void> library)
    : _c(c), _library(std::move(library))
{}

Reads CSubject::reads() const
{
    const regain_reads_v1& c = _c.reads;
    Reads r;
    r.alpha = c.alpha;
    r.two_alphas = c.two_alphas;
    r.gamma = c.gamma;
    if (r.gamma)
    {
        r.lowest_gamma = c.lowest_gamma;
        r.highest_gamma = c.highest_gamma;
    }
    r.eta = c.eta;
    r.one_medium = c.one_medium;
    r.schlick = c.schlick;
    r.conductor = c.conductor;
    r.single = c.in_float;
    r.twice = c.in_double;
    return r;
}

std::unique_ptr<TestedClosure> CSubject::make(const Parameters& p) const
{
    return std::make_unique<CClosure>(_c, _library, p);
}

Promises CSubject::promises(const Parameters& p, const Direction& wo) const
{
    regain_promises_v1 c = _c.promises;
    if (_c.promises_at)
    {
        const regain_parameters_v1 parameters = in_c(p);
        _c.promises_at(&parameters, Three(wo), &c);
    }
    Promises out;
    out.surplus = promised(c.surplus);
    out.furnace = promised(c.furnace);
    out.albedo = promised(c.albedo);
    out.tint = promised(c.tint);
    out.weight = promised(c.weight);
    if (c.single > 0) out.single = c.single;
    if (c.albedo_noise > 0) out.albedo_noise = c.albedo_noise;
    if (c.pdf > 0) out.pdf = c.pdf;
    return out;
}

}  // namespace conformance
REGAIN_NAMESPACE_END
