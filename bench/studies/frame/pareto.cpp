// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/frame/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace reckon::bench {
namespace {

bool no_more(const Costs& a, const Costs& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) return false;
  }
  return true;
}

}  // namespace

std::vector<std::optional<Beaten>> mark_front(std::span<const Costs> settings) {
  std::vector<Costs> costs(settings.begin(), settings.end());
  for (Costs& cost : costs) {
    for (double& value : cost)
      if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
  }
  // In this order no row is dominated by a later one.
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });

  std::vector<std::optional<Beaten>> marks(costs.size());
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const auto winner = std::find_if(front.begin(), front.end(), [&](std::size_t better) {
      return no_more(costs[better], costs[i]);
    });
    if (winner == front.end()) {
      front.push_back(i);
    } else {
      marks[i] = Beaten{*winner, costs[*winner] == costs[i]};
    }
  }
  return marks;
}

}  // namespace reckon::bench
