// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What is asked of every closure that reads up to three random numbers.

#pragma once

#include "closures.h"

#include <regain/closures/xsimd.h>

#include <gtest/gtest.h>

namespace regain::tests {

/// Points of the unit cube that fill it evenly (the Kronecker sequence R3, Roberts 2018).
class EvenCube
{
public:
    Vec3<double> next()
    {
        const double step[] = {0.8191725133961644, 0.6710436067037893, 0.5497004779019703};
        for (int k = 0; k < 3; ++k)
        {
            _u[k] += step[k];
            if (_u[k] >= 1) _u[k] -= 1;
        }
        return _u;
    }

private:
    Vec3<double> _u{0.5, 0.5, 0.5};
};

/// Statistics of the samples of a prepared closure in double.
struct SampleStatistics
{
    Color3<double> mean{0.0};  ///< of the weight
    double variance = 0;       ///< of the weight's first channel over its squared mean
    double largest = 0;        ///< weight, any channel
    double nothing = 0;        ///< share of samples that came to nothing
};

template <class Prepared>
SampleStatistics sample_statistics(const Prepared& prepared, int n)
{
    SampleStatistics result;
    EvenCube cube;
    double squares = 0;
    for (int i = 0; i < n; ++i)
    {
        const auto s = prepared.sample(cube.next());
        result.mean += s.weight * (1.0 / n);
        squares += s.weight.x * s.weight.x / n;
        for (int c = 0; c < 3; ++c) result.largest = std::max(result.largest, s.weight[c]);
        if (!s.valid) result.nothing += 1.0 / n;
    }
    if (result.mean.x > 0) result.variance = squares / (result.mean.x * result.mean.x) - 1;
    return result;
}

/// int f(wi) dwi over the hemisphere for an azimuthally symmetric f, at grazing angles as fine as
/// elsewhere: over the logarithm of the cosine.
template <class F>
double integrate_symmetric(const F& f, int n = 4000)
{
    constexpr double decades = -20.7;  // down to a cosine of 1e-9
    double sum = 0;
    for (int i = 0; i < n; ++i)
    {
        const double mu = std::exp(decades * (1 - (i + 0.5) / n));
        sum += f(direction<double>(mu)) * mu * (-decades / n);
    }
    return sum * 2 * std::acos(-1.0);
}

/// weight = eval / pdf for samples of the closure, and each pdf computed one way only.
template <class Closure>
void expect_weight_is_eval_over_pdf(const Closure& closure, double tolerance,
                                    bool both_sides = false)
{
    using Real = typename Closure::Real;
    Random random(3);
    for (double mu : {1e-4, 0.01, 0.2, 0.7, 1.0})
        for (double side : {1.0, -1.0})
        {
            if (side < 0 && !both_sides) continue;
            auto wo = direction<Real>(mu, 2.0);
            wo.z *= Real(side);
            const auto prepared = closure.prepare(wo);
            for (int i = 0; i < 2000; ++i)
            {
                const Real x = random.unit<Real>(), y = random.unit<Real>();
                const Sample<Real> s = prepared.sample(Vec3<Real>(x, y, random.unit<Real>()));
                if (!s.valid || s.delta) continue;
                EXPECT_EQ(s.pdf, prepared.pdf(s.wi));
                const Color3<Real> f = prepared.eval(s.wi);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(s.weight[c] * s.pdf, f[c], tolerance * f[c]);
            }
        }
}

/// Largest |f(wo, wi) - f(wi, wo)| over the larger, where f has no cosine.
template <class Closure>
double asymmetry_of_reflection(const Closure& closure)
{
    Random random(21);
    double worst = 0;
    for (int i = 0; i < 4000; ++i)
    {
        const auto wo = direction<double>(std::pow(random.unit(), 2), 7 * random.unit());
        const auto wi = direction<double>(random.unit(), 7 * random.unit());
        const double there = closure.eval(wo, wi).y / wi.z, back = closure.eval(wi, wo).y / wo.z;
        if (there > 0 || back > 0)
            worst = std::max(worst, std::abs(there - back) / std::max(there, back));
    }
    return worst;
}

/// make(alpha) gives the closure for float and for a vector of floats; their answers agree.
/// `sided` also asks from below.
template <class Make>
void expect_batch_answers_as_float(const Make& make, double relative = 1e-5, bool sided = false)
{
    using Batch = xsimd::batch<float>;
    constexpr int lanes = static_cast<int>(Batch::size);
    struct Lanes
    {
        alignas(64) float value[Batch::size] = {};
        Lanes() = default;
        explicit Lanes(const Batch& b) { b.store_aligned(value); }
        Batch load() const { return Batch::load_aligned(value); }
    };
    const auto near = [](double a, double b, double tolerance, const char* what) {
        EXPECT_NEAR(a, b, tolerance * (1e-3 + std::abs(b))) << what;
    };
    Random random(17);
    for (int round = 0; round < 256; ++round)
    {
        Lanes alpha, wo[3], wi[3], u[3];
        for (int l = 0; l < lanes; ++l)
        {
            alpha.value[l] =
                l % 4 == 3 && round % 8 == 0 ? 0.0f : float(std::pow(random.unit(), 2));
            auto o = direction<float>(random.unit(), 7 * random.unit());
            auto i = direction<float>(random.unit(), 7 * random.unit());
            if (sided && random.bits() % 2) o.z = -o.z;
            if (sided && random.bits() % 2) i.z = -i.z;
            for (int k = 0; k < 3; ++k)
            {
                wo[k].value[l] = o[k];
                wi[k].value[l] = i[k];
                u[k].value[l] = random.unit<float>();
            }
        }
        const auto prepared =
            make(alpha.load()).prepare(Vec3<Batch>(wo[0].load(), wo[1].load(), wo[2].load()));
        const Vec3<Batch> in(wi[0].load(), wi[1].load(), wi[2].load());
        const auto f = prepared.eval(in);
        const auto albedo = prepared.albedo();
        const auto s = prepared.sample(Vec3<Batch>(u[0].load(), u[1].load(), u[2].load()));
        const Lanes f_x(f.x), f_z(f.z), pdf(prepared.pdf(in)), reflect(albedo.reflect.y),
            transmit(albedo.transmit.y);
        const Lanes s_x(s.wi.x), s_z(s.wi.z), s_w(s.weight.y), s_pdf(s.pdf);
        const auto one_if = [](const auto& mask) {
            return Lanes(xsimd::select(mask, Batch(1.0f), Batch(0.0f)));
        };
        const Lanes valid = one_if(s.valid), delta = one_if(s.delta),
                    transmitted = one_if(s.transmitted);
        for (int l = 0; l < lanes; ++l)
        {
            const Vec3<float> o(wo[0].value[l], wo[1].value[l], wo[2].value[l]),
                i(wi[0].value[l], wi[1].value[l], wi[2].value[l]);
            const auto scalar = make(alpha.value[l]).prepare(o);
            const auto t = scalar.sample(Vec3<float>(u[0].value[l], u[1].value[l], u[2].value[l]));
            near(f_x.value[l], scalar.eval(i).x, relative, "eval");
            near(f_z.value[l], scalar.eval(i).z, relative, "eval");
            near(pdf.value[l], scalar.pdf(i), 5 * relative, "pdf");
            near(reflect.value[l], scalar.albedo().reflect.y, relative, "albedo");
            near(transmit.value[l], scalar.albedo().transmit.y, relative, "albedo");
            EXPECT_EQ(valid.value[l] != 0, t.valid);
            EXPECT_EQ(delta.value[l] != 0, t.delta);
            EXPECT_EQ(transmitted.value[l] != 0, t.transmitted);
            EXPECT_NEAR(s_x.value[l], t.wi.x, 1e-4);
            EXPECT_NEAR(s_z.value[l], t.wi.z, 1e-4);
            near(s_w.value[l], t.weight.y, 2e-3, "weight");
            // The density of a narrow lobe multiplies the rounding of the direction.
            if (alpha.value[l] > 0.1f) near(s_pdf.value[l], t.pdf, 5e-3, "sample pdf");
        }
    }
}

}  // namespace regain::tests
