// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Closures, whatever their parameters, directions and random numbers are: finite, non-negative,
// unit answers, and no floating-point traps.

#include "target.h"

#include "conform_subjects.h"

#include <cfenv>
#include <cmath>
#include <cstring>

using namespace regain;

namespace {

// Numbers out of bytes: some that are special, some within [0, 1), some any at all.
class Bytes
{
public:
    Bytes(const std::uint8_t* data, std::size_t size) : _data(data), _size(size) {}

    std::uint8_t byte() { return _at < _size ? _data[_at++] : 0; }
    double number()
    {
        static const double special[] = {
            0,    -0.0,   1,        -1,        0.5,          1e-30,       1e-7,        1e-4,
            1e30, 5e-324, HUGE_VAL, -HUGE_VAL, std::nan(""), 1 - 0x1p-24, 1 - 0x1p-53, 1 + 0x1p-23};
        const std::uint8_t kind = byte();
        if (kind < 64) return special[kind % 16];
        if (kind < 192)
        {
            const unsigned high = byte();
            return (high * 256 + byte()) / 65536.0;
        }
        std::uint64_t raw = 0;
        for (int i = 0; i < 8; ++i) raw = raw << 8 | byte();
        double x;
        std::memcpy(&x, &raw, sizeof x);
        // A NaN is a quiet one: of a signalling one a mere conversion to float traps.
        return std::isnan(x) ? std::nan("") : x;
    }
    Imath::V3d triple()
    {
        const double x = number(), y = number();
        return {x, y, number()};
    }
    /// A unit vector, unless the numbers are none.
    Imath::V3d direction()
    {
        const std::uint8_t kind = byte();
        if (kind < 32) return triple();
        const double mu = 2 * number() - 1, phi = 7 * number();
        const double r = std::sqrt(std::max(0.0, (1 - mu) * (1 + mu)));
        return {r * std::cos(phi), r * std::sin(phi), mu};
    }

private:
    const std::uint8_t* _data;
    std::size_t _size, _at = 0;
};

bool sane(double x) { return std::isfinite(x) && x >= 0; }
template <class Color>
bool sane(const Color& c)
{
    return sane(c.x) && sane(c.y) && sane(c.z);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    const auto& subjects = tools::built_in_subjects();
    const auto& subject = *subjects[(bytes.byte() * 256u + bytes.byte()) % subjects.size()];
    conformance::Parameters p;
    p.in_double = bytes.byte() % 2;
    p.reflectance = static_cast<conformance::Reflectance>(bytes.byte() % 3);
    for (double* x : {&p.alpha_x, &p.alpha_y, &p.gamma, &p.eta}) *x = bytes.number();
    for (auto* c : {&p.F0, &p.F82, &p.n, &p.k}) *c = Imath::Color3<double>(bytes.triple());
    const Imath::V3d wo = bytes.direction(), wi = bytes.direction(), u = bytes.triple(),
                     v = bytes.triple();

    std::feclearexcept(FE_ALL_EXCEPT);
    const auto closure = subject.make(p);
    closure->prepare(wo);
    const auto f = closure->eval(wi, v);
    const double pdf = closure->pdf(wi);
    const auto s = closure->sample(u);
    const bool trapped = std::fetestexcept(FE_INVALID | FE_DIVBYZERO);

    const auto require = [&](bool holds, const char* what) {
        if (!holds) fuzz::fault(subject.name() + ": " + what);
    };
    require(!trapped, "an invalid operation or a division by zero");
    require(sane(f), "eval");
    require(sane(pdf), "pdf");
    require(sane(s.weight), "the weight of a sample");
    require(sane(s.pdf), "the pdf of a sample");
    require(std::abs(s.wi.length() - 1) < (p.in_double ? 1e-12 : 1e-6), "a sampled direction");
    require(!s.valid || s.pdf > 0, "a sample without a pdf");
    return 0;
}
