// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A minimal host of each kind, for tests of the adapters.

#pragma once

#include "closures.h"

#include <regain/clarisse/closure_lobe.h>
#include <regain/renderman/closure_bxdf.h>
#include <regain/shaders/material.h>

#include <vector>

namespace regain::tests {

/// The batched side: a context over arrays, an arena that counts, a generator.
class GridHost
{
public:
    explicit GridHost(int points, std::size_t arena_bytes = std::size_t(1) << 22)
        : V(points),
          N(points, renderman::Vec3(0, 0, 1)),
          Ng(N),
          T(points, renderman::Vec3(1, 0, 0)),
          _arena(arena_bytes),
          _storage(std::size_t(renderman::kMaxActive) * points),
          rng(points)
    {
        ctx.numPts = points;
        ctx.Vn = V.data();
        ctx.Nn = N.data();
        ctx.Ngn = Ng.data();
        ctx.Tn = T.data();
        ctx.arena = this;
        ctx.allocFn = [](void* self, std::size_t bytes, std::size_t align) {
            return static_cast<GridHost*>(self)->alloc(bytes, align);
        };
    }

    renderman::LobeWeights weights() { return {_storage.data(), ctx.numPts}; }
    void reset() { _used = 0; }

    struct Rng final : renderman::Rng
    {
        explicit Rng(int n) : points(n) {}
        void draw1D(float* xi) override
        {
            for (int i = 0; i < points; ++i) xi[i] = random.unit<float>();
        }
        void draw2D(renderman::Vec2* xi) override
        {
            for (int i = 0; i < points; ++i) xi[i] = random.square<float>();
        }
        void newDomain(std::uint32_t) override {}
        int points;
        Random random{23};
    };

    std::vector<renderman::Vec3> V, N, Ng, T;
    renderman::ShadingContext ctx;

private:
    void* alloc(std::size_t bytes, std::size_t align)
    {
        const std::size_t at = (_used + align - 1) / align * align;
        if (at + bytes > _arena.size()) return nullptr;
        _used = at + bytes;
        return _arena.data() + at;
    }
    alignas(64) std::vector<char> _arena;
    std::size_t _used = 0;
    std::vector<renderman::Color3> _storage;

public:
    Rng rng;
};

inline shaders::SchlickMetal gold_material(float alpha, Method method = Method::turquin)
{
    return {{0.94f, 0.77f, 0.37f}, {0.98f, 0.95f, 0.75f}, alpha, alpha, method};
}
inline shaders::SchlickMetal white_material(float alpha, Method method = Method::turquin)
{
    return {Imath::C3f(1.0f), Imath::C3f(1.0f), alpha, alpha, method};
}

}  // namespace regain::tests
