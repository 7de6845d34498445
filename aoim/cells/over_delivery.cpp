// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/cells/over_delivery.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace reckon::aoim {
namespace {

struct Deliveries {
  double heard = 0.0, wanted = 0.0;
};

// Counts the deliveries of one instant: every participant sends once and receives.
Deliveries deliveries(const CellPartition& cells, const std::vector<Demand>& demands) {
  Deliveries sum;
  std::vector<double> said(cells.groups() + 1);
  for (const Demand& demand : demands) said[cells.group(demand.position).value] += 1.0;
  std::vector<bool> joined;
  for (const Demand& listener : demands) {
    joined.assign(said.size(), false);
    cells.visit([&](const auto& scheme) {
      scheme.for_each_cell_within(listener.position, listener.radius, [&](CellId cell, double) {
        const std::uint16_t group = scheme.group(cell).value;
        if (!joined[group]) sum.heard += said[group];
        joined[group] = true;
      });
    });
    sum.heard -= joined[cells.group(listener.position).value] ? 1.0 : 0.0;  // not its own update
    sum.wanted -= 1.0;
    for (const Demand& sender : demands) {
      const double x = sender.position.x - listener.position.x,
                   y = sender.position.y - listener.position.y;
      sum.wanted += std::sqrt(x * x + y * y) <= listener.radius ? 1.0 : 0.0;
    }
  }
  return sum;
}

}  // namespace

double over_delivery(const CellPartition& cells, std::span<const Demand> demands) {
  std::map<std::uint32_t, std::vector<Demand>> instants;
  for (const Demand& demand : demands) {
    if (is_finite(demand.position) && demand.radius >= 0.0)
      instants[demand.instant].push_back(demand);
  }
  Deliveries sum;
  for (const auto& [instant, there] : instants) {
    const Deliveries more = deliveries(cells, there);
    sum.heard += more.heard;
    sum.wanted += more.wanted;
  }
  return sum.wanted > 0.0 ? sum.heard / sum.wanted : 0.0;
}

}  // namespace reckon::aoim
