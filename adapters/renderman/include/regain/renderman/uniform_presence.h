// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The presence of a material, the same at all points. Light that is let by is white: opacity is 1,
/// and what a transparent closure lets straight on is not in here.

#pragma once

#include <regain/renderman/host.h>

#include <new>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

class UniformPresence final : public Opacity
{
public:
    /// Null where the presence is 1, or the arena is spent.
    static UniformPresence* create(const ShadingContext* ctx, float presence)
    {
        if (!(presence < 1)) return nullptr;
        auto* memory = ctx->alloc<UniformPresence>();
        return memory ? new (memory) UniformPresence(ctx->numPts, presence) : nullptr;
    }

    bool presence(float* result) const override
    {
        for (int i = 0; i < _points; ++i) result[i] = _presence;
        return true;
    }
    bool opacity(Color3*) const override { return false; }

private:
    UniformPresence(int points, float presence) : _points(points), _presence(presence) {}

    int _points;
    float _presence;
};

}  // namespace renderman
REGAIN_NAMESPACE_END
