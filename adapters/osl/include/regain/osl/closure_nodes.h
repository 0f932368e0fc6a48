// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The tree of closures that a shader leaves in Ci, in the shape and layout of OSL's oslclosure.h,
/// so that a host that has OSL hands its own nodes over as they are: registration.h checks sizes
/// and offsets against OSL's where it is found.
///
/// Plain data: a component is followed by its parameters (closure_params.h) in memory. Its weight
/// `w` and those of the ClosureMul above it both count, for OSL fuses `color * closure` into
/// either. A null node is black.

#pragma once

#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>

#include <regain/closures/version.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>

REGAIN_NAMESPACE_BEGIN
namespace osl {

struct ClosureColor
{
    /// What is not negative identifies a component.
    enum : int { mul = -1, add = -2 };
    int id;
};

/// Parameters may hold pointers and vectors of four floats, which follow on 16 bytes.
struct alignas(16) ClosureComponent : ClosureColor
{
    Imath::V3f w;

    const void* data() const { return this + 1; }
    template <class Params>
    const Params& as() const
    {
        return *static_cast<const Params*>(data());
    }
};

struct ClosureMul : ClosureColor
{
    Imath::C3f weight;
    const ClosureColor* closure;
};

struct ClosureAdd : ClosureColor
{
    const ClosureColor *closureA, *closureB;
};

static_assert(sizeof(ClosureComponent) == 16, "parameters begin where OSL puts them");

/// Builds trees by hand, in memory that is the caller's: what shader execution does in a host
/// without OSL. Like OSL it makes no node for a weight of 0 or 1, nor for a sum with black.
class NodePool
{
public:
    NodePool(void* memory, std::size_t bytes)
        : _begin(static_cast<char*>(memory)), _at(_begin), _end(_begin + bytes)
    {}

    void reset()
    {
        _at = _begin;
        _full = false;
    }
    /// Something did not fit, and is missing.
    bool full() const { return _full; }

    template <class Params>
    const ClosureColor* component(int id, const Params& params,
                                  const Imath::C3f& w = Imath::C3f(1.0f))
    {
        static_assert(std::is_trivially_destructible_v<Params>, "nodes are plain data");
        static_assert(alignof(Params) <= alignof(ClosureComponent), "");
        void* at = allocate(sizeof(ClosureComponent) + sizeof(Params), alignof(ClosureComponent));
        if (!at) return nullptr;
        auto* c = new (at) ClosureComponent;
        c->id = id;
        c->w = Imath::V3f(w.x, w.y, w.z);
        new (c + 1) Params(params);
        return c;
    }
    const ClosureColor* multiply(const Imath::C3f& weight, const ClosureColor* closure)
    {
        if (!closure || weight == Imath::C3f(0.0f)) return nullptr;
        if (weight == Imath::C3f(1.0f)) return closure;
        void* at = allocate(sizeof(ClosureMul), alignof(ClosureMul));
        if (!at) return nullptr;
        auto* m = new (at) ClosureMul;
        m->id = ClosureColor::mul;
        m->weight = weight;
        m->closure = closure;
        return m;
    }
    const ClosureColor* add(const ClosureColor* a, const ClosureColor* b)
    {
        if (!a || !b) return a ? a : b;
        void* at = allocate(sizeof(ClosureAdd), alignof(ClosureAdd));
        if (!at) return nullptr;
        auto* sum = new (at) ClosureAdd;
        sum->id = ClosureColor::add;
        sum->closureA = a;
        sum->closureB = b;
        return sum;
    }

private:
    void* allocate(std::size_t bytes, std::size_t alignment)
    {
        const auto misaligned = reinterpret_cast<std::uintptr_t>(_at) % alignment;
        const std::size_t pad = misaligned ? alignment - misaligned : 0;
        if (static_cast<std::size_t>(_end - _at) < pad + bytes)
        {
            _full = true;
            return nullptr;
        }
        char* at = _at + pad;
        _at = at + bytes;
        return at;
    }

    char *_begin, *_at, *_end;
    bool _full = false;
};

}  // namespace osl
REGAIN_NAMESPACE_END
