// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// WidePoints of any closure, as many points at a time as a vector of floats has lanes:
///
///     using Real = xsimd::batch<float>;
///     const auto closure = compensated(Conductor<Real>(...), Method::turquin, tables);
///     const auto* points = WideClosure<decltype(closure)>::create(closure, n, {wo}, memory);
///     points->eval({n}, wi, {}, value, pdf);
///
/// It is compiled for the instruction set of its Real. A program that is to run on several
/// compiles a file with one for each and picks at run time: no code but that of vectors' own types
/// must then be left in such a file for the linker to share (see shaders/src/wide/).
///
/// Needs xsimd.

#pragma once

#include <regain/closures/compensated.h>
#include <regain/closures/host_queries.h>
#include <regain/closures/shading_frame.h>
#include <regain/closures/wide_points.h>
#include <regain/closures/wide_walks.h>
#include <regain/closures/xsimd.h>

#include <new>
#include <type_traits>

REGAIN_NAMESPACE_BEGIN

namespace detail {

/// Entries of a call that are computed together: lane l answers entry from[l], or none (-1).
template <int lanes>
struct WideLanes
{
    int from[lanes];
    bool straight;  // from[l] = from[0] + l in all lanes

    static WideLanes one_after_another(int first)
    {
        WideLanes l;
        l.straight = true;
        for (int i = 0; i < lanes; ++i) l.from[i] = first + i;
        return l;
    }
    /// 0, 1, 2 ...
    struct Numbers
    {
        alignas(64) int of[lanes];
    };
    static constexpr Numbers numbers()
    {
        Numbers n{};
        for (int i = 0; i < lanes; ++i) n.of[i] = i;
        return n;
    }
    static WideLanes none()
    {
        WideLanes l;
        l.straight = false;
        for (int i = 0; i < lanes; ++i) l.from[i] = -1;
        return l;
    }
};

/// Numbers of the lanes' entries; `otherwise` in lanes that have none.
template <class Real>
REGAIN_INLINE Real load_lanes(const float* data, std::ptrdiff_t stride,
                              const WideLanes<int(Real::size)>& lanes, float otherwise)
{
    if (lanes.straight && stride == 1) return Real::load_unaligned(data + lanes.from[0]);
    if (lanes.straight)
    {
        alignas(64) static constexpr auto step = WideLanes<int(Real::size)>::numbers();
        const IndexOf<Real> at = IndexOf<Real>::load_aligned(step.of) * int(stride);
        return Real::gather(data + lanes.from[0] * stride, at);
    }
    alignas(64) float values[Real::size];
    for (std::size_t i = 0; i < Real::size; ++i)
        values[i] = lanes.from[i] < 0 ? otherwise : data[lanes.from[i] * stride];
    return Real::load_aligned(values);
}
template <class Real>
REGAIN_INLINE Vec3<Real> load_lanes(const ConstTriples3f& t,
                                    const WideLanes<int(Real::size)>& lanes)
{
    return {load_lanes<Real>(t.x, t.stride, lanes, 0), load_lanes<Real>(t.y, t.stride, lanes, 0),
            load_lanes<Real>(t.z, t.stride, lanes, 0)};
}

template <class Real>
REGAIN_INLINE void store_lanes(float* data, std::ptrdiff_t stride,
                               const WideLanes<int(Real::size)>& lanes, const Real& value)
{
    if (lanes.straight && stride == 1)
    {
        value.store_unaligned(data + lanes.from[0]);
        return;
    }
    alignas(64) float values[Real::size];
    value.store_aligned(values);
    for (std::size_t i = 0; i < Real::size; ++i)
        if (lanes.from[i] >= 0) data[lanes.from[i] * stride] = values[i];
}
template <class Real, class Three>
REGAIN_INLINE void store_lanes(const Triples3f& t, const WideLanes<int(Real::size)>& lanes,
                               const Three& value)
{
    store_lanes<Real>(t.x, t.stride, lanes, value.x);
    store_lanes<Real>(t.y, t.stride, lanes, value.y);
    store_lanes<Real>(t.z, t.stride, lanes, value.z);
}

/// The gain of a direction, of a closure whose compensation is one.
template <class Closure, class = void>
struct GainOfWo
{
    template <class Real>
    static Color3<Real> of(const Closure&, const Vec3<Real>&)
    {
        return Color3<Real>(Real(1));
    }
};
template <class Lobe, class Gain>
struct GainOfWo<Compensated<Lobe, Gain>>
{
    template <class Real>
    static Color3<Real> of(const Compensated<Lobe, Gain>& closure, const Vec3<Real>& wo)
    {
        return closure.gain().at(wo);
    }
};

}  // namespace detail

/// Made in memory of the caller's; no destructor has to run.
template <class ClosureType>
class WideClosure final : public WidePoints
{
public:
    using Closure = ClosureType;
    using Real = typename Closure::Real;
    using Prepared = typename Closure::Prepared;
    static constexpr int lanes = int(Real::size);

    /// Null where memory is spent.
    static WideClosure* create(const Closure& closure, int points, const WideSurface& surface,
                               const WideMemory& memory)
    {
        static_assert(std::is_trivially_destructible_v<Prepared>);
        const std::size_t blocks = (static_cast<std::size_t>(points) + lanes - 1) / lanes;
        auto* self = allocate<WideClosure>(memory, 1);
        auto* b = allocate<Block>(memory, blocks);
        auto* f = surface.in_world() ? allocate<Frame>(memory, blocks) : nullptr;
        if (!self || !b || (surface.in_world() && !f)) return nullptr;
        return new (self) WideClosure(closure, points, surface, b, f);
    }

    void eval(const WideSelection& entries, const ConstTriples3f& wi, const ConstTriples3f& u,
              const Triples3f& value, float* pdf) const override
    {
        const auto answer = [&](const Prepared& prepared, const Frame* frame, const Lanes& l) {
            Vec3<Real> w = detail::load_lanes<Real>(wi, l);
            if (frame) w = frame->known(w);
            if (value)
            {
                Vec3<Real> numbers(Real(0));
                if constexpr (stochastic) numbers = detail::load_lanes<Real>(u, l);
                Color3<Real> f = evaluate(prepared, w, numbers);
                if (_radiance) f *= radiance_of(prepared, w);
                detail::store_lanes<Real>(value, l, f);
            }
            if (pdf) detail::store_lanes<Real>(pdf, 1, l, prepared.pdf(w));
        };
        for_entries(entries, 0, count_of(entries), answer);
    }

    void sample(const WideSelection& entries, const ConstTriples3f& u,
                const WideSamples& result) const override
    {
        if constexpr (detail::IsWalk<Prepared>::value)
            return sample_walks(entries, u, result);
        else
            for_entries(entries, 0, count_of(entries),
                        [&](const Prepared& prepared, const Frame* frame, const Lanes& l) {
                            const auto s = prepared.sample(detail::load_lanes<Real>(u, l));
                            store_sample(prepared, frame, l, s, result);
                        });
    }

    void albedo(const Triples3f& reflect, const Triples3f& transmit) const override
    {
        for_each_block([&](int b, const Lanes& l) {
            const Albedo<Real> a = _blocks[b].prepared.albedo();
            if (reflect) detail::store_lanes<Real>(reflect, l, a.reflect);
            if (transmit) detail::store_lanes<Real>(transmit, l, a.transmit);
        });
    }
    void expected_albedo(const Triples3f& sum) const override
    {
        for_each_block([&](int b, const Lanes& l) {
            const Albedo<Real> a = regain::expected_albedo(_blocks[b].prepared);
            detail::store_lanes<Real>(sum, l, Color3<Real>(a.reflect + a.transmit));
        });
    }

    void gain(const Triples3f& result) const override
    {
        for_each_block([&](int b, const Lanes& l) {
            const Vec3<Real> wo = _blocks[b].prepared.wo();
            detail::store_lanes<Real>(result, l, detail::GainOfWo<Closure>::of(_closure, wo));
        });
    }

private:
    using Lanes = detail::WideLanes<lanes>;
    static constexpr bool stochastic = detail::TakesNumbersInEval<Prepared, Real>::value;
    // Entries of one point in a row that are worth a block of their own.
    static constexpr int worth_a_block = lanes / 2;

    // Points that are computed together.
    struct Block
    {
        Prepared prepared;
        Vec3<Real> wo;  // as it was given, in the frame
    };
    using Frame = ShadingFrame<Real>;

    WideClosure(const Closure& closure, int points, const WideSurface& surface, Block* blocks,
                Frame* frames)
        : _closure(closure),
          _points(points),
          _blocks(blocks),
          _frames(frames),
          _radiance(surface.radiance)
    {
        for_each_block([&](int b, const Lanes& l) {
            Vec3<Real> wo = detail::load_lanes<Real>(surface.V, l);
            if (frames)
            {
                const Vec3<Real> N = detail::load_lanes<Real>(surface.N, l),
                                 Ng = detail::load_lanes<Real>(surface.Ng, l),
                                 T = detail::load_lanes<Real>(surface.T, l);
                new (frames + b)
                    Frame(surface.facing ? Frame::facing(wo, N, Ng, T) : Frame::of(N, Ng, T));
                wo = frames[b].known(wo);
            }
            new (blocks + b) Block{_closure.prepare(wo), wo};
        });
    }

    template <class T>
    static T* allocate(const WideMemory& memory, std::size_t n)
    {
        return static_cast<T*>(memory.function(memory.arena, n * sizeof(T), alignof(T)));
    }

    template <class F>
    void for_each_block(const F& f) const
    {
        for (int b = 0; b * lanes < _points; ++b)
        {
            const int first = b * lanes;
            Lanes l = Lanes::one_after_another(first);
            if (first + lanes > _points) cut(l, _points);
            f(b, l);
        }
    }
    static void cut(Lanes& l, int end)
    {
        l.straight = false;
        for (int& from : l.from)
            if (from >= end) from = -1;
    }

    int count_of(const WideSelection& entries) const
    {
        return entries.at || entries.count < _points ? entries.count : _points;
    }

    // answer(prepared, frame, lanes) until entries begin to end - 1 have been answered; without
    // `at`, begin is a multiple of `lanes`.
    template <class F>
    void for_entries(const WideSelection& entries, int begin, int end, const F& answer) const
    {
        if (!entries.at)
        {
            for (int b = begin / lanes; b * lanes < end; ++b)
            {
                Lanes l = Lanes::one_after_another(b * lanes);
                if ((b + 1) * lanes > end) cut(l, end);
                answer(_blocks[b].prepared, _frames ? _frames + b : nullptr, l);
            }
            return;
        }
        for (int j = begin; j < end;)
        {
            const int at = entries.at[j], same = run_of_one_point(entries, j, end);
            if (same >= worth_a_block)
            {
                answer_at_point(at, j, j + same, answer);
                j += same;
                continue;
            }
            const int b = at / lanes;
            Lanes l = Lanes::none();
            const int first = j;
            bool straight = at % lanes == 0;
            for (; j < end && entries.at[j] / lanes == b; ++j)
            {
                const int lane = entries.at[j] % lanes;
                if (l.from[lane] >= 0) break;
                straight = straight && lane == j - first;
                l.from[lane] = j;
            }
            l.straight = straight && j - first == lanes;
            answer(_blocks[b].prepared, _frames ? _frames + b : nullptr, l);
        }
    }
    static int run_of_one_point(const WideSelection& entries, int j, int end)
    {
        int k = j + 1;
        while (k < end && entries.at[k] == entries.at[j]) ++k;
        return k - j;
    }

    // Entries begin to end - 1, all at one point, which then is in every lane.
    template <class F>
    void answer_at_point(int at, int begin, int end, const F& answer) const
    {
        const auto b = std::size_t(at / lanes), lane = std::size_t(at % lanes);
        const auto all = [&](const Real& x) { return Real(x.get(lane)); };
        const auto all3 = [&](const Vec3<Real>& w) {
            return Vec3<Real>(all(w.x), all(w.y), all(w.z));
        };
        const Prepared prepared = _closure.prepare(all3(_blocks[b].wo));
        const Vec3<Real> none(Real(0));
        Frame frame{none, none, none, none};
        if (_frames)
        {
            const Frame& f = _frames[b];
            frame.x = all3(f.x);
            frame.y = all3(f.y);
            frame.z = all3(f.z);
            frame.geometric = all3(f.geometric);
        }
        for (int j = begin; j < end; j += lanes)
        {
            Lanes l = Lanes::one_after_another(j);
            if (j + lanes > end) cut(l, end);
            answer(prepared, _frames ? &frame : nullptr, l);
        }
    }

    void store_sample(const Prepared& prepared, const Frame* frame, const Lanes& l,
                      const Sample<Real>& s, const WideSamples& result) const
    {
        Vec3<Real> w = s.wi;
        MaskOf<Real> valid = s.valid;
        Color3<Real> weight = s.weight;
        if (frame)
        {
            w = frame->to_world(s.wi);
            valid = detail::both<Real>(valid, frame->is_on_its_side(w, s.wi));
            weight = detail::select(valid, weight, Color3<Real>(Real(0)));
            if (_radiance) weight *= radiance_of(prepared, s.wi);
        }
        if (result.wi) detail::store_lanes<Real>(result.wi, l, w);
        if (result.weight) detail::store_lanes<Real>(result.weight, l, weight);
        if (result.pdf)
            detail::store_lanes<Real>(result.pdf, 1, l, detail::select(valid, s.pdf, Real(0)));
        if (result.event) store_event(result.event, l, valid, s);
    }

    // A walk is known in the pool by how many entries are before it.
    void sample_walks(const WideSelection& entries, const ConstTriples3f& u,
                      const WideSamples& result) const
    {
        detail::WalkPool<Closure> pool;
        const int count = count_of(entries);
        for (int begin = 0; begin < count; begin += pool.room)
        {
            const int end = count - begin < pool.room ? count : begin + pool.room;
            int walk[lanes];
            const auto number = [&](const Lanes& l) {
                for (int i = 0; i < lanes; ++i) walk[i] = l.from[i] < 0 ? -1 : l.from[i] - begin;
            };
            for_entries(
                entries, begin, end, [&](const Prepared& prepared, const Frame*, const Lanes& l) {
                    typename Prepared::Flight flight;
                    const auto active = prepared.take_off(detail::load_lanes<Real>(u, l), flight);
                    number(l);
                    pool.add(flight, active, walk);
                });
            pool.fly(_closure);
            for_entries(entries, begin, end,
                        [&](const Prepared& prepared, const Frame* frame, const Lanes& l) {
                            number(l);
                            MaskOf<Real> given_up(false);
                            const auto flight = pool.landed(walk, given_up);
                            store_sample(prepared, frame, l,
                                         prepared.sample_of(prepared.land(flight, given_up)),
                                         result);
                        });
        }
    }

    // What turns transmitted energy into radiance.
    Real radiance_of(const Prepared& prepared, const Vec3<Real>& wi) const
    {
        const Real eta = relative_index(_closure);
        const Vec3<Real> wo = prepared.wo();
        const auto above = wo.z >= Real(0);
        const Real ratio = detail::select(above, Real(1) / eta, eta);
        const auto passes = detail::differ<Real>(above, wi.z >= Real(0));
        return detail::select(passes, ratio * ratio, Real(1));
    }

    static void store_event(std::uint8_t* result, const Lanes& l, const MaskOf<Real>& valid,
                            const Sample<Real>& s)
    {
        const Real none(0);
        const Real bits =
            detail::select(valid, Real(wide_valid), none) +
            detail::select(detail::both<Real>(valid, s.delta), Real(wide_delta), none) +
            detail::select(detail::both<Real>(valid, s.transmitted), Real(wide_transmitted), none);
        alignas(64) float values[lanes];
        bits.store_aligned(values);
        for (int i = 0; i < lanes; ++i)
            if (l.from[i] >= 0) result[l.from[i]] = static_cast<std::uint8_t>(values[i]);
    }

    Closure _closure;
    int _points;
    Block* _blocks;
    Frame* _frames;  // null in the local frame
    bool _radiance;
};

REGAIN_NAMESPACE_END
