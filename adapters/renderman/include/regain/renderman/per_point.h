// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What differs from point to point of a batch: closures whose parameters come from textures, and
/// presence.

#pragma once

#include <regain/renderman/lobe_batch.h>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

/// A closure of one kind, at each point another: a batch of one for each.
class PerPointBatch final : public LobeBatch
{
public:
    /// make(context, i) is the LobeBatch of point i, which is all there is of `context`. Null when
    /// the arena is spent, or it answers null.
    template <class Make>
    static PerPointBatch* create(const ShadingContext* ctx, const Make& make)
    {
        const auto n = static_cast<std::size_t>(ctx->numPts);
        auto* self = ctx->alloc<PerPointBatch>();
        auto* contexts = ctx->alloc<ShadingContext>(n);
        auto* batches = ctx->alloc<const LobeBatch*>(n);
        if (!self || !contexts || !batches) return nullptr;
        new (self) PerPointBatch(ctx->numPts, batches);
        for (int i = 0; i < ctx->numPts; ++i)
        {
            auto* one = new (contexts + i) ShadingContext(*ctx);
            one->numPts = 1;
            one->Vn += i;
            one->Nn += i;
            one->Ngn += i;
            one->Tn += i;
            if (one->st) one->st += i;
            if (one->Po) one->Po += i;
            const LobeBatch* made = make(one, i);
            if (!made) return nullptr;
            batches[i] = made;
            self->take(*made, i == 0);
        }
        return self;
    }

    float ior_at(int at) const override { return _of[at]->ior; }

    void albedo(Color3* result) const override
    {
        for (int i = 0; i < _points; ++i) _of[i]->albedo(result + i);
    }
    void expected_albedo(Color3* result) const override
    {
        for (int i = 0; i < _points; ++i) _of[i]->expected_albedo(result + i);
    }
    void sample(int n, const int* at, const Vec3* u, SampledDirection* result) const override
    {
        for (int j = 0; j < n; ++j) _of[at[j]]->sample(1, &first, u + at[j], result + at[j]);
    }
    void evaluate(int n, const int* at, const Vec3* L, const Vec3* u, Color3* value,
                  float* pdf) const override
    {
        for (int j = 0; j < n; ++j)
            _of[at[j]]->evaluate(1, &first, L + j, u + j, value + j, pdf + j);
    }
    bool reflects(int at, const Vec3& L) const override { return _of[at]->reflects(0, L); }
    void look_back(int n, const int* at, const Vec3* L, Color3* albedo, float* pdf) const override
    {
        for (int j = 0; j < n; ++j)
            _of[at[j]]->look_back(1, &first, L + j, albedo ? albedo + j : nullptr, pdf + j);
    }

private:
    static constexpr int first = 0;

    PerPointBatch(int points, const LobeBatch* const* of) : _points(points), _of(of) {}

    // What holds for the batch: of what has density somewhere and none elsewhere, both may come.
    void take(const LobeBatch& one, bool is_first)
    {
        if (is_first)
        {
            slot = one.slot;
            discrete = one.discrete;
            mixed = one.mixed;
            transmissive = one.transmissive;
            two_media = one.two_media;
            estimates = one.estimates;
            straight = one.straight;
            ior = one.ior;
            random_numbers = one.random_numbers;
            return;
        }
        mixed = mixed || one.mixed || discrete != one.discrete;
        discrete = discrete && one.discrete;
        transmissive = transmissive || one.transmissive;
        estimates = estimates || one.estimates;
        if (ior == 1) ior = one.ior;
        if (one.random_numbers > random_numbers) random_numbers = one.random_numbers;
    }

    int _points;
    const LobeBatch* const* _of;
};

/// The presence of each point.
class PerPointPresence final : public Opacity
{
public:
    /// presence_at(i) in [0, 1]; null where the arena is spent.
    template <class At>
    static PerPointPresence* create(const ShadingContext* ctx, const At& presence_at)
    {
        auto* memory = ctx->alloc<PerPointPresence>();
        auto* values = ctx->alloc<float>(static_cast<std::size_t>(ctx->numPts));
        if (!memory || !values) return nullptr;
        for (int i = 0; i < ctx->numPts; ++i) values[i] = presence_at(i);
        return new (memory) PerPointPresence(ctx->numPts, values);
    }

    bool presence(float* result) const override
    {
        for (int i = 0; i < _points; ++i) result[i] = _presence[i];
        return true;
    }
    bool opacity(Color3*) const override { return false; }

private:
    PerPointPresence(int points, const float* presence) : _points(points), _presence(presence) {}

    int _points;
    const float* _presence;
};

}  // namespace renderman
REGAIN_NAMESPACE_END
