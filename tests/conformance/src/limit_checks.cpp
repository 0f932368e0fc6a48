// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// C11: where a lobe becomes a mirror, or an interface vanishes, nothing jumps.

#include "check.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

std::string needs_alpha(const Subject& subject, const Traits&)
{
    return subject.reads().alpha ? "" : "it has no width";
}

struct Energies
{
    RunningMean reflect, transmit;
    double delta = 0;  // share of samples
};

class Limits
{
public:
    explicit Limits(Bench& bench) : _bench(bench), _reads(bench.subject().reads())
    {
        _worst.bound = 1e-3;
    }

    // Just above the width at which the lobe becomes a mirror and at it.
    void widths()
    {
        for (const double gamma : gammas())
            for (const bool twice : {true, false})
            {
                if (!(twice ? _reads.twice : _reads.single)) continue;
                Parameters p;
                p.gamma = gamma;
                p.in_double = twice;
                const double edge = mirror_edge(p);
                if (edge == 0) continue;
                Parameters below = p, above = p;
                below.alpha_x = below.alpha_y = edge;
                above.alpha_x = above.alpha_y = edge * 1.0001;
                for (const double mu : {1.0, 0.7, 0.3, 0.02})
                    compare(below, above, mu, "at the width " + shown(edge));
            }
    }

    // At eta = 1 there is no interface, and all light goes straight on: but what a lobe is added
    // for. On the way there transmission becomes a delta lobe.
    void indices()
    {
        if (!_reads.eta || !_bench.traits().transmissive) return;
        for (const double alpha : {0.0, 0.25, 1.0})
        {
            Parameters p;
            p.eta = 1;
            p.alpha_x = p.alpha_y = alpha;
            p.in_double = _reads.twice;
            if (_bench.subject().form() != Form::added_lobe) straight_on(p);
            const double edge = delta_edge(p);
            if (edge == 0) continue;
            for (const double side : {1.0, -1.0})
            {
                Parameters below = p, above = p;
                below.eta = 1 + side * edge;
                above.eta = 1 + side * edge * 1.0001;
                for (const double mu : {0.9, 0.3})
                    compare(below, above, mu, "at eta " + shown(below.eta));
            }
        }
    }

    // One axis may be a mirror's and the other as rough as can be.
    void one_axis()
    {
        if (!_reads.two_alphas) return;
        for (const double alpha : {0.0, 1e-30, 1e-7, 1e-4})
        {
            Parameters p;
            p.alpha_x = alpha;
            p.alpha_y = 1;
            for (const double mu : {0.9, 0.3, 0.02})
            {
                const Energies e = energies(p, direction_at(mu, 0.7));
                const double all = e.reflect.mean() + e.transmit.mean();
                if (!std::isfinite(all) || all < 0 || all > 2)
                    complain("alpha " + shown(alpha) + " and 1, mu " + shown(mu) +
                             ": the albedo is " + shown(all));
            }
        }
    }

    Outcome outcome() const { return _worst; }

private:
    std::vector<double> gammas() const
    {
        if (!_reads.gamma) return {2};
        return {std::clamp(1.55, _reads.lowest_gamma, _reads.highest_gamma),
                std::clamp(3.0, _reads.lowest_gamma, _reads.highest_gamma)};
    }

    // The largest x up to `most` at which something holds that holds at 0 and no longer at `most`;
    // or 0, where it is not so.
    template <class Holds>
    static double edge(double most, const Holds& holds)
    {
        double lo = -40, hi = std::log(most);
        if (!holds(0) || holds(most) || !holds(std::exp(lo))) return 0;
        for (int i = 0; i < 60; ++i)
        {
            const double middle = 0.5 * (lo + hi);
            (holds(std::exp(middle)) ? lo : hi) = middle;
        }
        return std::exp(lo);
    }
    Sample<double> sampled(const Parameters& p, double choice) const
    {
        const auto closure = _bench.subject().make(p);
        closure->prepare(direction_at(0.7));
        return closure->sample(Direction(0.4, 0.6, choice));
    }

    // The largest alpha that is a mirror.
    double mirror_edge(Parameters p) const
    {
        return edge(0.1, [&](double alpha) {
            p.alpha_x = p.alpha_y = alpha;
            const Sample<double> s = sampled(p, 0.01);
            return s.valid && s.delta && !s.transmitted;
        });
    }
    // The largest eta - 1 at which transmission is a delta lobe.
    double delta_edge(Parameters p) const
    {
        return edge(0.5, [&](double off) {
            p.eta = 1 + off;
            const Sample<double> s = sampled(p, 0.99);
            return s.valid && s.delta && s.transmitted;
        });
    }

    Energies energies(const Parameters& p, const Direction& wo)
    {
        constexpr std::size_t groups = 16, each = 512;
        const auto closure = _bench.subject().make(p);
        closure->prepare(wo);
        Random random = _bench.random("C11");
        Energies e;
        for (std::size_t g = 0; g < groups; ++g)
        {
            EvenPoints even(random.cube());
            double reflect = 0, transmit = 0;
            for (std::size_t i = 0; i < each; ++i)
            {
                const Sample<double> s = closure->sample(even.next());
                (s.transmitted ? transmit : reflect) += s.weight.y / each;
                e.delta += s.delta / static_cast<double>(groups * each);
            }
            e.reflect.add(reflect);
            e.transmit.add(transmit);
        }
        return e;
    }

    void compare(const Parameters& a, const Parameters& b, double mu, const std::string& where)
    {
        const Energies x = energies(a, direction_at(mu)), y = energies(b, direction_at(mu));
        const auto each = [&](const RunningMean& p, const RunningMean& q, const char* what) {
            const double off = std::abs(p.mean() - q.mean());
            const double error = std::hypot(p.standard_error(), q.standard_error());
            double chance = 1;
            if (!(off <= _worst.bound))
                chance = error > 0 ? student_tail((off - _worst.bound) / error, 15) : 0;
            if (off <= _worst.measured && chance >= _worst.probability) return;
            _worst.measured = std::max(off, _worst.measured);
            _worst.probability = std::min(_worst.probability, chance);
            _worst.detail = where + ", mu " + shown(mu) + ", " + what + ": " + shown(p.mean()) +
                            " on one side, " + shown(q.mean()) + " on the other";
        };
        each(x.reflect, y.reflect, "reflected");
        each(x.transmit, y.transmit, "transmitted");
    }

    void straight_on(const Parameters& p)
    {
        const auto closure = _bench.subject().make(p);
        const bool twice = _reads.twice;
        for (const double mu : {0.9, 0.3, 0.02, -0.5})
        {
            const Direction wo = direction_at(mu, 0.7);
            closure->prepare(wo);
            Random random = _bench.random("C11 straight");
            for (int i = 0; i < 64; ++i)
            {
                const Sample<double> s = closure->sample(random.cube());
                if (!s.valid) continue;
                const double off = (s.wi + wo).length();
                if (!s.transmitted || off > (twice ? 1e-9 : 1e-5))
                    complain("eta 1, wo " + shown(wo) + " is sent to " + shown(s.wi));
            }
        }
    }

    void complain(const std::string& what)
    {
        _worst.probability = 0;
        _worst.measured = 1;
        _worst.detail = what;
    }

    Bench& _bench;
    Reads _reads;
    Outcome _worst;
};

std::optional<Outcome> nothing_jumps(Bench& bench)
{
    Limits limits(bench);
    limits.widths();
    limits.indices();
    limits.one_axis();
    return limits.outcome();
}

}  // namespace

std::vector<Check> limit_checks()
{
    return {{"C11", "nothing jumps where a lobe becomes a mirror or an interface vanishes",
             Scope::subject, true, needs_alpha, nothing_jumps}};
}

}  // namespace conformance
REGAIN_NAMESPACE_END
