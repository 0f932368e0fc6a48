// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The scattering of a batch by one or several closures. Of the closures that are enabled at a
/// point one proposes the direction, picked by its expected share of the light,
///
///   q_k = lum(w_k E_k) / sum_j lum(w_j E_j)          at least a 256th where w_k is not 0
///
/// and each gives its own weight towards it, in its slot; the pdf is that of the mixture, sum_k q_k
/// p_k. A direction without density belongs to the closure that proposed it. Closures that share a
/// slot add up there. Where the host has no slot left, a closure is neither weighed nor picked.
///
/// w_k is what a material of several closures multiplies closure k by, which for what is under a
/// layer depends on V, or on a light path on L (lobe_weights of host_queries.h).

#pragma once

#include <regain/renderman/lobe_batch.h>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

/// lobe_weights() of a material, at a point of the batch.
using LobeWeightsOf = Color3 (*)(const void* material, int at, const Color3* albedo,
                                 Color3* weight);

class SurfaceBxdf final : public Bxdf
{
public:
    static constexpr int most_lobes = 16;

    /// Null when the arena is spent. make(k) is a LobeBatch of closure k, or null then; `lobes` is
    /// at most most_lobes. The material outlives the context.
    template <class Make>
    static SurfaceBxdf* create(const ShadingContext* ctx, Factory* factory, const LobeSet& wanted,
                               int lobes, const void* material, LobeWeightsOf weights,
                               const Make& make)
    {
        auto* self = ctx->alloc<SurfaceBxdf>();
        if (!self || lobes > most_lobes) return nullptr;
        new (self) SurfaceBxdf(ctx, factory, wanted, material, weights);
        for (int k = 0; k < lobes; ++k)
        {
            LobeBatch* batch = make(k);
            if (!batch) return nullptr;
            self->add(batch);
        }
        if (!self->allocate()) return nullptr;
        self->weigh_points();
        return self;
    }

    Domain evaluateDomain() const override
    {
        unsigned domain = kEmptyDomain;
        for (int k = 0; k < _count; ++k)
            if (!_lobes[k]->discrete) domain |= _lobes[k]->transmissive ? kBoth : kReflect;
        return static_cast<Domain>(domain);
    }

    LobeSet aggregateLobes() const override
    {
        LobeSet made;
        for (int k = 0; k < _count; ++k) made |= _lobes[k]->lobes();
        return made & _wanted;
    }

    void generateSample(Transport, const LobeSet* lobesWanted, Rng* rng, Lobe* sampled, Vec3* Ln,
                        LobeWeights& weights, float* fwdPdf, float* revPdf,
                        Color3* compTrans) override
    {
        Slots slots(weights);
        open_slots(ctx->numPts, lobesWanted, slots);
        draw(rng);
        if (_count > 1)
        {
            constexpr std::uint32_t domain = 0x50494b31;  // not the numbers of the direction
            rng->newDomain(domain);
            rng->draw1D(_choice);
        }
        for (int i = 0; i < ctx->numPts; ++i)
        {
            sampled[i] = Lobe();
            fwdPdf[i] = 0;
            if (revPdf) revPdf[i] = 0;
            if (compTrans) compTrans[i] = Color3(0.0f);
            _own[i] = pick(i, lobesWanted[i] & _usable);
        }
        for (int k = 0; k < _count; ++k)
        {
            int m = 0;
            for (int i = 0; i < ctx->numPts; ++i)
                if (_own[i] == k) _at[m++] = i;
            if (m > 0) _lobes[k]->sample(m, _at, _u, _samples);
        }

        int pairs = 0;
        for (int i = 0; i < ctx->numPts; ++i)
        {
            const int k = _own[i];
            if (k < 0 || !_samples[i].valid) continue;
            const SampledDirection& s = _samples[i];
            const Lobe lobe = _lobes[k]->lobe(!s.transmitted, s.discrete);
            // A lobe that is not wanted has no weight, so it is not sampled either.
            if (!(lobesWanted[i] & _usable).has(lobe)) continue;
            sampled[i] = lobe;
            sampled[i].valid = true;
            Ln[i] = s.L;
            _pairs[pairs++] = {i, i, s.L};
        }
        if (look_back_needed(revPdf)) look_back(pairs);
        for (int j = 0; j < pairs; ++j)
        {
            const int i = _pairs[j].at, k = _own[i];
            const SampledDirection& s = _samples[i];
            const float q = probability(i, k, lobesWanted[i] & _usable);
            slots.of(k, sampled[i])[i] += weight(j, k) * s.value;
            fwdPdf[i] = q * s.pdf;
            if (revPdf) revPdf[i] = s.discrete ? back_probability(j, k, lobesWanted[i]) * s.pdf : 0;
        }
        for (int k = 0; k < _count; ++k)
            add_values(pairs, k, lobesWanted, 1, nullptr, slots, fwdPdf, sampled);
        if (revPdf) add_reverse(pairs, lobesWanted, 1, revPdf, sampled);
    }

    void evaluateSample(Transport, const LobeSet* lobesWanted, Rng* rng, LobeSet* evaluated,
                        const Vec3* Ln, LobeWeights& weights, float* fwdPdf, float* revPdf) override
    {
        draw_for_eval(rng);
        Slots slots(weights);
        open_slots(ctx->numPts, lobesWanted, slots);
        evaluate(0, ctx->numPts, lobesWanted, 1, -1, evaluated, Ln, slots, fwdPdf, revPdf);
    }

    void evaluateSamplesAtIndex(Transport, const LobeSet& lobesWanted, Rng* rng, int index, int n,
                                LobeSet* evaluated, const Vec3* Ln, LobeWeights& weights,
                                float* fwdPdf, float* revPdf) override
    {
        draw_for_eval(rng);
        Slots slots(weights);
        open_slots(1, &lobesWanted, slots);
        // The generator has one set of numbers per point: further directions get what follows from
        // it.
        RandomStream<float> more(_u[index]);
        const Vec3 first = _u[index];
        for (int from = 0; from < n; from += _room)
        {
            const int to = from + _room < n ? from + _room : n;
            if (_estimates)
                for (int j = from; j < to; ++j) _more_u[j - from] = j == 0 ? first : more.next3();
            evaluate(from, to, &lobesWanted, 0, index, evaluated, Ln, slots, fwdPdf, revPdf);
        }
    }

    bool albedo(Color3* result) const override
    {
        for (int k = 0; k < _count; ++k) _lobes[k]->albedo(_E + k * ctx->numPts);
        for (int i = 0; i < ctx->numPts; ++i)
        {
            Color3 E[most_lobes], w[most_lobes];
            for (int k = 0; k < _count; ++k) E[k] = _E[k * ctx->numPts + i];
            _weights(_material, i, E, w);
            result[i] = Color3(0.0f);
            for (int k = 0; k < _count; ++k) result[i] += w[k] * E[k];
        }
        return true;
    }

    bool materialIor(float* result) const override
    {
        for (int k = 0; k < _count; ++k)
        {
            if (_lobes[k]->ior == 1) continue;
            for (int i = 0; i < ctx->numPts; ++i) result[i] = _lobes[k]->ior_at(i);
            return true;
        }
        return false;
    }

private:
    // A direction of which values are wanted, at a point; they go to entry `out`.
    struct Pair
    {
        int at, out;
        Vec3 L;
    };

    /// The weights of one call.
    class Slots
    {
    public:
        explicit Slots(LobeWeights& weights) : _host(weights) {}

        Color3* of(int k, const Lobe& lobe)
        {
            const int side = lobe.reflect ? 0 : 1;
            if (!_asked[k][side])
            {
                _asked[k][side] = true;
                _open[k][side] = _host.addActiveLobe(lobe);
            }
            return _open[k][side];
        }

    private:
        LobeWeights& _host;
        Color3* _open[most_lobes][2] = {};
        bool _asked[most_lobes][2] = {};
    };

    SurfaceBxdf(const ShadingContext* c, Factory* f, const LobeSet& wanted, const void* material,
                LobeWeightsOf weights)
        : Bxdf(c, f), _wanted(wanted), _material(material), _weights(weights)
    {}

    void add(LobeBatch* batch)
    {
        _lobes[_count++] = batch;
        _estimates = _estimates || batch->estimates;
        _three = _three || batch->random_numbers > 2;
    }

    bool allocate()
    {
        constexpr int least = 32;  // directions of one point, at a time
        _room = ctx->numPts < least ? least : ctx->numPts;
        const auto n = static_cast<std::size_t>(ctx->numPts),
                   room = static_cast<std::size_t>(_room), lobes = static_cast<std::size_t>(_count);
        _w = ctx->alloc<Color3>(n * lobes);
        _E = ctx->alloc<Color3>(n * lobes);
        _q = ctx->alloc<float>(n * lobes);
        _pairs_2d = ctx->alloc<Vec2>(n);
        _singles = ctx->alloc<float>(n);
        _choice = ctx->alloc<float>(n);
        _own = ctx->alloc<int>(n);
        _u = ctx->alloc<Vec3>(n);
        _samples = ctx->alloc<SampledDirection>(n);
        _pairs = ctx->alloc<Pair>(room);
        _at = ctx->alloc<int>(room);
        _out = ctx->alloc<int>(room);
        _L = ctx->alloc<Vec3>(room);
        _more_u = ctx->alloc<Vec3>(room);
        _some_u = ctx->alloc<Vec3>(room);
        _value = ctx->alloc<Color3>(room);
        _pdf = ctx->alloc<float>(room);
        _back_w = ctx->alloc<Color3>(room * lobes);
        _back_q = ctx->alloc<float>(room * lobes);
        _back_pdf = ctx->alloc<float>(room * lobes);
        return _w && _E && _q && _pairs_2d && _singles && _choice && _own && _u && _samples &&
               _pairs && _at && _out && _L && _more_u && _some_u && _value && _pdf && _back_w &&
               _back_q && _back_pdf;
    }

    // w and q of all points. One closure is always picked, and nobody asks for its albedo.
    void weigh_points()
    {
        const int n = ctx->numPts;
        if (_count > 1)
            for (int k = 0; k < _count; ++k) _lobes[k]->expected_albedo(_E + k * n);
        for (int i = 0; i < n; ++i)
        {
            Color3 E[most_lobes], w[most_lobes];
            for (int k = 0; k < _count; ++k) E[k] = _count > 1 ? _E[k * n + i] : Color3(1.0f);
            _weights(_material, i, E, w);
            for (int k = 0; k < _count; ++k)
            {
                _w[k * n + i] = w[k];
                _q[k * n + i] = expected_share(w[k], E[k]);
            }
        }
    }

    static float sum(const Color3& c) { return c.x + c.y + c.z; }

    // Not normalised. A closure with a weight is never left out.
    float expected_share(const Color3& w, const Color3& E) const
    {
        if (_count == 1) return 1;
        const float share = sum(w * E), least = sum(w) * (1.0f / 256);
        return share > least ? share : least;
    }

    bool enabled(int k, const LobeSet& wanted) const { return (_lobes[k]->lobes() & wanted).any(); }

    // Of picking closure k at point i, where these lobes are wanted.
    float probability(int i, int k, const LobeSet& wanted) const
    {
        if (_count == 1) return 1;
        return share_of(_q + i, ctx->numPts, k, wanted);
    }
    // The same with L of pair j in the place of V.
    float back_probability(int j, int k, const LobeSet& wanted) const
    {
        if (_count == 1) return 1;
        return share_of(_back_q + j, _room, k, wanted & _usable);
    }
    float share_of(const float* q, int stride, int k, const LobeSet& wanted) const
    {
        float total = 0;
        for (int other = 0; other < _count; ++other)
            if (enabled(other, wanted)) total += q[other * stride];
        return total > 0 ? q[k * stride] / total : 0;
    }

    // The closure that proposes a direction for point i, or -1.
    int pick(int i, const LobeSet& wanted) const
    {
        int candidates[most_lobes], count = 0;
        float total = 0;
        for (int k = 0; k < _count; ++k)
        {
            const float q = _q[k * ctx->numPts + i];
            if (!(q > 0) || !enabled(k, wanted)) continue;
            candidates[count++] = k;
            total += q;
        }
        if (count < 2) return count == 1 ? candidates[0] : -1;
        float u = _choice[i] * total;
        int c = 0;
        while (c + 1 < count && u >= _q[candidates[c] * ctx->numPts + i])
            u -= _q[candidates[c++] * ctx->numPts + i];
        return candidates[c];
    }

    // What a call can use are the lobes that some point wants and that the host has a slot for. A
    // closure that could not tell its weight must have no share of the pdf either, by any call.
    void open_slots(int n, const LobeSet* lobesWanted, Slots& slots)
    {
        LobeSet some;
        for (int i = 0; i < n; ++i) some |= lobesWanted[i] & _wanted;
        _usable.clear();
        for (int k = 0; k < _count; ++k)
            for (const bool reflect : {true, false})
                for (const bool discrete : {false, true})
                {
                    const Lobe lobe = _lobes[k]->lobe(reflect, discrete);
                    if ((_lobes[k]->lobes() & some).has(lobe) && slots.of(k, lobe))
                        _usable |= LobeSet(lobe);
                }
    }

    // What closure k of pair j is multiplied by.
    const Color3& weight(int j, int k) const
    {
        return ctx->lightPath && _count > 1 ? _back_w[k * _room + j]
                                            : _w[k * ctx->numPts + _pairs[j].at];
    }

    bool look_back_needed(const float* revPdf) const
    {
        return revPdf || (ctx->lightPath && _count > 1);
    }

    // All that is to be known of the pairs' directions L in the place of V.
    void look_back(int pairs)
    {
        for (int j = 0; j < pairs; ++j)
        {
            _at[j] = _pairs[j].at;
            _L[j] = _pairs[j].L;
        }
        for (int k = 0; k < _count; ++k)
        {
            _lobes[k]->look_back(pairs, _at, _L, _count > 1 ? _back_w + k * _room : nullptr,
                                 _back_pdf + k * _room);
        }
        if (_count == 1) return;
        for (int j = 0; j < pairs; ++j)
        {
            Color3 E[most_lobes], w[most_lobes];
            for (int k = 0; k < _count; ++k) E[k] = _back_w[k * _room + j];
            _weights(_material, _pairs[j].at, E, w);
            for (int k = 0; k < _count; ++k)
            {
                _back_w[k * _room + j] = w[k];
                _back_q[k * _room + j] = expected_share(w[k], E[k]);
            }
        }
    }

    // Adds what closure k has to say of the pairs. `stride` 0: all points want the same lobes.
    // After generate, `sampled` tells for which of them it has spoken.
    void add_values(int pairs, int k, const LobeSet* lobesWanted, int stride, LobeSet* evaluated,
                    Slots& slots, float* fwdPdf, const Lobe* sampled)
    {
        int m = 0;
        for (int j = 0; j < pairs; ++j)
        {
            const Pair& p = _pairs[j];
            if (sampled && (_own[p.at] == k || sampled[p.at].discrete)) continue;
            const LobeSet wanted = lobesWanted[p.out * stride] & _usable;
            const Lobe asked = _lobes[k]->lobe(_lobes[k]->reflects(p.at, p.L), false);
            if (!(_lobes[k]->lobes() & wanted).has(asked)) continue;
            if (!(_q[k * ctx->numPts + p.at] > 0)) continue;
            _at[m] = p.at;
            _out[m] = j;
            _L[m] = p.L;
            if (_estimates) _some_u[m] = stride ? _u[p.at] : _more_u[j];
            ++m;
        }
        if (m == 0) return;
        _lobes[k]->evaluate(m, _at, _L, _some_u, _value, _pdf);
        for (int s = 0; s < m; ++s)
        {
            if (!(_pdf[s] > 0)) continue;
            const int j = _out[s];
            const Pair& p = _pairs[j];
            const Lobe asked = _lobes[k]->lobe(_lobes[k]->reflects(p.at, p.L), false);
            slots.of(k, asked)[p.out] += weight(j, k) * _value[s];
            fwdPdf[p.out] += probability(p.at, k, lobesWanted[p.out * stride] & _usable) * _pdf[s];
            if (evaluated) evaluated[p.out] |= LobeSet(asked);
        }
    }

    void add_reverse(int pairs, const LobeSet* lobesWanted, int stride, float* revPdf,
                     const Lobe* sampled)
    {
        for (int j = 0; j < pairs; ++j)
        {
            const Pair& p = _pairs[j];
            if (sampled && sampled[p.at].discrete) continue;
            const LobeSet wanted = lobesWanted[p.out * stride] & _usable;
            for (int k = 0; k < _count; ++k)
            {
                const float back = _back_pdf[k * _room + j];
                if (back > 0 && enabled(k, wanted))
                    revPdf[p.out] += back_probability(j, k, wanted) * back;
            }
        }
    }

    // Directions from .. to, each at its own point or all at point `index`. Ln is not read where
    // the host wants no lobe.
    void evaluate(int from, int to, const LobeSet* lobesWanted, int stride, int index,
                  LobeSet* evaluated, const Vec3* Ln, Slots& slots, float* fwdPdf, float* revPdf)
    {
        int pairs = 0;
        for (int j = from; j < to; ++j)
        {
            evaluated[j].clear();
            fwdPdf[j] = 0;
            if (revPdf) revPdf[j] = 0;
            if ((_usable & lobesWanted[j * stride]).any())
                _pairs[pairs++] = {index < 0 ? j : index, j, Ln[j]};
        }
        if (look_back_needed(revPdf)) look_back(pairs);
        for (int k = 0; k < _count; ++k)
            add_values(pairs, k, lobesWanted, stride, evaluated, slots, fwdPdf, nullptr);
        if (!revPdf) return;
        // What is not evaluated has no pdf either way.
        int left = 0;
        for (int j = 0; j < pairs; ++j)
            if (evaluated[_pairs[j].out].any()) keep_pair(left++, j);
        add_reverse(left, lobesWanted, stride, revPdf, nullptr);
    }
    void keep_pair(int to, int from)
    {
        _pairs[to] = _pairs[from];
        for (int k = 0; k < _count; ++k)
        {
            _back_q[k * _room + to] = _back_q[k * _room + from];
            _back_pdf[k * _room + to] = _back_pdf[k * _room + from];
        }
    }

    void draw(Rng* rng)
    {
        rng->draw2D(_pairs_2d);
        if (_three)
        {
            constexpr std::uint32_t domain = 0x54485231;  // not the first of the pair again
            rng->newDomain(domain);
            rng->draw1D(_singles);
        }
        for (int i = 0; i < ctx->numPts; ++i)
            _u[i] = Vec3(_pairs_2d[i].x, _pairs_2d[i].y, _three ? _singles[i] : 0.0f);
    }
    void draw_for_eval(Rng* rng)
    {
        if (!_estimates) return;
        constexpr std::uint32_t domain = 0x45564131;  // not the numbers of generateSample
        rng->newDomain(domain);
        draw(rng);
    }

    LobeSet _wanted, _usable;
    const void* _material;
    LobeWeightsOf _weights;
    LobeBatch* _lobes[most_lobes];
    int _count = 0, _room = 0;
    bool _estimates = false, _three = false;

    // By closure and point.
    Color3 *_w, *_E;
    float* _q;
    // By point.
    Vec2* _pairs_2d;
    float *_singles, *_choice;
    int* _own;  // the closure that proposes
    Vec3* _u;
    SampledDirection* _samples;
    // By pair, or by closure and pair.
    Pair* _pairs;
    int *_at, *_out;
    Vec3 *_L, *_more_u, *_some_u;
    Color3 *_value, *_back_w;
    float *_pdf, *_back_q, *_back_pdf;
};

}  // namespace renderman
REGAIN_NAMESPACE_END
