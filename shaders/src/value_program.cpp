// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/shaders/value_program.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

using Imath::V4f;

template <class F>
V4f each(const V4f& a, const F& f)
{
    return {f(a.x), f(a.y), f(a.z), f(a.w)};
}
template <class F>
V4f each(const V4f& a, const V4f& b, const F& f)
{
    return {f(a.x, b.x), f(a.y, b.y), f(a.z, b.z), f(a.w, b.w)};
}
template <class F>
V4f each(const V4f& a, const V4f& b, const V4f& c, const F& f)
{
    return {f(a.x, b.x, c.x), f(a.y, b.y, c.y), f(a.z, b.z, c.z), f(a.w, b.w, c.w)};
}

float dot(const V4f& a, const V4f& b, int width)
{
    float sum = 0;
    for (int k = 0; k < width; ++k) sum += a[k] * b[k];
    return sum;
}

// Hue in turns, as MaterialX has it.
V4f rgb_to_hsv(const V4f& c)
{
    const float most = std::max({c.x, c.y, c.z}), least = std::min({c.x, c.y, c.z}),
                range = most - least;
    float hue = 0;
    if (range > 0)
    {
        hue = c.x == most   ? (c.y - c.z) / range
              : c.y == most ? 2 + (c.z - c.x) / range
                            : 4 + (c.x - c.y) / range;
        hue /= 6;
        hue -= std::floor(hue);
    }
    return {hue, most > 0 ? range / most : 0, most, c.w};
}

V4f hsv_to_rgb(const V4f& c)
{
    const float hue = 6 * (c.x - std::floor(c.x));
    const auto channel = [&](float shift) {
        const float at = std::fmod(hue + shift, 6.0f), ramp = std::min({at, 4 - at, 1.0f});
        return c.z * (1 - c.y * std::max(ramp, 0.0f));
    };
    return {channel(5), channel(3), channel(1), c.w};
}

float power(float a, float b)
{
    if (a < 0 && b != std::floor(b)) return 0;
    return std::pow(a, b);
}

float smooth_step(float x, float low, float high)
{
    if (x <= low) return 0;
    if (x >= high) return 1;
    const float t = (x - low) / (high - low);
    return t * t * (3 - 2 * t);
}

V4f compute(ValueOp op, const V4f& a, const V4f& b, const V4f& c, const V4f& d, int width)
{
    const auto all = [](float x) { return V4f(x, x, x, x); };
    switch (op)
    {
        case ValueOp::add: return a + b;
        case ValueOp::subtract: return a - b;
        case ValueOp::multiply: return a * b;
        case ValueOp::divide:
            return each(a, b, [](float x, float y) { return y == 0 ? 0 : x / y; });
        case ValueOp::modulo:
            return each(a, b,
                        [](float x, float y) { return y == 0 ? 0 : x - y * std::floor(x / y); });
        case ValueOp::power: return each(a, b, power);
        case ValueOp::minimum: return each(a, b, [](float x, float y) { return std::min(x, y); });
        case ValueOp::maximum: return each(a, b, [](float x, float y) { return std::max(x, y); });
        case ValueOp::absolute: return each(a, [](float x) { return std::abs(x); });
        case ValueOp::sign: return each(a, [](float x) { return float(x > 0) - float(x < 0); });
        case ValueOp::floor: return each(a, [](float x) { return std::floor(x); });
        case ValueOp::ceil: return each(a, [](float x) { return std::ceil(x); });
        case ValueOp::round: return each(a, [](float x) { return std::round(x); });
        case ValueOp::square_root:
            return each(a, [](float x) { return std::sqrt(std::max(x, 0.0f)); });
        case ValueOp::exponential: return each(a, [](float x) { return std::exp(x); });
        case ValueOp::logarithm: return each(a, [](float x) { return x > 0 ? std::log(x) : 0; });
        case ValueOp::sine: return each(a, [](float x) { return std::sin(x); });
        case ValueOp::cosine: return each(a, [](float x) { return std::cos(x); });
        case ValueOp::tangent: return each(a, [](float x) { return std::tan(x); });
        case ValueOp::arc_sine:
            return each(a, [](float x) { return std::asin(std::clamp(x, -1.0f, 1.0f)); });
        case ValueOp::arc_cosine:
            return each(a, [](float x) { return std::acos(std::clamp(x, -1.0f, 1.0f)); });
        case ValueOp::arc_tangent2:
            return each(a, b, [](float y, float x) { return std::atan2(y, x); });
        case ValueOp::clamp:
            return each(a, b, c, [](float x, float low, float high) {
                return std::min(std::max(x, low), high);
            });
        case ValueOp::mix:
            return each(a, b, c, [](float x, float y, float t) { return x * (1 - t) + y * t; });
        case ValueOp::smooth_step: return each(a, b, c, smooth_step);
        case ValueOp::if_greater: return a.x > b.x ? c : d;
        case ValueOp::if_greater_or_equal: return a.x >= b.x ? c : d;
        case ValueOp::if_equal: return a.x == b.x ? c : d;
        case ValueOp::lane: {
            const int k = b.x >= 0 && b.x < 4 ? static_cast<int>(b.x) : 0;
            return all(a[k]);
        }
        case ValueOp::combine: return {a.x, b.x, c.x, d.x};
        case ValueOp::dot: return all(dot(a, b, width));
        case ValueOp::cross:
            return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x, 0};
        case ValueOp::magnitude: return all(std::sqrt(dot(a, a, width)));
        case ValueOp::normalise: {
            const float length = std::sqrt(dot(a, a, width));
            return length > 0 ? a / length : all(0);
        }
        case ValueOp::luminance: {
            const float y = dot(a, b, 3);
            return {y, y, y, a.w};
        }
        case ValueOp::rgb_to_hsv: return rgb_to_hsv(a);
        case ValueOp::hsv_to_rgb: return hsv_to_rgb(a);
    }
    return all(0);
}

V4f finite(const V4f& v)
{
    return each(v, [](float x) { return std::isfinite(x) ? x : 0.0f; });
}

// One component is meant as all; what is beyond the width of others is no part of them.
V4f spread(const V4f& v, int width) { return width == 1 ? V4f(v.x, v.x, v.x, v.x) : v; }

bool is_beyond(float x, AddressMode mode)
{
    return mode == AddressMode::constant && !(x >= 0 && x <= 1);
}

}  // namespace

Value ValueProgram::add_step(const Step& step, int width)
{
    if (static_cast<int>(_steps.size()) == most_steps)
        throw std::length_error("more than " + std::to_string(most_steps) +
                                " operations that depend on the point");
    _steps.push_back(step);
    _is_needed.push_back(false);
    Value v(width, V4f(0.0f));
    v._at = static_cast<int>(_steps.size()) - 1;
    return v;
}

Value ValueProgram::apply(ValueOp op, std::initializer_list<Value> operands, int width)
{
    Step step;
    step.op = op;
    int count = 0;
    bool varies = false;
    for (const Value& v : operands)
    {
        step.operand[count++] = v;
        varies = varies || v.varies();
    }
    step.width = count > 0 ? step.operand[0].width() : 1;
    if (varies) return add_step(step, width);
    return {width, spread(finite(run_step(step, {}, nullptr)), width)};
}

Value ValueProgram::texcoord()
{
    Step step;
    step.source = Source::texcoord;
    return add_step(step, 2);
}

Value ValueProgram::position()
{
    Step step;
    step.source = Source::position;
    return add_step(step, 3);
}

Value ValueProgram::normal()
{
    Step step;
    step.source = Source::normal;
    return add_step(step, 3);
}

Value ValueProgram::image(std::shared_ptr<const Texture> texture, const Value& uv,
                          const Value& beyond, AddressMode u, AddressMode v, int width)
{
    Step step;
    step.source = Source::image;
    step.operand[0] = uv;
    step.operand[1] = beyond;
    step.mode[0] = u;
    step.mode[1] = v;
    step.image = static_cast<int>(_images.size());
    _images.push_back({std::move(texture)});
    return add_step(step, width);
}

void ValueProgram::need(int step)
{
    if (_is_needed[static_cast<std::size_t>(step)]) return;
    // Operands come before what they are operands of, so the order of the indices is one to run in.
    std::vector<int> open{step};
    while (!open.empty())
    {
        const auto at = static_cast<std::size_t>(open.back());
        open.pop_back();
        if (_is_needed[at]) continue;
        _is_needed[at] = true;
        _order.push_back(static_cast<int>(at));
        for (const Value& v : _steps[at].operand)
            if (v.varies()) open.push_back(v._at);
    }
    std::sort(_order.begin(), _order.end());
}

int ValueProgram::output(const Value& v)
{
    for (std::size_t i = 0; i < _outputs.size(); ++i)
        if (_outputs[i].same_as(v)) return static_cast<int>(i);
    if (v.varies()) need(v._at);
    _outputs.push_back(v);
    return static_cast<int>(_outputs.size()) - 1;
}

bool ValueProgram::needs_texcoord_alone() const
{
    return std::none_of(_order.begin(), _order.end(), [&](int step) {
        const Source source = _steps[static_cast<std::size_t>(step)].source;
        return source == Source::position || source == Source::normal;
    });
}

int ValueProgram::images() const
{
    return static_cast<int>(std::count_if(_order.begin(), _order.end(), [&](int i) {
        return _steps[static_cast<std::size_t>(i)].source == Source::image;
    }));
}

V4f ValueProgram::run_step(const Step& s, const SurfacePoint& point, const V4f* results) const
{
    const auto operand = [&](int k) {
        const Value& v = s.operand[k];
        return spread(v.varies() ? results[v._at] : v.constant(), v.width());
    };
    switch (s.source)
    {
        case Source::texcoord: return {point.uv.x, point.uv.y, 0, 0};
        case Source::position: return {point.P.x, point.P.y, point.P.z, 0};
        case Source::normal: return {point.N.x, point.N.y, point.N.z, 0};
        case Source::image: {
            const V4f at = operand(0);
            if (is_beyond(at.x, s.mode[0]) || is_beyond(at.y, s.mode[1])) return operand(1);
            float texel[4];
            _images[static_cast<std::size_t>(s.image)].texture->at(at.x, at.y, s.mode[0], s.mode[1],
                                                                   texel);
            return {texel[0], texel[1], texel[2], texel[3]};
        }
        case Source::operation: break;
    }
    return compute(s.op, operand(0), operand(1), operand(2), operand(3), s.width);
}

void ValueProgram::run(const SurfacePoint& point, V4f* result) const
{
    V4f results[most_steps];
    for (const int i : _order)
        results[i] = finite(run_step(_steps[static_cast<std::size_t>(i)], point, results));
    for (std::size_t k = 0; k < _outputs.size(); ++k)
    {
        const Value& v = _outputs[k];
        result[k] = spread(v.varies() ? results[v._at] : v.constant(), v.width());
    }
}

}  // namespace shaders
REGAIN_NAMESPACE_END
