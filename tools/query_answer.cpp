// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "query_answer.h"

#include "errors.h"
#include "query_line.h"
#include "random_numbers.h"

#include <fmt/compile.h>

#include <cmath>
#include <iterator>

namespace regain::tools {
namespace {

class Writer
{
public:
    explicit Writer(fmt::memory_buffer& out) : _out(out) {}

    Writer& operator<<(std::string_view text)
    {
        _out.append(text.data(), text.data() + text.size());
        return *this;
    }
    Writer& operator<<(const char* text) { return *this << std::string_view(text); }

    template <class Real>
    std::enable_if_t<std::is_floating_point_v<Real>, Writer&> operator<<(Real x)
    {
        // JSON has no word for it, and no closure should answer it.
        if (!std::isfinite(x))
            throw BadInput(
                "the answer is not finite: please report this line as an error of the "
                "library");
        fmt::format_to(std::back_inserter(_out), FMT_COMPILE("{}"), x);
        return *this;
    }

    // Colours are vectors, too.
    template <class Real>
    Writer& operator<<(const Imath::Vec3<Real>& v)
    {
        return *this << "[" << v.x << "," << v.y << "," << v.z << "]";
    }

private:
    fmt::memory_buffer& _out;
};

template <class Real>
Vec3<Real> rounded(const Imath::V3d& w)
{
    return {static_cast<Real>(w.x), static_cast<Real>(w.y), static_cast<Real>(w.z)};
}

// u < 1 also after rounding.
template <class Real>
Real rounded_random(double u)
{
    return std::min(static_cast<Real>(u), std::nextafter(Real(1), Real(0)));
}

template <class Real>
void write_sample(Writer& out, const Sample<Real>& s)
{
    if (!s.valid)
    {
        out << R"({"event":"none"})";
        return;
    }
    out << R"({"wi":)" << s.wi << R"(,"weight":)" << s.weight << R"(,"pdf":)" << s.pdf
        << R"(,"event":")" << (s.transmitted ? "transmit" : "reflect") << R"(","measure":")"
        << (s.delta ? "delta" : "continuous") << R"("})";
}

template <class Closure>
void write_samples(Writer& out, const Closure& closure, const Query& query)
{
    using Real = typename Closure::Real;
    const auto prepared = closure.prepare(rounded<Real>(query.wo));
    if (query.u)
    {
        write_sample(out, prepared.sample({rounded_random<Real>(query.u->x),
                                           rounded_random<Real>(query.u->y)}));
        return;
    }
    RandomNumbers random(query.seed);
    out << R"({"samples":[)";
    for (std::uint64_t i = 0; i < query.n; ++i)
    {
        const Real u = random.template next<Real>(), v = random.template next<Real>();
        if (i > 0) out << ",";
        write_sample(out, prepared.sample({u, v}));
    }
    out << "]}";
}

void write_albedo(Writer& out, const Query& query)
{
    const MeasuredAlbedo albedo = measured_albedo(query.closure, query.wo, query.albedo);
    out << R"({"reflect":)" << albedo.reflect << R"(,"transmit":)" << albedo.transmit
        << R"(,"stderr":)";
    if (albedo.error)
        out << *albedo.error;
    else
        out << "null";
    out << R"(,"how":")" << albedo_methods[static_cast<std::size_t>(query.albedo.how)] << R"("})";
}

template <class Closure>
void write_gain(Writer& out, const Closure& closure, const Query& query)
{
    using Real = typename Closure::Real;
    const Vec3<Real> wo = rounded<Real>(query.wo);
    // Below the horizon the lobe is black, and a gain has nothing to act on.
    const bool above = detail::is_above_horizon(wo);
    out << R"({"gain":)" << (above ? closure.gain().at(wo) : Color3<Real>(Real(1)))
        << R"(,"form":")" << (query.closure.method == Method::none ? "none" : "gain(wo)")
        << R"("})";
}

template <class Closure>
void write_fresnel(Writer& out, const Closure& closure, const Query& query)
{
    using Real = typename Closure::Real;
    const auto& fresnel = closure.lobe().fresnel();
    out << R"({"value":)" << fresnel.at(static_cast<Real>(query.mu)) << R"(,"average":)"
        << fresnel.average() << "}";
}

template <class Closure>
void write_ndf(Writer& out, const Closure& closure, const Query& query)
{
    using Real = typename Closure::Real;
    const auto& distribution = closure.lobe().distribution();
    if (distribution.is_delta())
        throw BadInput(
            fmt::format("alpha {} makes a mirror, whose D is no function; accepted: "
                        "above {} on one axis",
                        std::max(query.closure.alpha_x, query.closure.alpha_y),
                        std::decay_t<decltype(distribution)>::delta_alpha));
    const Vec3<Real> wo = rounded<Real>(query.wo), m = rounded<Real>(query.wm);
    if (!detail::is_above_horizon(wo))
        throw BadInput("'wo' is not above the surface, where lambda is defined");

    // Microfacet normals lie above the surface, visible ones face wo.
    const Real D = m.z > 0 ? distribution.D(m) : Real(0);
    const Real facing = std::max(detail::dot(wo, m), Real(0));
    out << R"({"D":)" << D << R"(,"lambda":)" << distribution.lambda(wo) << R"(,"G1":)"
        << distribution.G1(wo) << R"(,"D_visible":)" << facing * D / distribution.projected_area(wo)
        << "}";
}

template <class Closure>
void write_answer_of(Writer& out, const Closure& closure, const Query& query)
{
    using Real = typename Closure::Real;
    switch (query.op)
    {
        case Op::eval:
            out << R"({"value":)" << closure.eval(rounded<Real>(query.wo), rounded<Real>(query.wi))
                << "}";
            break;
        case Op::pdf:
            out << R"({"pdf":)" << closure.pdf(rounded<Real>(query.wo), rounded<Real>(query.wi))
                << "}";
            break;
        case Op::sample: write_samples(out, closure, query); break;
        case Op::albedo: write_albedo(out, query); break;
        case Op::gain: write_gain(out, closure, query); break;
        case Op::fresnel: write_fresnel(out, closure, query); break;
        case Op::ndf: write_ndf(out, closure, query); break;
    }
}

}  // namespace

void write_answer(const Query& query, fmt::memory_buffer& out)
{
    Writer writer(out);
    with_closure(query.closure,
                 [&](const auto& closure) { write_answer_of(writer, closure, query); });
}

void write_error(std::string_view message, fmt::memory_buffer& out)
{
    // A message may quote a part of a character, or bytes that are none.
    const std::string quoted = Json(message).dump(-1, ' ', false, Json::error_handler_t::replace);
    Writer(out) << R"({"error": )" << quoted << "}";
}

bool answer_line(std::string_view line, fmt::memory_buffer& out)
{
    const std::size_t start = out.size();
    try
    {
        write_answer(read_query(line), out);
        return true;
    }
    catch (const std::exception& e)
    {
        out.resize(start);
        write_error(e.what(), out);
        return false;
    }
}

}  // namespace regain::tools
