// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Random walks by vectors of floats, lanes refilled. A walk takes as many bounces as it takes, and
/// a vector of them is done when its longest one is; until then the lanes of the others do nothing.
/// So the walks that have not left after a bounce are kept as numbers, and go on side by side,
/// whichever point they are from: every vector but the last is full, whatever the bounce.
///
/// What becomes of a walk does not depend on which others there are.

#pragma once

#include <regain/closures/walk.h>
#include <regain/closures/xsimd.h>

REGAIN_NAMESPACE_BEGIN
namespace detail {

template <class Prepared, class = void>
struct IsWalk : std::false_type
{};
template <class Prepared>
struct IsWalk<Prepared, std::void_t<typename Prepared::Flight>> : std::true_type
{};

/// Up to `room` walks of one closure, each known by a number below that.
template <class Closure>
class WalkPool
{
public:
    using Real = typename Closure::Real;
    using Mask = MaskOf<Real>;
    using Flight = typename Closure::Prepared::Flight;
    static constexpr int lanes = int(Real::size), room = 16 * lanes;

    /// Walks that have taken off: lane l is walk[l], or none (-1). Those not in `active` have left.
    void add(const Flight& flight, const Mask& active, const int (&walk)[lanes])
    {
        Numbers n;
        unload(flight, n);
        const std::uint32_t going = bits(active);
        for (int l = 0; l < lanes; ++l)
        {
            if (walk[l] < 0) continue;
            if (going >> l & 1)
            {
                _walk[_size] = walk[l];
                copy(n, l, _under_way, _size++);
            }
            else
                land(n, l, walk[l], false);
        }
        if (going) _count = Flight(flight).stream.count();
    }

    /// All the way.
    void fly(const Closure& closure)
    {
        for (int bounce = 1; bounce < walk_limit && _size > 0; ++bounce)
        {
            int kept = 0;
            std::uint32_t count = 0;
            for (int first = 0; first < _size; first += lanes)
            {
                // Lanes that are left over do what the first one does.
                const int last = _size - first < lanes ? _size - first : lanes;
                for (int l = last; l < lanes; ++l) copy(_under_way, first, _under_way, first + l);
                Flight f;
                load(_under_way, first, f);
                f.stream.count() = _count;
                Mask active = f.bounces > Real(0);
                Closure::Prepared::bounce(closure, f, active);
                count = f.stream.count();

                Numbers n;
                unload(f, n);
                const std::uint32_t going = bits(active);
                for (int l = 0; l < last; ++l)
                {
                    const int walk = _walk[first + l];
                    if (going >> l & 1)
                    {
                        _walk[kept] = walk;
                        copy(n, l, _under_way, kept++);
                    }
                    else
                        land(n, l, walk, false);
                }
            }
            _size = kept;
            _count = count;
        }
        for (int i = 0; i < _size; ++i) land(_under_way, i, _walk[i], true);
        _size = 0;
    }

    /// Where walks have got to; in lanes without one, anywhere. `given_up`: it has not left.
    Flight landed(const int (&walk)[lanes], Mask& given_up) const
    {
        Numbers n;
        alignas(64) float up[lanes];
        for (int l = 0; l < lanes; ++l)
        {
            const int w = walk[l] < 0 ? 0 : walk[l];
            copy(_landed, w, n, l);
            up[l] = _given_up[w] ? 1.0f : 0.0f;
        }
        Flight f;
        load(n, 0, f);
        given_up = Real::load_aligned(up) > Real(0);
        return f;
    }

private:
    // Of a flight, and the key of its stream.
    static constexpr int most_numbers = 16;
    struct Numbers
    {
        alignas(64) float of[most_numbers][lanes];
    };
    struct ManyNumbers
    {
        alignas(64) float of[most_numbers][room + lanes];
    };

    static void unload(Flight flight, Numbers& n)
    {
        int k = 0;
        flight.each([&](const Real& x) { x.store_aligned(n.of[k++]); },
                    [&](const Mask& m) { select(m, Real(1), Real(0)).store_aligned(n.of[k++]); });
        xsimd::bitwise_cast<Real>(flight.stream.key()).store_aligned(n.of[k]);
    }
    template <class From>
    static void load(const From& n, int first, Flight& flight)
    {
        int k = 0;
        const auto next = [&] { return Real::load_aligned(n.of[k++] + first); };
        flight.each([&](Real& x) { x = next(); }, [&](Mask& m) { m = next() > Real(0); });
        flight.stream.key() = xsimd::bitwise_cast<BitsOf<Real>>(next());
    }
    template <class From, class To>
    static void copy(const From& from, int i, To& to, int j)
    {
        for (int k = 0; k < most_numbers; ++k) to.of[k][j] = from.of[k][i];
    }
    template <class From>
    void land(const From& from, int i, int walk, bool given_up)
    {
        copy(from, i, _landed, walk);
        _given_up[walk] = given_up;
    }
    static std::uint32_t bits(const Mask& m)
    {
        alignas(64) float lane[lanes];
        select(m, Real(1), Real(0)).store_aligned(lane);
        std::uint32_t all = 0;
        for (int l = 0; l < lanes; ++l) all |= std::uint32_t(lane[l] > 0) << l;
        return all;
    }

    ManyNumbers _under_way, _landed;
    int _walk[room + lanes];
    bool _given_up[room];
    int _size = 0;
    std::uint32_t _count = 0;
};

}  // namespace detail
REGAIN_NAMESPACE_END
