// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "query_answer.h"

#include "any_closure.h"
#include "errors.h"
#include "query_line.h"
#include "random_numbers.h"

#include <fmt/compile.h>

#include <cmath>
#include <iterator>

namespace regain::tools {
namespace {

// Numbers as the shortest text that reads back as the same number of the query's precision.
class Writer
{
public:
    Writer(fmt::memory_buffer& out, Precision precision) : _out(out), _precision(precision) {}

    Writer& operator<<(std::string_view text)
    {
        _out.append(text.data(), text.data() + text.size());
        return *this;
    }
    Writer& operator<<(const char* text) { return *this << std::string_view(text); }

    Writer& operator<<(double x)
    {
        // JSON has no word for it, and no closure should answer it.
        if (!std::isfinite(x))
            throw BadInput(
                "the answer is not finite: please report this line as an error of the "
                "library");
        if (_precision == Precision::single)
            fmt::format_to(std::back_inserter(_out), FMT_COMPILE("{}"), static_cast<float>(x));
        else
            fmt::format_to(std::back_inserter(_out), FMT_COMPILE("{}"), x);
        return *this;
    }

    // Colours are vectors, too.
    template <class Real>
    Writer& operator<<(const Imath::Vec3<Real>& v)
    {
        return *this << "[" << double(v.x) << "," << double(v.y) << "," << double(v.z) << "]";
    }

private:
    fmt::memory_buffer& _out;
    Precision _precision;
};

// For what the precision of the closure does not limit: measurements.
Writer in_full(fmt::memory_buffer& out) { return {out, Precision::twice}; }

template <class Real>
Vec3<Real> rounded(const Imath::V3d& w)
{
    return {static_cast<Real>(w.x), static_cast<Real>(w.y), static_cast<Real>(w.z)};
}

void write_sample(Writer& out, const Sample<double>& s)
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

void write_samples(Writer& out, const AnyClosure& closure, const Query& query)
{
    if (query.u)
    {
        write_sample(out, closure.sample(*query.u));
        return;
    }
    SampleNumbers numbers(query.closure, query.seed);
    out << R"({"samples":[)";
    for (std::uint64_t i = 0; i < query.n; ++i)
    {
        if (i > 0) out << ",";
        write_sample(out, closure.sample(numbers.next()));
    }
    out << "]}";
}

void write_eval(Writer& out, fmt::memory_buffer& buffer, const AnyClosure& closure,
                const Query& query)
{
    if (!query.closure.is_stochastic() || query.u)
    {
        out << R"({"value":)" << closure.eval(query.wi, query.u.value_or(Imath::V3d(0.0))) << "}";
        return;
    }
    const MeasuredValue value =
        measured_value(closure, query.closure, query.wi, query.n, query.seed);
    in_full(buffer) << R"({"value":)" << value.mean << R"(,"stderr":)" << value.error << "}";
}

void write_albedo(fmt::memory_buffer& buffer, AnyClosure& closure, const Query& query)
{
    Writer out = in_full(buffer);
    const MeasuredAlbedo albedo = measured_albedo(closure, query.closure, query.wo, query.albedo);
    out << R"({"reflect":)" << albedo.reflect << R"(,"transmit":)" << albedo.transmit
        << R"(,"stderr":)";
    if (albedo.error)
        out << *albedo.error;
    else
        out << "null";
    out << R"(,"how":")" << albedo_methods[static_cast<std::size_t>(query.albedo.how)] << R"("})";
}

void write_gain(Writer& out, const AnyClosure& closure, const Query& query)
{
    const bool pairs = std::holds_alternative<shaders::Balanced>(query.closure.method);
    const GainAnswer answer =
        closure.gain(pairs ? std::optional<Imath::V3d>(query.wi) : std::nullopt);
    const auto* method = std::get_if<Method>(&query.closure.method);
    out << R"({"gain":)" << answer.gain << R"(,"form":")"
        << (method && *method == Method::none ? "none" : answer.form) << R"("})";
}

// mu below 0 is seen from inside: only a dielectric has that.
template <class Real>
void write_fresnel(Writer& out, const Query& query)
{
    FresnelSpec spec = query.closure.fresnel;
    if (auto* d = std::get_if<DielectricParameters>(&spec))
        if (query.mu < 0) d->eta = 1 / d->eta;
    with_fresnel<Real>(spec, [&](const auto& fresnel) {
        const auto value = fresnel.at(static_cast<Real>(std::abs(query.mu)));
        out << R"({"value":)" << value << R"(,"average":)" << fresnel.average() << "}";
    });
}

template <class Distribution>
void write_ndf(Writer& out, const Distribution& distribution, const Query& query)
{
    using Real = typename Distribution::Real;
    if (distribution.is_delta())
        throw BadInput(fmt::format(
            "alpha {} makes a mirror, whose D is no function; accepted: "
            "above {} on one axis",
            std::max(query.closure.alpha_x, query.closure.alpha_y), Distribution::delta_alpha));
    const Vec3<Real> wo = rounded<Real>(query.wo), m = rounded<Real>(query.wm);
    if (!detail::is_above_horizon(wo))
        throw BadInput("'wo' is not above the surface, where lambda is defined");

    // Microfacet normals lie above the surface, visible ones face wo.
    const Real D = m.z > 0 ? distribution.D(m) : Real(0);
    const Real facing = std::max(detail::dot(wo, m), Real(0));
    out << R"({"D":)" << double(D) << R"(,"lambda":)" << double(distribution.lambda(wo))
        << R"(,"G1":)" << double(distribution.G1(wo)) << R"(,"D_visible":)"
        << double(facing * D / distribution.projected_area(wo)) << "}";
}

// What needs no closure.
template <class Real>
void write_part(Writer& out, const Query& query)
{
    if (query.op == Op::fresnel)
        write_fresnel<Real>(out, query);
    else
        with_distribution<Real>(query.closure, [&](const auto& d) { write_ndf(out, d, query); });
}

void write_body(const Query& query, fmt::memory_buffer& out)
{
    Writer writer(out, query.closure.precision);
    if (query.op == Op::fresnel || query.op == Op::ndf)
    {
        if (query.op == Op::fresnel && !query.closure.has_microfacets())
            throw BadInput(
                fmt::format("the closure {} has no Fresnel term", name(query.closure.lobe)));
        if (query.closure.precision == Precision::twice)
            write_part<double>(writer, query);
        else
            write_part<float>(writer, query);
        return;
    }
    const bool look_up = query.op == Op::albedo && query.albedo.how == AlbedoMethod::table;
    ClosureSpec spec = query.closure;
    // Albedos are energies.
    if (query.op == Op::albedo) spec.transport = Transport::importance;
    const auto closure = make_closure(spec, look_up);
    closure->prepare(query.wo);
    switch (query.op)
    {
        case Op::eval: write_eval(writer, out, *closure, query); break;
        case Op::pdf: writer << R"({"pdf":)" << closure->pdf(query.wi) << "}"; break;
        case Op::sample: write_samples(writer, *closure, query); break;
        case Op::albedo: write_albedo(out, *closure, query); break;
        case Op::gain: write_gain(writer, *closure, query); break;
        case Op::fresnel:
        case Op::ndf: break;
    }
}

}  // namespace

void write_answer(const Query& query, fmt::memory_buffer& out)
{
    write_body(query, out);
    const std::string note = query.op == Op::ndf ? std::string() : query.closure.note();
    if (note.empty()) return;
    out.resize(out.size() - 1);
    in_full(out) << R"(,"note":")" << note << R"("})";
}

void write_error(std::string_view message, fmt::memory_buffer& out)
{
    // A message may quote a part of a character, or bytes that are none.
    const std::string quoted = Json(message).dump(-1, ' ', false, Json::error_handler_t::replace);
    in_full(out) << R"({"error": )" << quoted << "}";
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
