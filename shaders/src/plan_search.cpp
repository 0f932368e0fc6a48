// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "plan_search.h"

#include "method_prediction.h"

#include <algorithm>
#include <limits>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {
namespace {

// Branch and bound, closure by closure, cheap offers first.
class Search
{
public:
    Search(const std::vector<std::vector<Offer>>& offers, double tolerance)
        : _offers(offers),
          _tolerance(tolerance),
          _chosen(offers.size()),
          _order(offers.size()),
          _rest_error(offers.size() + 1, ColorD(0.0)),
          _rest_price(offers.size() + 1, 0.0)
    {
        for (std::size_t k = offers.size(); k-- > 0;)
        {
            auto& order = _order[k];
            for (std::size_t i = 0; i < offers[k].size(); ++i) order.push_back(i);
            std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
                return offers[k][a].price < offers[k][b].price;
            });
            ColorD least(std::numeric_limits<double>::max());
            for (const Offer& o : offers[k])
                for (int c = 0; c < 3; ++c) least[c] = std::min(least[c], o.error[c]);
            _rest_error[k] = _rest_error[k + 1] + least;
            _rest_price[k] = _rest_price[k + 1] + offers[k][order.front()].price;
        }
    }

    std::vector<std::size_t> best()
    {
        go_on(0, ColorD(0.0), 0);
        return _best.empty() ? least_errors() : _best;
    }

private:
    void go_on(std::size_t k, const ColorD& error, double price)
    {
        // Sixteen closures of a dozen offers may be more than anybody waits for: what was found by
        // then is within the tolerance, too.
        if (++_steps > most_steps) return;
        if (largest(error + _rest_error[k]) > _tolerance) return;
        if (!_best.empty() && price + _rest_price[k] >= _best_price) return;
        if (k == _offers.size())
        {
            _best = _chosen;
            _best_price = price;
            return;
        }
        for (const std::size_t i : _order[k])
        {
            _chosen[k] = i;
            go_on(k + 1, error + _offers[k][i].error, price + _offers[k][i].price);
        }
    }
    std::vector<std::size_t> least_errors() const
    {
        std::vector<std::size_t> all;
        for (const auto& offers : _offers)
            all.push_back(static_cast<std::size_t>(
                std::min_element(offers.begin(), offers.end(),
                                 [](const Offer& a, const Offer& b) {
                                     return largest(a.error) != largest(b.error)
                                                ? largest(a.error) < largest(b.error)
                                                : a.price < b.price;
                                 }) -
                offers.begin()));
        return all;
    }

    static constexpr long most_steps = 1000000;
    const std::vector<std::vector<Offer>>& _offers;
    double _tolerance;
    std::vector<std::size_t> _chosen, _best;
    std::vector<std::vector<std::size_t>> _order;
    std::vector<ColorD> _rest_error;  // least, of the closures from k on
    std::vector<double> _rest_price;
    double _best_price = 0;
    long _steps = 0;
};

}  // namespace

std::vector<std::size_t> cheapest_within(const std::vector<std::vector<Offer>>& offers,
                                         double tolerance)
{
    return Search(offers, tolerance).best();
}

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
