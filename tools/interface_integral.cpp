// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "interface_integral.h"

#include "hemisphere.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace regain::tools {
namespace {

using Imath::V3d;

// A facet and where it sends wo.
struct FacetPaths
{
    V3d reflected{0.0}, refracted{0.0};
    double reflected_jacobian = 0, refracted_jacobian = 0;  // dwi / dm; 0 where impossible
};

class Integration
{
public:
    // wo.z > 0; eta is the index ahead of it over the index behind.
    Integration(const V3d& wo, double eta, double alpha_x, double alpha_y, int nodes,
                const std::function<InterfaceIntegral(const FacetPaths&)>& f)
        : _wo(wo),
          _eta(eta),
          _alpha_x(alpha_x),
          _alpha_y(alpha_y),
          _radius(gauss_rule(nodes / 4)),
          _azimuth(gauss_rule(5)),
          _tolerance(nodes >= 64 ? 1e-7 : 1e-6),
          _f(f)
    {}

    InterfaceIntegral whole() const
    {
        const double azimuth = std::atan2(_wo.y * _alpha_y, _wo.x * _alpha_x);
        const double quarter = std::acos(0.0);
        InterfaceIntegral sum;
        for (int i = 0; i < 4; ++i)
        {
            const double from = azimuth + quarter * i, to = from + quarter;
            sum.add(refined(from, to, arc(from, to), 7), 1);
        }
        return sum;
    }

private:
    FacetPaths paths(const V3d& m) const
    {
        FacetPaths p;
        const double c = _wo.dot(m);
        if (!(c > 0)) return p;
        p.reflected = m * (2 * c) - _wo;
        if (p.reflected.z > 0) p.reflected_jacobian = 4 * c;
        const double cos2 = 1 - (1 - c * c) / (_eta * _eta);
        if (!(cos2 > 0)) return p;
        const double t = std::sqrt(cos2), slide = c - _eta * t;
        p.refracted = m * (c / _eta - t) - _wo * (1 / _eta);
        if (p.refracted.z < 0) p.refracted_jacobian = slide * slide / (_eta * _eta * t);
        return p;
    }

    // Changes where the range along a ray is to be cut; 0: nothing is there.
    int state(const V3d& m) const
    {
        if (_wo.dot(m) <= 0) return 0;
        const FacetPaths p = paths(m);
        const double c = _wo.dot(m);
        return 1 + 2 * (c * c > 1 - _eta * _eta) + 4 * (p.reflected.z > 0) +
               8 * (p.refracted.z < 0);
    }

    // Along the ray of azimuth phi in the stretched plane of slopes, r dr of it.
    InterfaceIntegral ray(double phi) const
    {
        const double dp = _alpha_x * std::cos(phi), dq = _alpha_y * std::sin(phi);
        // Slopes are r / (1 - r) times the widths.
        const auto normal = [&](double r) { return V3d(dp * r, dq * r, 1 - r).normalized(); };

        std::array<double, 16> edges;
        std::size_t count = 0;
        for (const double e : {0.0, 0.5, 1.0}) edges[count++] = e;
        constexpr int steps = 64;
        int before = state(normal(0));
        for (int i = 0; i < steps; ++i)
        {
            const int after = state(normal(double(i + 1) / steps));
            // Two edges may lie in one step.
            double a = double(i) / steps;
            for (int seen = before; seen != after && count < edges.size();)
            {
                double b = double(i + 1) / steps;
                for (int k = 0; k < 46; ++k)
                {
                    const double middle = 0.5 * (a + b);
                    (state(normal(middle)) == seen ? a : b) = middle;
                }
                edges[count++] = 0.5 * (a + b);
                a = b;
                seen = state(normal(b));
            }
            before = after;
        }
        std::sort(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(count));

        InterfaceIntegral sum;
        for (std::size_t e = 0; e + 1 < count; ++e)
        {
            const double a = edges[e], width = edges[e + 1] - a;
            if (width < 1e-13 || state(normal(a + 0.5 * width)) == 0) continue;
            for (std::size_t i = 0; i < _radius.x.size(); ++i)
            {
                // Nodes gather at both ends, where square roots begin.
                const double y = _radius.x[i], r = a + width * y * y * (3 - 2 * y);
                const double w = _radius.weight[i] * 6 * y * (1 - y) * width;
                // m_z / (1 - r), without the quotient of two numbers that may be 0.
                const double scale = 1 / V3d(dp * r, dq * r, 1 - r).length();
                sum.add(_f(paths(normal(r))), _alpha_x * _alpha_y * scale * scale * scale * r * w);
            }
        }
        return sum;
    }

    InterfaceIntegral arc(double from, double to) const
    {
        InterfaceIntegral sum;
        for (std::size_t i = 0; i < _azimuth.x.size(); ++i)
            sum.add(ray(from + (to - from) * _azimuth.x[i]), _azimuth.weight[i] * (to - from));
        return sum;
    }

    InterfaceIntegral refined(double from, double to, const InterfaceIntegral& whole,
                              int depth) const
    {
        const double middle = 0.5 * (from + to);
        const InterfaceIntegral left = arc(from, middle), right = arc(middle, to);
        InterfaceIntegral sum = left, difference;
        sum.add(right, 1);
        difference.add(sum, 1);
        difference.add(whole, -1);
        double off = 0;
        for (int c = 0; c < 3; ++c)
            off = std::max(
                {off, std::abs(difference.reflected[c]), std::abs(difference.transmitted[c])});
        if (off < _tolerance || depth == 0) return sum;
        InterfaceIntegral better = refined(from, middle, left, depth - 1);
        better.add(refined(middle, to, right, depth - 1), 1);
        return better;
    }

    V3d _wo;
    double _eta, _alpha_x, _alpha_y;
    const luts::QuadratureRule &_radius, &_azimuth;
    double _tolerance;
    const std::function<InterfaceIntegral(const FacetPaths&)>& _f;
};

}  // namespace

InterfaceIntegral integrate_interface(const V3d& wo, double eta, double alpha_x, double alpha_y,
                                      int nodes, const std::function<ColorD(const V3d&)>& f)
{
    if (wo.z == 0) return {};
    const double side = wo.z < 0 ? -1 : 1;
    const auto turned = [side](const V3d& w) { return V3d(w.x, w.y, side * w.z); };
    const std::function<InterfaceIntegral(const FacetPaths&)> at = [&](const FacetPaths& p) {
        InterfaceIntegral value;
        if (p.reflected_jacobian > 0)
            value.reflected = f(turned(p.reflected)) * p.reflected_jacobian;
        if (p.refracted_jacobian > 0)
            value.transmitted = f(turned(p.refracted)) * p.refracted_jacobian;
        return value;
    };
    return Integration(turned(wo), wo.z < 0 ? 1 / eta : eta, alpha_x, alpha_y, nodes, at).whole();
}

}  // namespace regain::tools
