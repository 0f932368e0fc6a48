// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/slope_law.h>

#include "octave_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

const double pi = std::acos(-1.0);

// From here on STD is Beckmann, within 1e-6.
constexpr double beckmann_gamma = 1e5;

// (e^x - 1) / x.
double relative_expm1(double x) { return std::abs(x) < 1e-12 ? 1 + 0.5 * x : std::expm1(x) / x; }

// The regularised incomplete beta function I_x(a, b) by its continued fraction, evaluated by
// Lentz's method (DLMF 8.17.22).
double incomplete_beta(double a, double b, double x)
{
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
    const double front = std::exp(a * std::log(x) + b * std::log1p(-x) + std::lgamma(a + b) -
                                  std::lgamma(a) - std::lgamma(b)) /
                         a;
    const double tiny = 1e-300;
    double c = 1, d = 1 - (a + b) * x / (a + 1);
    d = 1 / (std::abs(d) < tiny ? tiny : d);
    double f = d;
    for (int m = 1; m < 10000; ++m)
    {
        double step = 1;
        for (double n : {m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                         -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))})
        {
            d = 1 + n * d;
            d = 1 / (std::abs(d) < tiny ? tiny : d);
            c = 1 + n / c;
            c = std::abs(c) < tiny ? tiny : c;
            step = c * d;
            f *= step;
        }
        if (std::abs(step - 1) < 1e-15) break;
    }
    return front * f;
}

}  // namespace

// sigma / sin theta - s over s: what shadowing adds.
class SlopeLaw::Curve
{
public:
    // g over s in [lo, hi]. Below lo it is g(lo) + (lo - s) / 2, since half of all slopes face away
    // from the horizon; above hi it goes like s^power.
    Curve(const std::function<double(double)>& g, double lo, double hi, double power)
        : _inside(Chebyshev(g, lo, hi), lo, hi),
          _at_lowest(_inside(lo)),
          _at_highest(_inside(hi)),
          _power(power)
    {}

    double operator()(double s) const
    {
        if (s < _inside.lowest()) return _at_lowest + 0.5 * (_inside.lowest() - s);
        if (s > _inside.highest()) return _at_highest * std::pow(s / _inside.highest(), _power);
        return _inside(s);
    }

private:
    // Takes few values of g, which may be slow, to give the many that the curve is made of:
    // polynomials in ln s, piece by piece.
    class Chebyshev
    {
    public:
        Chebyshev(const std::function<double(double)>& g, double lo, double hi)
            : _from(std::log(lo))
        {
            // A little more than asked for: the curve's cells end where they do.
            const double range = std::log(hi / lo) + 0.2;
            _from -= 0.1;
            const int pieces = static_cast<int>(std::ceil(range / 1.5));
            _inv_width = pieces / range;
            for (int i = 0; i < pieces; ++i)
            {
                std::array<double, terms> values, c;
                for (int k = 0; k < terms; ++k)
                {
                    const double t = std::cos(pi * (k + 0.5) / terms);
                    values[at(k)] = g(std::exp(_from + (i + 0.5 + 0.5 * t) / _inv_width));
                }
                for (int j = 0; j < terms; ++j)
                {
                    double sum = 0;
                    for (int k = 0; k < terms; ++k)
                        sum += values[at(k)] * std::cos(pi * j * (k + 0.5) / terms);
                    c[at(j)] = sum * (j == 0 ? 1.0 : 2.0) / terms;
                }
                _pieces.push_back(c);
            }
        }

        double operator()(double s) const
        {
            const double place = std::max(0.0, (std::log(s) - _from) * _inv_width);
            const std::size_t i = std::min(static_cast<std::size_t>(place), _pieces.size() - 1);
            const double t = 2 * (place - static_cast<double>(i)) - 1;
            const std::array<double, terms>& c = _pieces[i];
            double b1 = 0, b2 = 0;  // Clenshaw's recurrence
            for (int j = terms - 1; j > 0; --j)
            {
                const double b = 2 * t * b1 - b2 + c[at(j)];
                b2 = b1;
                b1 = b;
            }
            return t * b1 - b2 + c[0];
        }

    private:
        static constexpr int terms = 14;
        static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

        double _from, _inv_width;
        std::vector<std::array<double, terms>> _pieces;
    };

    OctaveCurve _inside;
    double _at_lowest, _at_highest, _power;
};

SlopeLaw::SlopeLaw(Kind kind, double alpha, double gamma)
    : _kind(kind), _alpha(alpha), _gamma(gamma), _peak(1 / (pi * alpha * alpha))
{
    if (!(alpha > 0 && alpha <= 1)) throw std::invalid_argument("alpha must lie in (0, 1]");
}

SlopeLaw SlopeLaw::ggx(double alpha) { return {Kind::ggx, alpha, 0}; }
SlopeLaw SlopeLaw::beckmann(double alpha) { return {Kind::beckmann, alpha, 0}; }

SlopeLaw SlopeLaw::gtr(double alpha, double gamma)
{
    if (!(gamma >= 0 && gamma <= 100))
        throw std::invalid_argument("gamma of GTR must lie in [0, 100]");
    SlopeLaw law(Kind::gtr, alpha, gamma);
    // int P22 = 1, over v = (a^2 + r^2) / (1 + r^2) in [a^2, 1]; c a^(-2 g) is the peak.
    const double log_a2 = 2 * std::log(alpha);
    law._peak = relative_expm1(log_a2) / (pi * relative_expm1((1 - gamma) * log_a2)) *
                std::exp(-gamma * log_a2);

    // With r^2 = s^2 + e^2 the integrand is smooth, and over ln e the trapezoidal rule converges
    // exponentially.
    const SlopeLaw density = law;
    const auto shadowing = [density, alpha](double s) {
        constexpr double step = 0.3;
        const double first = std::log(std::min(alpha, std::max(s, 1e-2 * alpha))) - 10, last = 32;
        double sum = 0;
        for (double y = first; y < last; y += step)
        {
            const double e = std::exp(y), t = e / s, t2 = t * t;
            const double lever =
                t < 0.1 ? s * t2 * t *
                              (1.0 / 3 - t2 * (1.0 / 5 - t2 * (1.0 / 7 - t2 * (1.0 / 9 - t2 / 11))))
                        : e - s * std::atan(t);
            sum += density.density(std::sqrt(s * s + e * e)) * lever * e * e;
        }
        return 2 * sum * step;
    };
    law._curve = std::make_shared<const Curve>(shadowing, 1e-5 * alpha, 1e5, -1.0);
    return law;
}

SlopeLaw SlopeLaw::std(double alpha, double gamma)
{
    if (!(gamma > 1.5)) throw std::invalid_argument("gamma of STD must be above 1.5");
    if (gamma >= beckmann_gamma) return beckmann(alpha);
    SlopeLaw law(Kind::std, alpha, gamma);
    // Everything is a function of s / alpha; so one curve, at alpha 1, serves all.
    const double k2 = gamma - 1, k = std::sqrt(k2);
    const double C = std::exp(std::lgamma(gamma - 0.5) - std::lgamma(gamma - 1)) / std::sqrt(pi);
    const auto shadowing = [=](double s) {
        return C * k * std::exp((1.5 - gamma) * std::log1p(s * s / k2)) / (2 * gamma - 3) -
               0.5 * s * incomplete_beta(gamma - 1, 0.5, k2 / (k2 + s * s));
    };
    law._curve = std::make_shared<const Curve>(shadowing, 1e-5, 1e4, 3 - 2 * gamma);
    return law;
}

SlopeLaw SlopeLaw::named(const std::string& distribution, double alpha, double gamma)
{
    if (distribution == "ggx") return ggx(alpha);
    if (distribution == "beckmann") return beckmann(alpha);
    if (distribution == "gtr") return gtr(alpha, gamma);
    if (distribution == "std") return std(alpha, gamma);
    throw std::invalid_argument("no distribution is called '" + distribution +
                                "'; there are ggx, beckmann, gtr, std");
}

double SlopeLaw::density(double r) const
{
    const double t = r / _alpha, t2 = t * t;
    switch (_kind)
    {
        case Kind::ggx: return _peak / ((1 + t2) * (1 + t2));
        case Kind::beckmann: return _peak * std::exp(-t2);
        case Kind::gtr:
            return _peak * std::exp((_gamma - 2) * std::log1p(r * r) - _gamma * std::log1p(t2));
        case Kind::std: return _peak * std::exp(-_gamma * std::log1p(t2 / (_gamma - 1)));
    }
    return 0;
}

double SlopeLaw::lever(double log_r) const
{
    // ln(1 + (r / width)^2), where the square may be beyond all doubles.
    const auto log_sum = [&](double width) {
        const double u = 2 * (log_r - std::log(width));
        return u > 80 ? u : std::log1p(std::exp(u));
    };
    const double base = std::log(_peak) + 3 * log_r;
    switch (_kind)
    {
        case Kind::ggx: return std::exp(base - 2 * log_sum(_alpha));
        case Kind::beckmann:
            return std::exp(base - std::exp(2 * std::min(100.0, log_r - std::log(_alpha))));
        case Kind::gtr:
            return std::exp(base + (_gamma - 2) * log_sum(1) - _gamma * log_sum(_alpha));
        case Kind::std: return std::exp(base - _gamma * log_sum(std::sqrt(_gamma - 1) * _alpha));
    }
    return 0;
}

double SlopeLaw::tail_power() const
{
    switch (_kind)
    {
        case Kind::beckmann: return std::numeric_limits<double>::infinity();
        case Kind::std: return 2 * _gamma - 3;
        default: return 1;
    }
}

double SlopeLaw::tail_begin() const
{
    switch (_kind)
    {
        case Kind::beckmann: return longest();
        case Kind::ggx: return _alpha;
        case Kind::gtr: return 1;
        case Kind::std: return std::sqrt(_gamma - 1) * _alpha;
    }
    return 0;
}

double SlopeLaw::longest() const
{
    return _kind == Kind::beckmann ? 6.5 * _alpha : std::numeric_limits<double>::infinity();
}

double SlopeLaw::projected_area(double cos_theta) const
{
    const double sin2 = std::max(0.0, (1 - cos_theta) * (1 + cos_theta));
    if (_kind == Kind::ggx)
        return 0.5 * (cos_theta + std::sqrt(cos_theta * cos_theta + _alpha * _alpha * sin2));
    const double sin_theta = std::sqrt(sin2);
    if (sin_theta <= 0) return cos_theta;
    const double s = cos_theta / sin_theta;
    switch (_kind)
    {
        case Kind::beckmann: {
            const double a = s / _alpha;
            return 0.5 * (cos_theta * (1 + std::erf(a)) +
                          _alpha * sin_theta * std::exp(-a * a) / std::sqrt(pi));
        }
        case Kind::gtr: return cos_theta + sin_theta * (*_curve)(s);
        default: return cos_theta + sin_theta * _alpha * (*_curve)(s / _alpha);
    }
}

}  // namespace luts
REGAIN_NAMESPACE_END
