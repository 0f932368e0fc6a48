// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Anisotropic lobes in the tables of isotropic ones. What a lobe of widths ax and ay scatters once
/// of a direction w is, to one per cent, what an isotropic one does of width a seen from mu':
///
///   E_ss(w; ax, ay) = E_ss(mu'; a)
///   mu' = a w.z / sqrt(a^2 w.z^2 + X^2 + Y^2),    X = ax w.x,  Y = ay w.y
///
/// mu' is the cosine at which both have the same stretched tangent a tan theta' = |(X, Y)| / w.z,
/// which is all that Smith's masking of w knows of it (Heitz 2014, Section 5.3). What is left is
/// one width, of which E_ss depends much less than of masking. Where slopes are small it is the
/// root mean square R of the two. Beyond that
///
///   a = R (1 + e (c_0 + c_1 g + c_2 g^2 + c_3 m + c_4 g^2 m)
///            + D g (c_5 + c_6 g + c_7 e^2 + c_8 D m))
///   R^2 = (ax^2 + ay^2) / 2,  d = (ax^2 - ay^2) / (ax^2 + ay^2),  e = d^2
///   D = d (Y^2 - X^2) / (X^2 + Y^2),  m = 1 - w.z
///   g = 1 - R w.z / sqrt(R^2 w.z^2 + X^2 + Y^2)
///
/// and each c is a polynomial R (k_1 + k_2 R + k_3 R^2). D says whether w comes along the wider
/// axis or the narrower, -d to d, as the stretched surface sees it; it means nothing along the
/// normal, where g is 0. The form was found, and its numbers were fitted, on quadrature of 29,000
/// lobes and directions a distribution (docs/methods.md): ratios up to 20, alpha up to 1, any
/// azimuth, mu from 3e-3. Where ax = ay it is w.z and the width themselves, exchanging the axes
/// changes nothing, and it is smooth in all directions and widths.
///
/// The numbers depend on how long the tail of the distribution is, tail_length() in distribution.h:
/// 0 of Beckmann, 1 of GGX, 1 / (gamma - 1) of STD, which lies between these and beyond. GTR is no
/// stretched isotropic law of the same alpha, and takes GGX's if it has nothing better.
///
/// Better is the table `anisotropy` of MicrofacetTables. With it
///
///   E_ss(w; ax, ay) = E_ss(mu'; R) exp(c),    a = R above,  c over
///     mu' / (mu' + R (1 - mu')); of the distributions with a tail the square of the cosine axis of
///       table.h, at mu' and R
///     8 X^2 / (8 X^2 + 5 Y^2), if x is the narrower axis
///     the width axis, at the wider of both
///     ln(1 + l / 3) / ln(1 + ln(20) / 3), l = ln(wider / narrower); at most 1
///     the tail axis
///
/// c is 0 where the widths are equal, the same with the axes exchanged, and smooth: of masking,
/// which is what varies most, mu' leaves nothing.

#pragma once

#include <regain/closures/azimuth_skew.h>
#include <regain/closures/table.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// tail_length() of a distribution; 1 where it does not say.
template <class Distribution, class = void>
struct TailLength
{
    REGAIN_HOST_DEVICE static typename Distribution::Real of(const Distribution&)
    {
        return typename Distribution::Real(1);
    }
};
template <class Distribution>
struct TailLength<Distribution,
                  std::void_t<decltype(std::declval<const Distribution&>().tail_length())>>
{
    REGAIN_HOST_DEVICE static typename Distribution::Real of(const Distribution& distribution)
    {
        return distribution.tail_length();
    }
};

constexpr int anisotropy_terms = 9;

/// Coordinate of the ratio of two widths, at least 1, along the fourth axis of `anisotropy`; it may
/// be beyond 1. A quotient of logarithms as above.
template <class Real>
REGAIN_HOST_DEVICE Real ratio_coordinate(const Real& ratio)
{
    constexpr double inv_widest = 1 / 0.69243563973380040;  // of ln(1 + ln(20) / 3)
    return log1p(log(ratio) * constant<Real>(1.0 / 3)) * constant<Real>(inv_widest);
}

/// k_1, k_2, k_3 above: of a tail of length 0 and of length 1; and, for l in between and beyond,
/// P and Q of  (1 - l) k(0) + l k(1) + l (1 - l) (P + l Q).
using AnisotropyNumbers = double[4][3];
REGAIN_HOST_DEVICE inline const AnisotropyNumbers& anisotropy_numbers(int term)
{
    static constexpr AnisotropyNumbers numbers[anisotropy_terms] = {
        {{1.082, -2.133, 0.898},
         {0.6396, -1.983, 1.339},
         {-0.302, 0.798, -0.611},
         {0.157, -0.842, 0.855}},
        {{-4.802, 12.29, -6.434},
         {-1.244, 4.984, -4.226},
         {8.841, -12.06, -0.534},
         {-6.029, 10.258, -2.732}},
        {{7.239, -22.492, 14.904},
         {2.967, -9.405, 7.405},
         {-41.273, 102.515, -57.829},
         {31.125, -79.122, 47.254}},
        {{0.157, -0.805, 0.793},
         {0.0175, -0.3243, 0.5132},
         {-0.369, -0.069, 0.872},
         {0.411, -0.461, -0.125}},
        {{0.753, -1.486, 1.757},
         {-1.012, 3.348, -2.586},
         {11.012, -19.827, 3.014},
         {-10.719, 23.261, -9.489}},
        {{-3.997, 14.976, -11.428},
         {1.136, -0.7752, -0.7361},
         {6.78, -18.257, 10.813},
         {-3.36, 8.893, -5.366}},
        {{6.37, -16.481, 11.156},
         {-0.0993, -1.466, 2.139},
         {13.91, -39.78, 28.292},
         {-10.36, 27.928, -18.842}},
        {{-1.131, 4.03, -3.945},
         {0.9205, -2.932, 2.245},
         {-10.106, 29.261, -20.275},
         {8.69, -25.773, 18.651}},
        {{-1.35, 5.607, -5.905},
         {-1.501, 4.259, -3.179},
         {13.503, -49.922, 43.371},
         {-10.387, 37.006, -31.21}},
    };
    return numbers[term];
}

}  // namespace detail

/// The axes of a distribution's tables, for directions instead of cosines.
template <class RealType>
class DirectionAxes : public TableAxes<RealType>
{
public:
    using Real = RealType;

    template <class Distribution>
    REGAIN_INLINE explicit DirectionAxes(const Distribution& distribution)
        : TableAxes<Real>(distribution), _x(distribution.alpha_x()), _y(distribution.alpha_y())
    {
        _isotropic = detail::all<Real>(_x == _y);
        if (_isotropic) return;

        const Real l = detail::min(detail::TailLength<Distribution>::of(distribution),
                                   detail::constant<Real>(longest_tail));
        const Real R = this->alpha(), bend = l * (Real(1) - l);
        for (int i = 0; i < detail::anisotropy_terms; ++i)
        {
            const auto& row = detail::anisotropy_numbers(i);
            const auto k = [&](int j) {
                const auto number = [&](int of) { return detail::constant<Real>(row[of][j]); };
                return (Real(1) - l) * number(0) + l * number(1) +
                       bend * (number(2) + l * number(3));
            };
            _c[i] = R * (k(0) + R * (k(1) + R * k(2)));
        }
        _d = (_x - _y) * (_x + _y) / (_x * _x + _y * _y);
        const Real wider = detail::max(_x, _y), narrower = detail::min(_x, _y);
        _width = this->width_of(wider);
        _ratio = detail::ratio_coordinate<Real>(wider / narrower);
    }

    REGAIN_HOST_DEVICE Real alpha_x() const { return _x; }
    REGAIN_HOST_DEVICE Real alpha_y() const { return _y; }
    /// R.
    REGAIN_HOST_DEVICE Real effective_alpha() const { return this->alpha(); }

    /// The widths are the same: a direction is known by its cosine.
    REGAIN_HOST_DEVICE bool isotropic() const { return _isotropic; }

    /// Where the tables of isotropic lobes have w: the axes of a width, and a cosine.
    struct Place
    {
        TableAxes<Real> axes;
        Real mu;
    };
    /// w is unit, w.z in [0, 1].
    REGAIN_HOST_DEVICE Place place(const Vec3<Real>& w) const
    {
        if (_isotropic) return {*this, w.z};

        const Real X = _x * w.x, Y = _y * w.y, X2 = X * X, Y2 = Y * Y;
        const Real tangential = X2 + Y2, R = this->alpha();
        const Real e = _d * _d, m = Real(1) - w.z;
        const Real g = Real(1) - stretched_cosine_of(R * w.z, tangential);
        const Real D = _d * (Y2 - X2) / detail::max(tangential, detail::constant<Real>(1e-36));
        const Real even = _c[0] + g * (_c[1] + g * (_c[2] + m * _c[4])) + m * _c[3];
        const Real odd = _c[5] + g * _c[6] + e * e * _c[7] + D * m * _c[8];
        const Real limit = detail::constant<Real>(0.9);
        const Real change = detail::max(detail::min(e * even + D * g * odd, limit), -limit);
        const Real a = detail::min(R + R * change, Real(1));

        const MaskOf<Real> same = _x == _y;
        const Real alpha = detail::select(same, R, a);
        return {this->of_alpha(alpha),
                detail::select(same, w.z, stretched_cosine_of(alpha * w.z, tangential))};
    }

    /// E_ss of a direction as for place(), at most 1; the table is there.
    REGAIN_INLINE Real albedo(const LossTables& tables, const Vec3<Real>& w) const
    {
        if (_isotropic) return tables.albedo(*this, w.z);
        if (tables.anisotropy) return corrected_albedo(tables, w);
        const Place p = place(w);
        return tables.albedo(p.axes, p.mu);
    }

    /// How to draw azimuths by what directions lose.
    REGAIN_HOST_DEVICE AzimuthSkew<Real> azimuths() const { return {_x, _y}; }

    /// The mean of value(w) over all azimuths of the cosine mu in [0, 1], of what does not change
    /// when w.x or w.y changes its sign; where the lobe is isotropic, the value of any of them.
    template <class Value>
    REGAIN_HOST_DEVICE auto azimuth_mean(Real mu, const Value& value) const
    {
        const Real sine = detail::sqrt(detail::max((Real(1) - mu) * (Real(1) + mu), Real(0)));
        if (_isotropic) return value(Vec3<Real>(sine, Real(0), mu));
        // Cosines at the middles of six parts of a quarter turn; backwards they are the sines.
        constexpr int parts = 6;
        constexpr double cosine[parts] = {0.99144486137381041, 0.92387953251128676,
                                          0.79335334029123517, 0.60876142900872064,
                                          0.38268343236508977, 0.13052619222005159};
        auto sum = value(Vec3<Real>(sine * detail::constant<Real>(cosine[0]),
                                    sine * detail::constant<Real>(cosine[parts - 1]), mu));
        for (int i = 1; i < parts; ++i)
            sum += value(Vec3<Real>(sine * detail::constant<Real>(cosine[i]),
                                    sine * detail::constant<Real>(cosine[parts - 1 - i]), mu));
        return sum * detail::constant<Real>(1.0 / parts);
    }

private:
    // The numbers are of gamma 1.7 and above.
    static constexpr double longest_tail = 1 / 0.7;

    // By the table `anisotropy`.
    REGAIN_HOST_DEVICE Real corrected_albedo(const LossTables& tables, const Vec3<Real>& w) const
    {
        const Real X = _x * w.x, Y = _y * w.y, X2 = X * X, Y2 = Y * Y, tangential = X2 + Y2;
        const Real mu =
            detail::select(_x == _y, w.z, stretched_cosine_of(this->alpha() * w.z, tangential));
        // Along the normal y is anything.
        const MaskOf<Real> x_is_narrower = _x < _y;
        const Real narrower = Real(8) * detail::select(x_is_narrower, X2, Y2),
                   wider = Real(5) * detail::select(x_is_narrower, Y2, X2);
        const Real y = narrower / detail::max(narrower + wider, detail::constant<Real>(1e-36));
        const Real at[] = {along_cosine(mu), y, _width, _ratio, this->tail()};
        return detail::min(tables.albedo(*this, mu) * detail::exp(tables.anisotropy->at(at)),
                           Real(1));
    }

    // Coordinate of mu' along the first axis of that table.
    REGAIN_HOST_DEVICE Real along_cosine(const Real& mu) const
    {
        if (!this->has_tail()) return plain_cosine(mu, this->alpha());
        const Real x = this->cosine(mu);
        return x * x;
    }

    // Cosine of a direction whose tangent, squared, is tangential / z^2.
    REGAIN_HOST_DEVICE static Real stretched_cosine_of(const Real& z, const Real& tangential)
    {
        return z / detail::sqrt(detail::max(z * z + tangential, detail::constant<Real>(1e-36)));
    }

    Real _x, _y;
    Real _d = Real(0);
    Real _c[detail::anisotropy_terms] = {};
    Real _width = Real(0), _ratio = Real(0);  // the third and fourth coordinate of `anisotropy`
    bool _isotropic;
};

REGAIN_NAMESPACE_END
