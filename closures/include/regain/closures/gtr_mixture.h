// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// GTR as a mixture of laws whose masking is elementary. With beta = alpha^2 and rho = slope^2 the
/// density of its slopes is
///
///   P(rho) ~ (1 + rho)^(gamma-2) (beta + rho)^(-gamma)
///
/// With m = max(0, ceil(gamma - 2)) and delta = m + 2 - gamma the first factor is
/// (1 + rho)^(-delta) ((beta + rho) + (1 - beta))^m. Expanding the power, and Feynman's
/// A^-a B^-b = int_0^1 u^(a-1) (1-u)^(b-1) (u A + (1-u) B)^(-a-b) du / B(a, b) for each term, give
///
///   P(rho) ~ sum_j C(m, j) (1 - beta)^j Gamma(2+j) / Gamma(2-delta+j)
///              int_0^1 u^(1-delta+j) (1-u)^(delta-1) (t + rho)^(-2-j) du,   t = 1 - (1-beta) u
///
/// with positive weights only. For gamma <= 2 only j = 0 is left, GGX of alpha^2 = t: GTR is then a
/// mixture of GGX (gamma = 1: uniform in log t). Above, the terms are the Student laws of
/// integer_student.h. At gamma = 2, 3, 4 ... delta is 0 and only t = beta is left: a finite sum.
///
/// The integral becomes a sum by the trapezoidal rule in log s, s = u / (1-u): the integrand
/// s^(2-delta) / ((1 + s) (1 + beta s)) times a function of t is analytic for |Im log s| < pi for
/// every direction and slope, so the error falls like exp(-2 pi^2 / step). The tails of the sum,
/// endless where gamma is near 0 or delta is, are geometric series: one node takes the mass and the
/// mean of each. Against quadrature in long double the areas are right to 1e-5 (float) and 2e-9
/// (double), relative, for every alpha, gamma and direction.
///
/// Nodes at alpha 1, 0.1, 0.01, 0.001: 9, 13, 16, 20 for gamma < 2, at most 18, 25, 32, 38 above
/// (float); 25, 31, 37, 43 and 50, 61, 72, 83 (double).

#pragma once

#include <regain/closures/integer_student.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class Real>
class GtrMixture
{
    static constexpr bool single = sizeof(ScalarOf<Real>) == 4;

public:
    /// Distance of the nodes for gamma <= 2 (each order of Student laws takes a tenth more of
    /// them), and how far they go on from where the weight turns to a power of s.
    static constexpr double step = single ? 1.25 : 0.75, reach = single ? 3.5 : 8;
    /// Room for all nodes at the smallest alpha there is.
    static constexpr int max_nodes = single ? 56 : 160;
    /// D of the mixture is D of GTR within this, relative; measured, rounding included: 1.3e-5 and
    /// 1e-9, over all alpha and gamma.
    static constexpr double tolerance = single ? 2e-4 : 1e-7;

    /// One term of the mixture: the Student law of this order (0: GGX) and square width t.
    struct Term
    {
        Real t;
        StudentOrder<Real> order;
    };

    /// beta = alpha^2 in (0, 1], its logarithm, gamma in (0, 10].
    REGAIN_HOST_DEVICE GtrMixture(const Real& beta, const Real& log_beta, const Real& gamma)
    {
        const Real one(1);

        // m, which differs from lane to lane; the loops below run to the largest.
        Real m(0);
        const Real above = gamma - Real(2);
        for (; _orders + 1 < student_orders; ++_orders)
        {
            const MaskOf<Real> more = above > constant<Real>(_orders);
            if (!any<Real>(more)) break;
            m += select(more, one, Real(0));
        }
        const Real delta = m - above, a = Real(2) - delta;

        // C(m, j) (1-beta)^j Gamma(2+j) / Gamma(2-delta+j), over the j + 1 of the laws' densities.
        // Their t^(j+1) goes with u^j to (beta u / t)^j / t, where beta u / t is at most 1.
        const Real rest = -detail::expm1(log_beta);
        Real up(1), down(1);
        for (int j = 0; j <= _orders; ++j)
        {
            _order[j] = up;
            up *= rest * (m - constant<Real>(j)) / (a + constant<Real>(j));
        }
        for (int j = _orders; j >= 0; --j)
        {
            _order[j] *= down;
            down *= select(constant<Real>(j) <= m, beta, one);
        }

        if (all<Real>(delta <= Real(0)))
            add(one, beta, one);
        else
            add_all(beta, log_beta, a, delta, m);

        Real mass(0);
        for (int i = 0; i < _nodes; ++i) mass += _weight[i] * orders_mass(i);
        const Real scale = one / mass;
        for (int i = 0; i < _nodes; ++i) _weight[i] *= scale;
    }
    // Copies what there is, which is a small part of the room.
    REGAIN_HOST_DEVICE GtrMixture(const GtrMixture& other) { *this = other; }
    REGAIN_HOST_DEVICE GtrMixture& operator=(const GtrMixture& other)
    {
        _nodes = other._nodes;
        _orders = other._orders;
        for (int i = 0; i < _nodes; ++i)
        {
            _weight[i] = other._weight[i];
            _t[i] = other._t[i];
            _xi[i] = other._xi[i];
        }
        for (int j = 0; j <= _orders; ++j) _order[j] = other._order[j];
        return *this;
    }

    REGAIN_HOST_DEVICE int nodes() const { return _nodes; }
    /// Largest order of Student laws over all lanes; 0: all are GGX.
    REGAIN_HOST_DEVICE int orders() const { return _orders; }

    /// sigma(-w) of the direction (s, 0, c), s^2 = s2, c >= 0, which need not be unit.
    REGAIN_HOST_DEVICE Real area_below(const Real& c, const Real& s2) const
    {
        Real sum(0);
        for (int i = 0; i < _nodes; ++i) sum += _weight[i] * length_below(i, c, s2);
        return Real(0.5f) * sum;
    }

    /// sigma(w) of the same direction.
    REGAIN_HOST_DEVICE Real area_above(const Real& c, const Real& s2) const
    {
        if (_orders > 0) return c + area_below(c, s2);
        // Of GGX it is (c + q) / 2: nothing cancels, and no node divides.
        Real sum = c;
        for (int i = 0; i < _nodes; ++i) sum += _weight[i] * detail::sqrt(c * c + _t[i] * s2);
        return Real(0.5f) * sum;
    }

    /// D of the mixture at a unit normal with squared components z2 and a2 = 1 - z2.
    REGAIN_HOST_DEVICE Real D(const Real& z2, const Real& a2) const
    {
        Real sum(0);
        for (int i = 0; i < _nodes; ++i)
        {
            const Real inverse = Real(1) / (_t[i] * z2 + a2);
            const Real x = _xi[i] * _t[i] * z2 * inverse;
            Real orders(0);
            for (int j = _orders; j >= 0; --j)
                orders = orders * x + _order[j] * constant<Real>(j + 1);
            sum += _weight[i] * _t[i] * inverse * inverse * orders;
        }
        return constant<Real>(0.318309886183790671538) * sum;
    }

    /// A term, with the probability of its share in area = sigma(w), w = (s, 0, c) with c of either
    /// sign. x selects the node, y the order.
    REGAIN_HOST_DEVICE Term term(const Real& c, const Real& s2, const Real& area, const Real& x,
                                 const Real& y) const
    {
        const Real above = detail::max(c, Real(0)), height = detail::abs(c);
        const Real target = x * area;
        Real sum(0), xi = _xi[0];
        Term term{_t[0], {Real(0), constant<Real>(student().cap[0])}};
        for (int i = 0; i < _nodes; ++i)
        {
            const MaskOf<Real> reached = sum <= target;
            if (!any<Real>(reached)) break;
            term.t = select(reached, _t[i], term.t);
            xi = select(reached, _xi[i], xi);
            sum += _weight[i] * (above * orders_mass(i) + Real(0.5f) * length_below(i, height, s2));
        }
        if (_orders > 0)
            term.order =
                student_order(StudentView<Real>(term.t, height, s2), above, _order, xi, _orders, y);
        return term;
    }

private:
    REGAIN_HOST_DEVICE void add(const Real& weight, const Real& t, const Real& xi)
    {
        _weight[_nodes] = weight;
        _t[_nodes] = t;
        _xi[_nodes] = xi;  // beta u / t
        ++_nodes;
    }

    REGAIN_HOST_DEVICE void add_all(const Real& beta, const Real& log_beta, const Real& a,
                                    const Real& delta, const Real& m)
    {
        const Real one(1), first = constant<Real>(-reach);
        // Laws of a higher order are narrower, and need more nodes near t = beta.
        const Real last = constant<Real>(reach) + constant<Real>(1.5) * detail::log1p(m);
        const Real range = last - log_beta - first;
        const Real widest = constant<Real>(step) / (one + constant<Real>(0.1) * m);
        // As many as each lane needs, so that a lane answers as it would alone.
        Real intervals(1);
        int inner = 2;
        for (; inner + 2 < max_nodes; ++inner)
        {
            const MaskOf<Real> more = range > intervals * widest;
            if (!any<Real>(more)) break;
            intervals += select(more, one, Real(0));
        }
        const Real h = range / intervals;

        // The tails are sums over e^(-a h i) and e^(-delta h i). All weights are multiplied by
        // these, so that they are finite at a = 0 and delta = 0, where one node has it all.
        const Real open_left = -detail::expm1(-a * h), open_right = -detail::expm1(-delta * h);

        add_tail(beta, first - h, a, h, open_right, false);
        const Real ratio = detail::exp(h), power_ratio = detail::exp(a * h);
        Real s = detail::exp(first), power = h * open_left * open_right * detail::exp(a * first);
        for (int i = 0; i < inner; ++i)
        {
            const Real wide = one + beta * s, narrow = one + s;
            const MaskOf<Real> mine = constant<Real>(i) <= intervals;
            add(select(mine, power / (wide * narrow), Real(0)), wide / narrow, beta * s / wide);
            s *= select(mine, ratio, one);
            power *= select(mine, power_ratio, one);
        }
        // The other end is the same in 1 / (beta s).
        add_tail(beta, -last - h, delta, h, open_left * detail::exp((delta - one) * log_beta),
                 true);
    }

    // One node for all those at log s = first, first - h, first - 2h ... of the weight
    // s^a / ((1 + s) (1 + beta s)), where the last two factors are a series in s. Mirrored: s
    // stands for 1 / (beta s).
    REGAIN_HOST_DEVICE void add_tail(const Real& beta, const Real& first, const Real& a,
                                     const Real& h, const Real& scale, bool mirrored)
    {
        const Real one(1), s = detail::exp(first), c1 = one + beta, c2 = one + beta * c1;
        const Real open = -detail::expm1(-a * h), open1 = open / -detail::expm1(-(a + one) * h),
                   open2 = open / -detail::expm1(-(a + Real(2)) * h),
                   open3 = open / -detail::expm1(-(a + Real(3)) * h);
        const Real mass = one - s * (c1 * open1 - s * c2 * open2);
        const Real mean = s * (open1 - s * (c1 * open2 - s * c2 * open3)) / mass;
        const Real weight = h * scale * detail::exp(a * first) * mass;
        const Real wide = one + beta * mean, narrow = one + mean;
        if (mirrored)
            add(weight, beta * narrow / wide, one / narrow);
        else
            add(weight, wide / narrow, beta * mean / wide);
    }

    // Sum of the weights of the orders at a node.
    REGAIN_HOST_DEVICE Real orders_mass(int i) const
    {
        Real sum = _order[_orders];
        for (int j = _orders - 1; j >= 0; --j) sum = sum * _xi[i] + _order[j];
        return sum;
    }

    // Twice the area from below of all orders at a node: the sum of order_j xi^j q R_j(z), where
    // R_j = R_m + b_(j+1) z^(j+1) + ... + b_m z^m.
    REGAIN_HOST_DEVICE Real length_below(int i, const Real& c, const Real& s2) const
    {
        if (_orders == 0)
        {
            const Real tangential2 = _t[i] * s2;
            return tangential2 / (detail::sqrt(c * c + tangential2) + c);
        }
        const StudentView<Real> view(_t[i], c, s2);
        Real mass = _order[0], x(1), power(1), sum(0);
        for (int k = 1; k <= _orders; ++k)
        {
            power *= view.z;
            sum += constant<Real>(student().b[k]) * power * mass;
            x *= _xi[i];
            mass += _order[k] * x;
        }
        return view.q * (sum + mass * view.remainder(_orders));
    }

    Real _weight[max_nodes], _t[max_nodes], _xi[max_nodes];
    Real _order[student_orders];
    int _nodes = 0, _orders = 0;
};

}  // namespace detail

REGAIN_NAMESPACE_END
