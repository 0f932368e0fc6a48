// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/closures/refraction.h>
#include <regain/luts/anisotropic_dielectric.h>

#include "dielectric_facet.h"
#include "rules.h"

#include <algorithm>
#include <array>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

const double pi = std::acos(-1.0);

// t in [0, 1] with its nodes gathered at both ends.
double smooth_step(double t) { return t * t * (3 - 2 * t); }
double smooth_step_slope(double t) { return 6 * t * (1 - t); }

class AnisotropicInterface
{
public:
    AnisotropicInterface(const SlopeLaw& unit, double ax, double ay, const Vec3<double>& wo,
                         double eta, int nodes)
        : _unit(unit),
          _nodes(nodes),
          _ax(ax),
          _ay(ay),
          _wo(wo),
          _eta(eta),
          _k((eta - 1) * (eta + 1)),
          _tail(std::isfinite(unit.tail_power()))
    {
        const double X = ax * wo.x, Y = ay * wo.y;
        _T = std::hypot(X, Y);
        _cos = _T > 1e-12 ? X / _T : 1;
        _sin = _T > 1e-12 ? Y / _T : 0;
        _T = std::max(_T, 1e-12);
        _A = _ax * _ax * _cos * _cos + _ay * _ay * _sin * _sin;
        _B = (_ay * _ay - _ax * _ax) * _sin * _cos;
        _C = _ax * _ax * _sin * _sin + _ay * _ay * _cos * _cos;
        _facet = {projected_area(wo), wo.z};
        const double mu = wo.z, kappa2 = std::abs(_k);
        _curves[0] = {true, mu * _A, -2 * _T, 2 * mu * _B, -mu, mu * _C};
        _curves[1] = {kappa2 < 1,       _T * _T - kappa2 * _A, 2 * _T * mu,
                      -2 * kappa2 * _B, mu * mu - kappa2,      -kappa2 * _C};
        _curves[2] = {_k < 0,           mu * mu * _A,     -2 * mu * _T,
                      2 * mu * mu * _B, kappa2 - mu * mu, mu * mu * _C};
    }

    DielectricAlbedo integrate()
    {
        // Across, evenly in the angle of the slope: what is seen of a tail falls off like b^-2.
        // Pieces begin and end where roots along a line do.
        std::array<double, 9> ends;
        std::size_t n = 0;
        ends[n++] = -0.5 * pi;
        ends[n++] = 0.5 * pi;
        for (const Curve& c : _curves)
        {
            // The discriminant of each is a quadratic of b.
            double roots[2];
            const int found = c.is_there ? solve(c.b1 * c.b1 - 4 * c.a2 * c.b2, 2 * c.a1 * c.b1,
                                                 c.a1 * c.a1 - 4 * c.a2 * c.b0, roots)
                                         : 0;
            for (int i = 0; i < found; ++i) ends[n++] = std::atan(roots[i]);
        }
        std::sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(n));
        for (std::size_t e = 0; e + 1 < n; ++e)
        {
            const double from = ends[e], range = ends[e + 1] - from;
            if (range < 1e-9) continue;
            const QuadratureRule& rule =
                rule_of(std::max(6, static_cast<int>(std::ceil(_nodes * (0.6 + 0.5 * range)))));
            for (std::size_t i = 0; i < rule.x.size(); ++i)
            {
                const double b = std::tan(from + range * smooth_step(rule.x[i]));
                line(b, (1 + b * b) * range * rule.weight[i] * smooth_step_slope(rule.x[i]));
            }
        }
        return _sum;
    }

private:
    double projected_area(const Vec3<double>& w) const
    {
        const double X = _ax * w.x, Y = _ay * w.y, z = std::abs(w.z);
        const double length = std::sqrt(X * X + Y * Y + z * z);
        return length * _unit.projected_area(std::min(1.0, z / length));
    }

    // Where something begins: a2 a^2 + (a1 + b1 b) a + b0 + b2 b^2 = 0.
    struct Curve
    {
        bool is_there;
        double a2, a1, b1, b0, b2;
    };

    // Roots of c2 x^2 + c1 x + c0.
    static int solve(double c2, double c1, double c0, double (&roots)[2])
    {
        const double d = c1 * c1 - 4 * c2 * c0;
        if (d < 0) return 0;
        const double q = -0.5 * (c1 + std::copysign(std::sqrt(d), c1));
        int n = 0;
        if (c2 != 0) roots[n++] = q / c2;
        if (q != 0) roots[n++] = c0 / q;
        return n;
    }

    // All facets of one slope b across wo.
    void line(double b, double db)
    {
        // The tail of a line begins the farther out the farther that is.
        const double root = _tail ? std::sqrt(1 + b * b) : 1;
        std::array<double, 9> ends;
        std::size_t n = 0;
        const auto place = [&](double a) { return std::atan(a / root); };
        const double first = place(-_wo.z / _T), last = 0.5 * pi;
        const auto note = [&](double y) {
            if (y > first && y < last) ends[n++] = y;
        };
        ends[n++] = first;
        ends[n++] = last;
        note(0);
        for (const Curve& c : _curves)
        {
            double roots[2];
            const int found =
                c.is_there ? solve(c.a2, c.a1 + c.b1 * b, c.b0 + c.b2 * b * b, roots) : 0;
            for (int i = 0; i < found; ++i) note(place(roots[i]));
        }
        std::sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(n));
        for (std::size_t e = 0; e + 1 < n; ++e)
        {
            const double from = ends[e], range = ends[e + 1] - from;
            if (range < 1e-9) continue;
            const QuadratureRule& rule = rule_of(
                std::max(4, static_cast<int>(std::ceil(_nodes * std::min(1.0, 0.5 + range)))));
            for (std::size_t i = 0; i < rule.x.size(); ++i)
            {
                const double y = from + range * smooth_step(rule.x[i]);
                const double t = std::tan(y), a = root * t, da = root * (1 + t * t);
                facet(a, b,
                      _unit.density(std::hypot(a, b)) * (_wo.z + _T * a) * db * da * range *
                          rule.weight[i] * smooth_step_slope(rule.x[i]) / _facet.sigma_o);
            }
        }
    }

    void facet(double a, double b, double weight)
    {
        if (!(weight > 1e-11)) return;
        const Vec3<double> slope(_ax * (a * _cos - b * _sin), _ay * (a * _sin + b * _cos), 1);
        const Vec3<double> m = slope * (1 / std::sqrt(slope.dot(slope)));
        const double c = _wo.dot(m);
        if (c <= 0) return;
        const double g2 = _k + c * c, g = std::sqrt(std::max(0.0, g2));
        const double F = g2 > 0 ? fresnel(c, g) : 1;
        const Vec3<double> wr = m * (2 * c) - _wo;
        if (is_reflection(_wo, wr, m))
            _sum.reflected += weight * F * _facet.correlated(wr.z, projected_area(wr));
        if (g2 <= 0) return;
        const Vec3<double> wt = (m * (-_k / (c + g)) - _wo) * (1 / _eta);
        if (!is_transmission(_wo, wt, m)) return;
        const double mu_t = std::min(1.0, -wt.z), sigma_t = projected_area(wt);
        _sum.transmitted_correlated += weight * (1 - F) * _facet.correlated(mu_t, sigma_t);
        _sum.transmitted_beta += weight * (1 - F) * _facet.beta(mu_t, sigma_t);
    }

    const SlopeLaw& _unit;
    int _nodes;
    double _ax, _ay;
    Vec3<double> _wo;
    double _eta, _k;
    bool _tail;
    double _T, _cos, _sin;  // of the stretched wo
    double _A, _B, _C;      // 1 / m.z^2 = 1 + A a^2 + 2 B a b + C b^2
    Curve _curves[3];       // wr at the horizon; total reflection; wt at the horizon
    Masking _facet;
    DielectricAlbedo _sum{0, 0, 0};
};

}  // namespace

DielectricAlbedo anisotropic_dielectric_albedo(const SlopeLaw& unit, double ax, double ay,
                                               const Vec3<double>& wo, double eta_o, int nodes)
{
    return AnisotropicInterface(unit, ax, ay, wo, eta_o, nodes).integrate();
}

}  // namespace luts
REGAIN_NAMESPACE_END
