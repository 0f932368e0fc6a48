// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A closure over several places where its material is planned: what it calls for somewhere, and
/// by each method the worst error and the mean price.

#pragma once

#include "method_prediction.h"
#include "plan_words.h"
#include "planned_points.h"

#include <optional>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {

/// What is predicted of a closure at one place, by the offers of its range.
using LobePredictions = std::vector<std::optional<Prediction>>;

class LobeRange
{
public:
    /// Offers all methods that there is a prediction for.
    LobeRange(const MethodCosts&, const PlacedLobe& first);

    const PlacedLobe& first() const { return _first; }
    const MicrofacetMaterial* facets() const
    {
        return std::get_if<MicrofacetMaterial>(&_first.material);
    }

    /// Empty where the closure scatters nothing.
    LobePredictions predict(const MethodCosts&, const PlacedLobe&) const;
    /// Takes a place in. Predictions may be another range's of the same closure.
    void look_at(const PlacedLobe&, const LobePredictions&);
    /// After the last place: methods that some place has no prediction for are out.
    void finish(double tolerance);
    /// Beside other closures, a host asks for the albedo; some know theirs by an integral alone.
    void drop_unknown_albedos(double tolerance);

    bool is_there() const { return _places > 0; }
    const CalledFor& called_for() const { return _called_for; }
    const std::vector<NamedOffer>& offers() const { return _offers; }
    /// Of an offer.
    const Prediction& mean(std::size_t i) const { return _sums[i]; }
    /// That of a method; null where it is not offered.
    const Prediction* mean_of(const Compensation&) const;
    /// The worst error of single scattering.
    const std::optional<ColorD>& without() const { return _without; }

private:
    template <class Keep>
    void keep_if(const Keep& keep);

    PlacedLobe _first;
    int _places = 0;
    CalledFor _called_for;
    std::vector<NamedOffer> _offers;
    std::vector<Prediction> _sums;  // of times; means, once finished
    std::vector<bool> _is_known;    // everywhere
    std::optional<ColorD> _without;
};

/// Of each range the offer that is taken; nothing where there is no choice.
struct Choice
{
    std::vector<std::optional<std::size_t>> offers;
    double error = 0, eval = 0, sample = 0;
};

/// The cheapest that keeps the tolerance together.
Choice cheapest(const std::vector<LobeRange>&, double tolerance);

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
