// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a closure answers. Every closure is a value type with
///
///     prepare(wo)          what depends on wo alone; once per shading point
///       .eval(wi)          f(wo, wi) |cos theta_i| per channel; 0 where the pair is impossible
///       .sample(u)         a Sample; u in [0, 1)^3, of which the first `random_numbers` are read,
///                          or in [0, 1)^2 where two are enough
///       .pdf(wi)           per steradian, over all that sample can return; integrates to
///                          1 - P(nothing)
///       .albedo()          an Albedo, for wo
///     eval(wo, wi) ...     shorthands for prepare(wo).eval(wi) ..., by Shorthands below
///     traits()             a Traits
///     random_numbers       static: how many numbers sample reads, 2 or 3
///
/// A closure whose eval is an estimate takes random numbers there, too, .eval(wi, u), and says so:
/// `stochastic_eval` is then a static constant, true. evaluate() below asks either kind.
///
/// wo and wi are unit vectors in the local shading frame and point away from the surface. A wo that
/// is no unit vector, or lies below the horizon of a closure that only reflects, gets black, a pdf
/// of 0 and no samples; so does such a wi. Unit is what has a length within half a per cent of 1; a
/// cosine of 1e-12 or less is on the horizon, which is below it, seen from either side.
///
/// A u of 1 is taken, too, as it comes of a double that is rounded to float. One that is beyond
/// [0, 1], or no number, gives one of the closure's samples or none.

#pragma once

#include <regain/closures/vector.h>

#include <utility>

REGAIN_NAMESPACE_BEGIN

/// One sampled direction, or nothing.
template <class Real>
struct Sample
{
    using Mask = MaskOf<Real>;

    Vec3<Real> wi;             ///< unit; (0, 0, 1) when there is no sample
    Color3<Real> weight;       ///< f |cos theta_i| / pdf; for a delta lobe the energy fraction
    Real pdf;                  ///< per steradian; for a delta lobe its selection probability
    Mask valid = Mask(false);  ///< false: nothing was sampled, weight and pdf are 0
    Mask delta = Mask(false);  ///< the direction has no density: eval and pdf of it are 0
    Mask transmitted = Mask(false);  ///< wi is on the other side of the surface
};

/// Directional albedo: the energy that leaves for a unit of energy that arrives along wo.
template <class Real>
struct Albedo
{
    Color3<Real> reflect, transmit;
};

/// What a closure promises. Tests prove or refute it.
struct Traits
{
    bool reciprocal = false;         ///< f(wo, wi) = f(wi, wo); eta squared across an interface
    bool energy_preserving = false;  ///< with F = 1 the albedo is 1
    bool exact_pdf = false;          ///< pdf is the density of sample
    bool stochastic_eval = false;    ///< eval draws random numbers and is right on average
    bool delta = false;              ///< sample may return directions without density
    bool transmissive = false;
    bool anisotropic = false;  ///< rotating wo and wi about the normal changes the value
    int random_numbers = 0;    ///< that sample takes
};

namespace detail {

template <class Prepared, class Real, class = void>
struct TakesNumbersInEval : std::false_type
{};
template <class Prepared, class Real>
struct TakesNumbersInEval<Prepared, Real,
                          std::void_t<decltype(std::declval<const Prepared&>().eval(
                              std::declval<Vec3<Real>>(), std::declval<Vec3<Real>>()))>>
    : std::true_type
{};

}  // namespace detail

/// f(wo, wi) |cos theta_i| of any prepared closure; u in [0, 1)^3 is read where eval is an
/// estimate.
template <class Prepared, class Real>
REGAIN_HOST_DEVICE Color3<Real> evaluate(const Prepared& prepared, const Vec3<Real>& wi,
                                         [[maybe_unused]] const Vec3<Real>& u)
{
    if constexpr (detail::TakesNumbersInEval<Prepared, Real>::value)
        return prepared.eval(wi, u);
    else
        return prepared.eval(wi);
}

namespace detail {

template <class Prepared, class = void>
struct ExpectsAlbedo : std::false_type
{};
template <class Prepared>
struct ExpectsAlbedo<Prepared,
                     std::void_t<decltype(std::declval<const Prepared&>().expected_albedo())>>
    : std::true_type
{};

}  // namespace detail

/// About what albedo() is, by which lobes are picked: a prepared closure whose albedo takes long
/// has a guess of its own, expected_albedo().
template <class Prepared>
REGAIN_HOST_DEVICE auto expected_albedo(const Prepared& prepared)
{
    if constexpr (detail::ExpectsAlbedo<Prepared>::value)
        return prepared.expected_albedo();
    else
        return prepared.albedo();
}

namespace detail {

/// Two random numbers as three, for a closure that reads no more.
template <class Closure, class Real>
REGAIN_HOST_DEVICE Vec3<Real> two_numbers(const Vec2<Real>& u)
{
    static_assert(Closure::random_numbers <= 2, "this closure reads three random numbers");
    return {u.x, u.y, Real(0)};
}

}  // namespace detail

/// The base of a closure that asks prepare(wo) once for each answer.
template <class Closure, class Real>
class Shorthands
{
public:
    REGAIN_HOST_DEVICE auto eval(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        return prepared(wo).eval(wi);
    }
    /// Of a closure whose eval is an estimate.
    REGAIN_HOST_DEVICE auto eval(const Vec3<Real>& wo, const Vec3<Real>& wi,
                                 const Vec3<Real>& u) const
    {
        return prepared(wo).eval(wi, u);
    }
    REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& wo, const Vec3<Real>& u) const
    {
        return prepared(wo).sample(u);
    }
    REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& wo, const Vec2<Real>& u) const
    {
        return prepared(wo).sample(detail::two_numbers<Closure>(u));
    }
    REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        return prepared(wo).pdf(wi);
    }
    REGAIN_HOST_DEVICE Albedo<Real> albedo(const Vec3<Real>& wo) const
    {
        return prepared(wo).albedo();
    }

private:
    REGAIN_HOST_DEVICE auto prepared(const Vec3<Real>& wo) const
    {
        return static_cast<const Closure&>(*this).prepare(wo);
    }
};

namespace detail {

/// Of an n x n grid of random numbers the one in column i, row j. Where a third number is read, any
/// sequence that fills the unit interval evenly.
template <class Real>
REGAIN_HOST_DEVICE Vec3<Real> grid_numbers(int i, int j, int n)
{
    const double third = (i * n + j + 0.5) * 0.61803398874989484820;
    return {constant<Real>((i + 0.5) / n), constant<Real>((j + 0.5) / n),
            constant<Real>(third - std::floor(third))};
}

/// How many rows of random numbers such a mean takes: normals that read three need more.
template <class Distribution>
constexpr int grid_rows = Distribution::random_numbers > 2 ? 64 : 32;

/// The albedo of a prepared closure by its own samples: their mean weight over an n x n grid of
/// random numbers. With the rows of its distribution right within 2e-3, of GTR 1e-2, of STD 1.5e-2;
/// and a thousand times slower than a look-up.
template <class Real, class Prepared>
REGAIN_HOST_DEVICE Albedo<Real> mean_weight(const Prepared& prepared, int n = 32)
{
    const Color3<Real> none(Real(0));
    const Real share = constant<Real>(1.0 / (n * n));
    Albedo<Real> sum{none, none};
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            const Sample<Real> s = prepared.sample(grid_numbers<Real>(i, j, n));
            const Color3<Real> w = s.weight * share;
            sum.reflect += select(s.transmitted, none, w);
            sum.transmit += select(s.transmitted, w, none);
        }
    return sum;
}

}  // namespace detail

REGAIN_NAMESPACE_END
