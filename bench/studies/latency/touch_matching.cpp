// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/latency/touch_matching.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::bench {

TouchTimes match_touches(std::span<const StepSample> changes, std::span<const StepSample> forces) {
  TouchTimes result;
  for (std::size_t i = 1; i < changes.size(); ++i) {
    const StepSample& change = changes[i];
    const double before = changes[i - 1].value;
    const auto shows = [&](const StepSample& force) {
      return std::abs(force.value - change.value) < std::abs(force.value - before);
    };
    const auto after = std::upper_bound(
        forces.begin(), forces.end(), change.time,
        [](std::chrono::nanoseconds time, const StepSample& force) { return time < force.time; });
    const bool last = i + 1 == changes.size();
    const auto first = std::find_if(after, forces.end(), shows);
    const bool early = after != forces.begin() && shows(*(after - 1));
    if (early || first == forces.end() || (!last && first->time >= changes[i + 1].time)) {
      ++result.missed;
    } else {
      result.taken.push_back(first->time - change.time);
    }
  }
  return result;
}

}  // namespace reckon::bench
