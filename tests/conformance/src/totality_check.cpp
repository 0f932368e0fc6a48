// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// C2: whatever goes in, what comes out is finite, not negative, and of unit length where it is a
// direction; and on the way nothing invalid is computed and nothing is divided by zero.

#include "check.h"
#include "hostile.h"

#include <cfenv>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

constexpr int raised = FE_INVALID | FE_DIVBYZERO;

// Closures are made for a few directions each, and these for a few others: making and preparing one
// costs more than asking it.
constexpr std::size_t directions_each = 8, looks_each = 4;
// Where albedo() is a mean of samples, it takes thousands of them.
constexpr std::size_t albedos_each = 512, means_each = 8192, means_each_of_many = 65536;

bool sane(double x) { return std::isfinite(x) && x >= 0; }
bool sane(const Color& c) { return sane(c.x) && sane(c.y) && sane(c.z); }

std::string described(const Parameters& p)
{
    static const char* const names[] = {"white", "schlick", "conductor"};
    return "alpha " + shown(p.alpha_x) + " " + shown(p.alpha_y) + ", gamma " + shown(p.gamma) +
           ", eta " + shown(p.eta) + ", " + names[static_cast<int>(p.reflectance)] + " F0 " +
           shown(p.F0) + " F82 " + shown(p.F82) + " n " + shown(p.n) + " k " + shown(p.k) +
           (p.in_double ? ", double" : ", float");
}

// Hostile numbers; what is wrong with what comes back, or an empty string.
class Attempt
{
public:
    Attempt(TestedClosure& closure, Hostile& hostile, double unit)
        : _closure(closure), _hostile(hostile), _unit(unit), _wo(hostile.direction())
    {
        std::feclearexcept(FE_ALL_EXCEPT);
        closure.prepare(_wo);
        note_traps("preparing it");
    }

    // Every look is at another wi and other random numbers.
    void look()
    {
        _wi = _hostile.direction();
        _u = _hostile.random_numbers();
        _v = _hostile.random_numbers();
        std::feclearexcept(FE_ALL_EXCEPT);
        const Color f = _closure.eval(_wi, _v);
        const double pdf = _closure.pdf(_wi);
        const Sample<double> s = _closure.sample(_u);
        note_traps("eval, pdf or sample");
        if (!sane(f)) complain("eval is " + shown(f));
        if (!sane(pdf)) complain("pdf is " + shown(pdf));
        if (!sane(s.weight)) complain("the weight of a sample is " + shown(s.weight));
        if (!sane(s.pdf)) complain("the pdf of a sample is " + shown(s.pdf));
        if (!(std::abs(s.wi.length() - 1) <= _unit))
            complain("the sampled direction is " + shown(s.wi));
        if (!s.valid && (s.pdf != 0 || s.weight != Color(0.0) || s.delta || s.transmitted))
            complain("nothing was sampled, with weight " + shown(s.weight) + " and pdf " +
                     shown(s.pdf));
        if (s.valid && !(s.pdf > 0)) complain("a sample has the pdf " + shown(s.pdf));
        if (s.valid && s.delta && s.pdf > 1 + 1e-6)
            complain("a delta lobe is chosen with probability " + shown(s.pdf));
    }
    void look_at_albedo()
    {
        std::feclearexcept(FE_ALL_EXCEPT);
        const Albedo<double> albedo = _closure.albedo();
        note_traps("albedo");
        if (!sane(albedo.reflect) || !sane(albedo.transmit))
            complain("albedo is " + shown(albedo.reflect) + " and " + shown(albedo.transmit));
    }

    const std::string& what() const { return _what; }

private:
    void note_traps(const char* where)
    {
        const int flags = std::fetestexcept(raised);
        if (!flags) return;
        if (flags & FE_INVALID) complain(std::string("an invalid operation in ") + where);
        if (flags & FE_DIVBYZERO) complain(std::string("a division by zero in ") + where);
    }
    // The first is told.
    void complain(const std::string& text)
    {
        if (!_what.empty()) return;
        _what = text + "; wo " + shown(_wo) + ", wi " + shown(_wi) + ", u " + shown(_u) +
                ", u of eval " + shown(_v);
    }

    TestedClosure& _closure;
    Hostile& _hostile;
    double _unit;
    Direction _wo, _wi{0.0}, _u{0.0}, _v{0.0};
    std::string _what;
};

std::string always(const Subject&, const Traits&) { return {}; }

std::optional<Outcome> survives_anything(Bench& bench)
{
    const Reads reads = bench.subject().reads();
    Hostile hostile(bench.random("C2"), false);
    const std::size_t n = bench.hostile_inputs();
    const bool is_mean = bench.traits().stochastic_eval || bench.promises().albedo_noise > 0;
    const std::size_t every = !is_mean                       ? albedos_each
                              : bench.tier() == Tier::commit ? means_each
                                                             : means_each_of_many;
    std::size_t faults = 0, asked = 0;
    Outcome o;
    while (asked < n && !bench.stopped())
    {
        const Parameters p = hostile.parameters(reads);
        std::feclearexcept(FE_ALL_EXCEPT);
        const auto closure = bench.subject().make(p);
        if (std::fetestexcept(raised) && faults++ == 0)
            o.detail = "making the closure computes something invalid; " + described(p);
        // A float's length is good to a few of its ulps.
        const double unit = p.in_double ? 1e-12 : 1e-6;
        for (std::size_t i = 0; i < directions_each; ++i)
        {
            Attempt attempt(*closure, hostile, unit);
            if (asked % every == 0) attempt.look_at_albedo();
            for (std::size_t k = 0; k < looks_each; ++k, ++asked) attempt.look();
            if (!attempt.what().empty() && faults++ == 0)
                o.detail = attempt.what() + "; " + described(p);
        }
    }
    o.measured = static_cast<double>(faults);
    o.probability = faults ? 0 : 1;
    o.note = std::to_string(asked) + " hostile inputs";
    if (faults) o.detail = std::to_string(faults) + " faults, the first: " + o.detail;
    return o;
}

}  // namespace

std::vector<Check> totality_checks()
{
    return {{"C2", "hostile inputs give finite, non-negative, unit answers, and no traps",
             Scope::subject, false, always, survives_anything}};
}

}  // namespace conformance
REGAIN_NAMESPACE_END
