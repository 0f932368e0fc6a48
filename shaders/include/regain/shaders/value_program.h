// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Numbers of a material that are known only where it is shaded: a straight line of operations on
/// up to four floats each, made once from a graph and run at every point.
///
///     ValueProgram program;
///     const Value u = program.apply(ValueOp::lane, {program.texcoord(), Value(0.0f)}, 1);
///     const Value rough = program.apply(ValueOp::multiply, {u, Value(0.5f)}, 1);
///     const int index = program.output(rough);
///     Imath::V4f out[1];
///     program.run(point, out);                // out[index].x
///
/// What does not depend on the point is computed at once, by the same operations, and is a
/// constant: a graph of constants makes no program at all. What no output needs is never run.
/// Running neither allocates nor throws; whatever is divided by 0, or asked beyond its domain, is a
/// number again by the end: infinities and NaN become 0.

#pragma once

#include <regain/shaders/export.h>
#include <regain/shaders/texture.h>

#include <Imath/ImathVec.h>

#include <initializer_list>
#include <memory>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// Where a surface is shaded.
struct SurfacePoint
{
    Imath::V2f uv{0.0f};             ///< texture coordinates, v upwards
    Imath::V3f P{0.0f};              ///< position, of the object
    Imath::V3f N{0.0f, 0.0f, 1.0f};  ///< unit normal, of the object
};

/// Component by component, but where something else is said. `a`, `b`, `c`, `d` are the operands.
enum class ValueOp {
    add,
    subtract,
    multiply,
    divide,  ///< 0 where b is 0
    modulo,  ///< a - b floor(a / b); 0 where b is 0
    power,   ///< 0 where a < 0 and b is no integer
    minimum,
    maximum,
    absolute,
    sign,
    floor,
    ceil,
    round,
    square_root,  ///< of the positive part
    exponential,
    logarithm,  ///< natural; 0 where a <= 0
    sine,
    cosine,
    tangent,
    arc_sine,
    arc_cosine,
    arc_tangent2,  ///< atan2(a, b)
    clamp,         ///< of a to [b, c]
    mix,           ///< a (1 - c) + b c
    smooth_step,   ///< of a from b to c
    if_greater,    ///< a > b ? c : d, by the first component of a and b
    if_greater_or_equal,
    if_equal,
    lane,     ///< component b of a, the same in all
    combine,  ///< the first components of a, b, c, d
    dot,      ///< of width a's; the same in all
    cross,
    magnitude,
    normalise,
    luminance,  ///< a . b, of three; the same in three, a's fourth as it is
    rgb_to_hsv,
    hsv_to_rgb
};

/// A constant, or where a program puts it.
class Value
{
public:
    explicit Value(float x = 0) : _width(1), _constant(x, x, x, x) {}
    Value(int width, const Imath::V4f& constant) : _width(width), _constant(constant) {}

    int width() const { return _width; }
    bool varies() const { return _at >= 0; }
    /// Where it does not vary.
    const Imath::V4f& constant() const { return _constant; }
    float x() const { return _constant.x; }

    bool is(float x) const { return !varies() && _constant.x == x; }
    bool same_as(const Value& v) const
    {
        return _width == v._width && _at == v._at && (varies() || _constant == v._constant);
    }
    /// The same components, more or fewer of them: one becomes all, missing ones are 0.
    Value as(int width) const
    {
        Value v = *this;
        v._width = width;
        return v;
    }

private:
    friend class ValueProgram;
    int _width;
    int _at = -1;
    Imath::V4f _constant;
};

class ValueProgram
{
public:
    static constexpr int most_steps = 1024;

    /// `width` components, 1 to 4, are meant by the result. Throws std::length_error beyond
    /// most_steps.
    REGAIN_SHADERS_API Value apply(ValueOp, std::initializer_list<Value> operands, int width);
    REGAIN_SHADERS_API Value texcoord();
    REGAIN_SHADERS_API Value position();
    REGAIN_SHADERS_API Value normal();
    /// The picture at uv; `beyond` is what is there in the mode `constant`.
    REGAIN_SHADERS_API Value image(std::shared_ptr<const Texture>, const Value& uv,
                                   const Value& beyond, AddressMode u, AddressMode v, int width);

    /// Wanted by run, at the index that is answered; the same value has one index.
    REGAIN_SHADERS_API int output(const Value&);
    int outputs() const { return static_cast<int>(_outputs.size()); }
    /// Some output varies.
    bool varies() const { return !_order.empty(); }
    /// Of the point, outputs need texture coordinates and nothing else.
    REGAIN_SHADERS_API bool needs_texcoord_alone() const;
    /// Pictures that outputs read.
    REGAIN_SHADERS_API int images() const;

    /// `result` has outputs() entries. Of an output of one component all four are that.
    REGAIN_SHADERS_API void run(const SurfacePoint&, Imath::V4f* result) const;

private:
    enum class Source { operation, texcoord, position, normal, image };
    struct Step
    {
        Source source = Source::operation;
        ValueOp op = ValueOp::add;
        int width = 1;  // of the operand that is measured
        Value operand[4];
        int image = -1;
        AddressMode mode[2] = {AddressMode::periodic, AddressMode::periodic};
    };
    struct Image
    {
        std::shared_ptr<const Texture> texture;
    };

    Value add_step(const Step&, int width);
    void need(int step);
    Imath::V4f run_step(const Step&, const SurfacePoint&, const Imath::V4f* results) const;

    std::vector<Step> _steps;
    std::vector<Image> _images;
    std::vector<Value> _outputs;
    std::vector<int> _order;  // of the steps that outputs need
    std::vector<bool> _is_needed;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
