// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Distribution of errors: percentiles of metres, newtons or joules without storing each one.
#pragma once

#include <cstdint>

#include "reckon/peer/counters/duty_cycle.hpp"

namespace reckon::peer {

/// p50, p99, p99.9 and maximum of a distribution, in its own unit.
struct Spread {
  double p50 = 0, p99 = 0, p999 = 0, max = 0;
  std::uint64_t count = 0;
};

/// Distribution of the size of an error in any SI unit, from 1e-9 to 1000 units in buckets 3 %
/// wide. One thread calls add(), any thread calls spread(). No allocation.
class ErrorHistogram {
 public:
  /// Adds an error; negative, NaN or above 1000 units counts as 1000 units. About 5 ns.
  void add(double error) noexcept;
  [[nodiscard]] Spread spread() const noexcept;

 private:
  DurationHistogram nano_units_;
};

}  // namespace reckon::peer
