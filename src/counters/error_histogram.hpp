// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Distribution of errors: metres, newtons or joules.
#pragma once

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"

namespace reckon::peer {

/// The size of an error in any SI unit, from 1e-9 to 1000 units in buckets 3 % wide; negative, NaN
/// or above 1000 units counts as 1000 units.
struct ErrorScale : DurationScale {
  using Value = double;
  static constexpr double kLargest = 1e3;

  static Kept keep(double error) noexcept {
    return pdu::rounded((error >= 0.0 && error < kLargest ? error : kLargest) * 1e9);
  }
  static double value_of(Kept nano_units) noexcept {
    return static_cast<double>(nano_units) * 1e-9;
  }
};
using ErrorHistogram = Histogram<ErrorScale>;

}  // namespace reckon::peer
