// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// One check, what it works with, and what it answers.

#pragma once

#include "random.h"
#include "remembered.h"
#include "settings.h"
#include "survey.h"

#include <atomic>
#include <optional>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// What a check has at hand: one subject, one setting. What is expensive is made when it is first
/// asked for, and then shared by all checks of the setting.
class Bench
{
public:
    /// second_look: other random numbers, and more of them.
    /// share: the subject's part in the hostile inputs of its family.
    Bench(const Subject& subject, const Setting& setting, double share, const Options& options,
          bool second_look, const std::atomic<bool>& stop, Memory& memory)
        : _subject(subject),
          _setting(setting),
          _share(share),
          _options(options),
          _second_look(second_look),
          _stop(stop),
          _memory(memory)
    {}

    const Subject& subject() const { return _subject; }
    const Setting& setting() const { return _setting; }
    Tier tier() const { return _options.tier; }
    Effort effort() const;
    /// How many hostile inputs the subject is given.
    std::size_t hostile_inputs() const;

    /// The closure of the setting, prepared for its direction.
    TestedClosure& closure();
    Traits traits() { return closure().traits(); }
    /// Of a gain it is that of the lobe which it scales, scaled: C16 finds that nothing else is
    /// different.
    const Survey& survey();
    Promises promises() const { return _subject.promises(_setting.parameters, _setting.wo); }
    const Parameters& parameters() const { return _setting.parameters; }

    /// Random numbers of one check alone, the same in every run.
    Random random(std::string_view check) const { return random_of(name_of(_subject, check)); }

    /// What the reference's albedo is measured to be: by simulate(closure, random numbers), for all
    /// that have this reference once.
    template <class Simulate>
    MeanColor reference_albedo(const Simulate& simulate) const
    {
        const Subject& reference = *_subject.reference();
        const std::string name = name_of(reference, "reference");
        return _memory.reference_albedos.of(name, [&] {
            const auto closure = reference.make(_setting.parameters);
            closure->prepare(_setting.wo);
            return simulate(*closure, random_of(name));
        });
    }

    /// Someone asked to stop: a long check returns soon, whatever it then says.
    bool stopped() const { return _stop; }

private:
    Survey new_survey(const Subject& subject, TestedClosure& closure) const;
    Survey survey_of_gain();
    std::string name_of(const Subject& subject, std::string_view check) const;
    Random random_of(const std::string& name) const { return Random(hash_of(name, _options.salt)); }

    const Subject& _subject;
    const Setting& _setting;
    double _share;
    const Options& _options;
    bool _second_look;
    const std::atomic<bool>& _stop;
    Memory& _memory;
    std::unique_ptr<TestedClosure> _closure;
    std::optional<Survey> _survey;
};

struct Outcome
{
    double measured = 0, bound = 0;
    /// Of as much, if nothing is wrong. A check without chance says 0 or 1.
    double probability = 1;
    std::string detail, note;
    std::shared_ptr<const Histogram> histogram;

    static Outcome within(double measured, double bound, std::string detail = {});
};

/// How often a check is run.
enum class Scope { subject, parameters, direction };

struct Check
{
    const char* id;
    const char* title;
    Scope scope;
    bool by_chance;
    /// Why the check says nothing about this subject, or an empty string. Asked once.
    std::string (*why_not)(const Subject&, const Traits&);
    /// No outcome: nothing can be said of this setting.
    std::optional<Outcome> (*run)(Bench&);
};

const std::vector<Check>& checks();

// The checks, by what they are about; one file each.
std::vector<Check> trait_checks();      // C0
std::vector<Check> normals_checks();    // C1
std::vector<Check> totality_checks();   // C2
std::vector<Check> pdf_checks();        // C3, C4, C5, C13
std::vector<Check> energy_checks();     // C6, C7, C8, C17
std::vector<Check> reference_checks();  // C9, C14, C15
std::vector<Check> symmetry_checks();   // C10, C12
std::vector<Check> limit_checks();      // C11
std::vector<Check> hook_checks();       // C16

/// For details: every digit that counts.
std::string shown(double x);
std::string shown(const Direction& w);
std::string shown(const Color& c);

double largest(const Color& c);

}  // namespace conformance
REGAIN_NAMESPACE_END
