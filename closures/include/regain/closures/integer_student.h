// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Student laws of integer order: microfacet slopes with the density
///
///   P(rho) = (j + 1) t^(j+1) / (pi (t + rho)^(j+2)),   rho = slope^2,  j = 0, 1, ... 8
///
/// j = 0 is GGX of alpha^2 = t. Every GTR distribution with gamma > 2 is made of them: see
/// gtr_mixture.h. Stretching slopes by 1 / sqrt(t) turns the normals into a hemisphere with the
/// density h_z^(2j), on which area and visible normals are elementary.
///
/// Area. With q = sqrt(c^2 + t s^2), a direction (s, 0, c) that need not be unit and c >= 0 sees
/// from below
///
///   sigma(-w) = q R_j(z) / 2,   z = t s^2 / q^2,   e = c / q,
///   R_j(z) = 1 - sqrt(1 - z) - b_1 z - ... - b_j z^j = (1 - e)^(j+1) T_j(e)
///
/// where b_k are the Taylor coefficients of 1 - sqrt(1 - z), so that R_j is the remainder of that
/// series. (Proof: R_0 is GGX; a higher order is a derivative by t of the one below.) T_j is a
/// polynomial without a negative coefficient, so nothing cancels however small the area is.
///
/// Visible normals. With h = (cos eta sin zeta, sin eta, cos eta cos zeta), x along the stretched
/// direction v, the density max(0, v.h) h_z^(2j) is a product: cos^(2j+2) eta of eta alone, times
/// cos^(2j) zeta max(0, v_x sin zeta + v_z cos zeta).

#pragma once

#include <regain/closures/random_stream.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

constexpr int student_orders = 9;

struct StudentSeries
{
    double b[student_orders] = {};     // Taylor coefficients of 1 - sqrt(1 - z), from b_1 = 1/2
    double T[student_orders][8] = {};  // T_j(e), by rising powers of e
    double cap[student_orders] = {};   // int cos^(2j+1) over (-pi/2, pi/2)
};

REGAIN_HOST_DEVICE constexpr StudentSeries student_series()
{
    StudentSeries s;
    s.T[0][0] = 1;
    s.cap[0] = 2;
    double b = 0.5;
    for (int j = 1; j < student_orders; ++j)
    {
        s.b[j] = b;
        s.cap[j] = s.cap[j - 1] * (2 * j) / (2 * j + 1);
        // (1 - e) T_j = T_(j-1) - b_j (1 + e)^j, divided without remainder.
        double binomial = 1, quotient = 0;
        for (int k = 0; k < j; ++k)
        {
            quotient += s.T[j - 1][k] - b * binomial;
            s.T[j][k] = quotient;
            binomial = binomial * (j - k) / (k + 1);
        }
        b *= (2 * j - 1) / (2 * j + 2.0);
    }
    return s;
}

REGAIN_HOST_DEVICE inline const StudentSeries& student()
{
    static constexpr StudentSeries series = student_series();
    return series;
}

/// A direction (s, 0, c), c >= 0, from where the Student laws of square width t are a hemisphere.
template <class Real>
struct StudentView
{
    Real q, e, d, z;  // as above, and d = 1 - e

    REGAIN_HOST_DEVICE StudentView(const Real& t, const Real& c, const Real& s2)
    {
        const Real tangential2 = t * s2;
        q = detail::sqrt(c * c + tangential2);
        e = c / q;
        d = tangential2 / (q * (q + c));
        z = d * (Real(1) + e);
    }

    /// R_j.
    REGAIN_HOST_DEVICE Real remainder(int j) const
    {
        Real T = constant<Real>(student().T[j][j > 0 ? j - 1 : 0]), power = d;
        for (int k = j - 2; k >= 0; --k) T = T * e + constant<Real>(student().T[j][k]);
        for (int k = 0; k < j; ++k) power *= d;
        return power * T;
    }
};

/// Which order of a sum of Student laws of one width: j, and cap[j] of student().
template <class Real>
struct StudentOrder
{
    Real j, cap;
};

/// The order j <= last, with the probability of its share in the area that the direction sees;
/// weight[j] xi^j is its share in the sum, above = c for directions seen from above, else 0.
template <class Real>
REGAIN_HOST_DEVICE StudentOrder<Real> student_order(const StudentView<Real>& view,
                                                    const Real& above, const Real* weight,
                                                    const Real& xi, int last, const Real& u)
{
    Real area[student_orders], power[student_orders];
    power[0] = Real(1);
    for (int j = 1; j <= last; ++j) power[j] = power[j - 1] * view.z;
    // From the last down: R_(j-1) = R_j + b_j z^j.
    Real R = view.remainder(last);
    for (int j = last; j >= 0; --j)
    {
        area[j] = above + Real(0.5f) * view.q * R;
        R += constant<Real>(student().b[j]) * power[j];
    }
    Real total(0), xi_power(1);
    for (int j = 0; j <= last; ++j)
    {
        area[j] *= weight[j] * xi_power;
        total += area[j];
        xi_power *= xi;
    }
    StudentOrder<Real> order{Real(0), constant<Real>(student().cap[0])};
    Real sum(0);
    for (int j = 0; j <= last; ++j)
    {
        // Rounding must not select an order whose weight is 0.
        const MaskOf<Real> reached = both<Real>(sum <= u * total, weight[j] > Real(0));
        order.j = select(reached, constant<Real>(j), order.j);
        order.cap = select(reached, constant<Real>(student().cap[j]), order.cap);
        sum += area[j];
    }
    return order;
}

/// x^(1 / k) for x in [0, 1], k > 0.
template <class Real>
REGAIN_HOST_DEVICE Real root(const Real& x, const Real& k)
{
    return detail::exp(detail::log(detail::max(x, constant<Real>(1e-30))) / k);
}

/// A visible normal of the hemisphere with the density h_z^(2j), seen along the unit vector
/// (v_x, 0, v_z), v_x >= 0. Reads u.x, u.y and the stream. Of the proposals
/// for zeta more than a third are accepted, whatever the direction, from above more than two
/// thirds; after 64 failures (a chance of 1e-12) the last is taken as it is, a normal like any
/// other.
template <class Real>
REGAIN_HOST_DEVICE Vec3<Real> student_visible(const StudentOrder<Real>& order, const Real& v_x,
                                              const Real& v_z, const Vec2<Real>& u,
                                              RandomStream<Real>& stream)
{
    const Real j = order.j, cap = order.cap;
    const Real zero(0), one(1), tiny = constant<Real>(1e-30);
    const Real two_pi = constant<Real>(6.28318530717958647692);
    const MaskOf<Real> below = v_z < zero;
    const Real e = detail::abs(v_z), e2 = e * e, v_x2 = v_x * v_x, odd = j + j + one;

    // sin eta has the density of one coordinate of a point on the sphere in 2j + 4 dimensions; two
    // of them have a radius in closed form.
    const Real radius = detail::sqrt(detail::max(one - root(u.y, j + one), zero));
    const Real sin_eta = radius * detail::cos(two_pi * stream.next());
    const Real cos_eta = detail::sqrt(detail::max(one - sin_eta * sin_eta, zero));

    // From above, the density of zeta is an even part, v_z cos^(2j+1) zeta, and an odd one,
    // v_x cos^(2j) zeta sin zeta. Each has a closed form; what the odd part takes away where zeta
    // is negative is left to rejection.
    const Real even_share = e * cap / (e * cap + v_x / odd);
    // From below, with cos zeta = v_x y, it is y^(2j) (1 - k(y)) with a convex k, k(1) = 1. That
    // lies below y^(2j), and below y^(2j) (1 - y) / v_z^2: the second largest of 2j + 2 numbers.
    const MaskOf<Real> ordered = e2 * (odd + one) > one;

    Real sin_zeta(0), cos_zeta(1), first = u.x;
    MaskOf<Real> done(false);
    for (int attempt = 0; attempt < 64; ++attempt)
    {
        const Real part = stream.next(), second = stream.next();
        const Real power = root(first, odd);

        const Real y = power * select(ordered, root(second, odd + one), one), y2 = y * y;
        const Real sin_below = detail::sqrt(detail::max(one - v_x2 * y2, tiny));
        const Real seen_below =
            select(ordered, e2 * (one + y), one - y2) / (sin_below * (sin_below + e * y));

        const Real sin_odd = detail::sqrt(detail::max(one - power * power, zero));
        const Real sin_above =
            sin_odd * select(part < even_share, detail::cos(two_pi * second), one);
        const Real cos_above = detail::sqrt(detail::max(one - sin_above * sin_above, tiny));
        const Real seen_above =
            one + v_x * detail::min(sin_above, zero) / detail::max(e * cos_above, tiny);

        sin_zeta = select(done, sin_zeta, select(below, sin_below, sin_above));
        cos_zeta = select(done, cos_zeta, select(below, v_x * y, cos_above));
        done = done | (stream.next() < select(below, seen_below, seen_above));
        if (all<Real>(done)) break;
        first = stream.next();
    }
    return {cos_eta * sin_zeta, sin_eta, cos_eta * cos_zeta};
}

}  // namespace detail

REGAIN_NAMESPACE_END
