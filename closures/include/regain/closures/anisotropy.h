// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Anisotropic lobes in the tables of isotropic ones. What a lobe of widths ax and ay scatters once
/// of a direction w is, within one per cent, what an isotropic one does of width a seen from mu':
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
/// axis
/// (-1) or the narrower (1) as the stretched surface sees it; it means nothing along the normal,
/// where g is 0. The form was found, and its numbers were fitted, on quadrature of 29,000 lobes and
/// directions a distribution (docs/methods.md): ratios up to 20, alpha up to 1, any azimuth, mu
/// from 3e-3. Where ax = ay it is w.z and the width themselves, exchanging the axes changes
/// nothing, and it is smooth in all directions and widths.
///
/// The numbers depend on how long the tail of the distribution is, tail_length() in distribution.h:
/// 0 of Beckmann, 1 of GGX, 1 / (gamma - 1) of STD, which lies between these and beyond. GTR is no
/// stretched isotropic law of the same alpha, and takes GGX's for want of its own.

#pragma once

#include <regain/closures/table.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// tail_length() of a distribution; 1 where it does not say.
template <class Distribution, class = void>
struct TailLength
{
    static typename Distribution::Real of(const Distribution&)
    {
        return typename Distribution::Real(1);
    }
};
template <class Distribution>
struct TailLength<Distribution,
                  std::void_t<decltype(std::declval<const Distribution&>().tail_length())>>
{
    static typename Distribution::Real of(const Distribution& distribution)
    {
        return distribution.tail_length();
    }
};

constexpr int anisotropy_terms = 9;

/// k_1, k_2, k_3 above: of a tail of length 0 and of length 1; and, for l in between and beyond,
/// P and Q of  (1 - l) k(0) + l k(1) + l (1 - l) (P + l Q).
constexpr double anisotropy_numbers[anisotropy_terms][4][3] = {
    {{1.219, -2.486, 1.128},
     {0.324, -0.844, 0.372},
     {-0.816, 1.297, -0.393},
     {0.119, 0.245, -0.522}},
    {{-2.878, 7.141, -2.864},
     {1.498, -3.968, 3.015},
     {4.246, 3.383, -13.068},
     {1.161, -12.846, 15.482}},
    {{2.637, -13.604, 10.553},
     {-4.059, 11.58, -8.332},
     {-45.815, 123.758, -77.644},
     {26.844, -70.844, 43.692}},
    {{-0.658, 1.223, -0.481},
     {-0.713, 2.003, -1.344},
     {2.384, -7.658, 6.237},
     {-2.575, 8.122, -6.399}},
    {{-0.192, 7.412, -7.811},
     {3.258, -8.929, 6.265},
     {40.183, -122.152, 87.456},
     {-25.357, 75.85, -53.835}},
    {{-2.367, 11.199, -9.206},
     {2.027, -3.708, 1.593},
     {8.449, -21.519, 12.288},
     {-2.51, 4.242, -0.804}},
    {{2.477, -7.963, 6.429}, {-1.42, 2.72, -1.113}, {0.779, -0.994, 0.913}, {-3.05, 8.179, -6.077}},
    {{-1.27, 4.885, -4.881},
     {0.092, -0.471, 0.445},
     {-4.906, 15.21, -11.42},
     {4.112, -13.351, 10.737}},
    {{0.457, 0.446, -2.17},
     {0.239, -0.919, 0.669},
     {5.627, -26.942, 26.489},
     {-3.665, 17.486, -16.936}},
};

}  // namespace detail

/// The axes of a distribution's tables, for directions instead of cosines.
template <class RealType>
class DirectionAxes : public TableAxes<RealType>
{
public:
    using Real = RealType;

    template <class Distribution>
    explicit DirectionAxes(const Distribution& distribution)
        : TableAxes<Real>(distribution), _x(distribution.alpha_x()), _y(distribution.alpha_y())
    {
        _isotropic = detail::all<Real>(_x == _y);
        if (_isotropic) return;

        const Real l = detail::min(detail::TailLength<Distribution>::of(distribution),
                                   detail::constant<Real>(longest_tail));
        const Real R = this->alpha(), bend = l * (Real(1) - l);
        for (int i = 0; i < detail::anisotropy_terms; ++i)
        {
            const auto& row = detail::anisotropy_numbers[i];
            const auto k = [&](int j) {
                const auto number = [&](int of) { return detail::constant<Real>(row[of][j]); };
                return (Real(1) - l) * number(0) + l * number(1) +
                       bend * (number(2) + l * number(3));
            };
            _c[i] = R * (k(0) + R * (k(1) + R * k(2)));
        }
        _d = (_x - _y) * (_x + _y) / (_x * _x + _y * _y);
    }

    /// The widths are the same: a direction is known by its cosine.
    bool isotropic() const { return _isotropic; }

    /// Where the tables of isotropic lobes have w: the axes of a width, and a cosine.
    struct Place
    {
        TableAxes<Real> axes;
        Real mu;
    };
    /// w is unit, w.z in [0, 1].
    Place place(const Vec3<Real>& w) const
    {
        if (_isotropic) return {*this, w.z};

        const Real X = _x * w.x, Y = _y * w.y, X2 = X * X, Y2 = Y * Y;
        const Real tangential = X2 + Y2, R = this->alpha();
        const Real e = _d * _d, m = Real(1) - w.z;
        const Real g = Real(1) - stretched_cosine_of(R * w.z, tangential);
        const Real D = _d * (Y2 - X2) / detail::max(tangential, detail::constant<Real>(1e-36));
        const Real even = _c[0] + g * (_c[1] + g * (_c[2] + m * _c[4])) + m * _c[3];
        const Real odd = _c[5] + g * _c[6] + e * e * _c[7] + D * m * _c[8];
        const Real limit = detail::constant<Real>(0.6);
        const Real change = detail::max(detail::min(e * even + D * g * odd, limit), -limit);
        const Real a = detail::min(R + R * change, Real(1));

        const MaskOf<Real> same = _x == _y;
        const Real alpha = detail::select(same, R, a);
        return {this->of_alpha(alpha),
                detail::select(same, w.z, stretched_cosine_of(alpha * w.z, tangential))};
    }

    /// E_ss of a direction as for place(), at most 1; the table is there.
    Real albedo(const MicrofacetTables& tables, const Vec3<Real>& w) const
    {
        if (_isotropic) return tables.albedo(*this, w.z);
        const Place p = place(w);
        return tables.albedo(p.axes, p.mu);
    }

    /// The mean of value(w) over all azimuths of the cosine mu in [0, 1], of what does not change
    /// when w.x or w.y changes its sign; where the lobe is isotropic, the value of any of them.
    template <class Value>
    auto azimuth_mean(Real mu, const Value& value) const
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

    // Cosine of a direction whose tangent, squared, is tangential / z^2.
    static Real stretched_cosine_of(const Real& z, const Real& tangential)
    {
        return z / detail::sqrt(detail::max(z * z + tangential, detail::constant<Real>(1e-36)));
    }

    Real _x, _y;
    Real _d = Real(0);
    Real _c[detail::anisotropy_terms] = {};
    bool _isotropic;
};

REGAIN_NAMESPACE_END
