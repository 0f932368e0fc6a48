// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A closure with its parameters still open, and what is promised of it. The kit makes closures of
/// it all over the range of its parameters and holds them to the promises.

#pragma once

#include <regain/conformance/tested_closure.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// What reflects at a facet. White is F = 1 in every channel: nothing is absorbed.
enum class Reflectance { white, schlick, conductor };

/// Everything that a closure may be made of; each subject says which of these it reads. A hostile
/// value of any of them has to give a closure, too.
struct Parameters
{
    double alpha_x = 0.25, alpha_y = 0.25;  ///< microfacet widths in [0, 1]
    double gamma = 2;                       ///< tail parameter
    double eta = 1.5;                       ///< index on the -z side over the index on the +z side
    Reflectance reflectance = Reflectance::white;
    Color F0{1.0}, F82{1.0};  ///< schlick: colour at normal incidence; tint at cosine 1/7
    Color n{1.0}, k{0.0};     ///< conductor: complex index per channel
    bool in_double = true;    ///< compute in double, or else in float
};

/// Which parameters a subject reads.
struct Reads
{
    bool alpha = false;       ///< alpha_x, alpha_y
    bool two_alphas = false;  ///< they may differ
    bool gamma = false;
    double lowest_gamma = 0, highest_gamma = 0;
    bool eta = false;
    bool one_medium = false;  ///< on both sides, as of a sheet: eta is of what lies between
    bool schlick = false, conductor = false;
    bool single = false, twice = false;  ///< precisions it computes in; at least one
};

/// How compensation acts on the lobe that it compensates: a gain is one factor for all wi, a pair's
/// gain another for each.
enum class Form { none, gain, added_lobe, replaced, pair_gain };

/// What holds in numbers, beyond the Traits, of one closure along one direction. Each may be
/// nothing, where nothing is promised. Defaults are those of a single-scattering lobe.
struct Promises
{
    /// The albedo is at most 1 + this: for anything that emits no light.
    std::optional<double> surplus = 2e-4;
    /// Where traits say energy_preserving, a white closure's albedo is within this of 1.
    std::optional<double> furnace = 2e-3;
    /// albedo() is within this of what the closure reflects and transmits.
    std::optional<double> albedo = 2e-3;
    /// The albedo is within this of the reference subject's.
    std::optional<double> tint;
    /// No sample weighs more.
    std::optional<double> weight = 1;
    /// The integral of the pdf, and the chances of nothing and of delta lobes, are 1 within this.
    double pdf = 5e-4;
    /// In float, eval is within this of double, relative, but for one in a thousand; half of all
    /// are within a 200th of it.
    double single = 1e-3;
    /// albedo() is a mean of samples, and chance moves it by this, in float and in double.
    double albedo_noise = 0;
};

/// A distribution of microfacet normals, alone; see regain/closures/distribution.h for what each of
/// these is. Any w, wo, wi is unit; wo.z of either sign for visible normals.
class TestedNormals
{
public:
    virtual ~TestedNormals() = default;
    virtual double D(const Direction& m) const = 0;
    virtual double projected_area(const Direction& w) const = 0;
    virtual double G1(const Direction& w) const = 0;
    virtual double G2(const Direction& wo, const Direction& wi) const = 0;
    virtual Direction sample_visible(const Direction& wo, const Direction& u) const = 0;
};

/// A look-up that was compared with an exact value.
struct TableError
{
    std::string table, where;  ///< the table; the place of the largest error in it
    double measured = 0, bound = 0;
};

class Subject
{
public:
    virtual ~Subject() = default;

    /// Unique in a run; letters, digits, '-', '_' and '.'.
    virtual std::string name() const = 0;
    virtual Reads reads() const = 0;

    /// Never null: what cannot be made is sanitised.
    virtual std::unique_ptr<TestedClosure> make(const Parameters&) const = 0;
    virtual Promises promises(const Parameters&, const Direction& /*wo*/) const { return {}; }

    /// The lobe that this one compensates, or null; and how.
    virtual const Subject* bare() const { return nullptr; }
    virtual Form form() const { return Form::none; }
    /// What tinted albedos are compared with, or null: all bounces, simulated.
    virtual const Subject* reference() const { return nullptr; }
    /// Its microfacets, in double, or null.
    virtual std::unique_ptr<TestedNormals> normals(const Parameters&) const { return nullptr; }
    /// The tables that it looks up, each compared with exact values at so many places.
    virtual std::vector<TableError> table_errors(int /*places*/) const { return {}; }
    /// What counts as one closure where work is spread: of the hostile inputs of a thorough run,
    /// subjects of one family take their shares.
    virtual std::string family() const { return name(); }
};

}  // namespace conformance
REGAIN_NAMESPACE_END
