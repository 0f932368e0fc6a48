// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "plan_words.h"

#include "method_prediction.h"

#include <cstdio>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {
namespace {

std::string said(const NamedOffer& o)
{
    return std::string(name(o.method)) + " costs " + digits(o.offer.price) + " and errs by " +
           digits(largest(o.offer.error));
}

// What could have been saved: of what is cheaper that which is nearest.
const NamedOffer* nearest_cheaper(const std::vector<NamedOffer>& offers, const Offer& than)
{
    const NamedOffer* nearest = nullptr;
    for (const NamedOffer& o : offers)
        if (o.offer.price < than.price &&
            (!nearest || largest(o.offer.error) < largest(nearest->offer.error)))
            nearest = &o;
    return nearest;
}

}  // namespace

std::string digits(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", x);
    return text;
}

std::string why_chosen(const std::vector<NamedOffer>& offers, std::size_t chosen, bool within,
                       double tolerance)
{
    const NamedOffer& it = offers[chosen];
    const std::string error = digits(largest(it.offer.error));
    if (!within) return "nothing is within the tolerance; of all this errs least, by " + error;
    if (name(it.method) == "none")
        return it.offer.error == ColorD(0.0) ? "a mirror loses nothing to later bounces"
                                             : "what it loses to later bounces is at most " + error;
    if (tolerance == 0) return "the reference";
    std::string why = "the cheapest that keeps the tolerance: " + said(it);
    if (const NamedOffer* other = nearest_cheaper(offers, it.offer)) why += "; " + said(*other);
    return why;
}

std::string why_unknown(const MethodCosts& costs, const MicrofacetMaterial& m)
{
    const std::string kept = ": kept as recommended";
    if (costs.empty()) return "there are no measured costs" + kept;
    if (const auto* i = std::get_if<InterfaceSurface>(&m.surface))
    {
        if (i->thin_walled) return "thin walls were not measured" + kept;
        if (i->mode == ScatterMode::T) return "transmission alone was not measured" + kept;
        if (i->mode == ScatterMode::R && i->eta < 1)
            return "total reflection alone was not measured" + kept;
    }
    if (has_gamma(m.distribution))
    {
        const auto gammas = costs.gammas(m.distribution);
        if (gammas.empty())
            return "no " + std::string(name(m.distribution)) + " was measured" + kept;
        if (m.gamma < gammas.front())
            return "no tail of a gamma below " + digits(gammas.front()) + " was measured" + kept;
    }
    if (m.is_interface()) return "no index so near 1 was measured" + kept;
    return "nothing like it was measured" + kept;
}

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
