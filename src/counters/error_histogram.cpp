// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/counters/error_histogram.hpp"

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {
constexpr double kLargest = 1e3;
}

void ErrorHistogram::add(double error) noexcept {
  const double kept = error >= 0.0 && error < kLargest ? error : kLargest;
  nano_units_.add(pdu::from_seconds(kept));
}

Spread ErrorHistogram::spread() const noexcept {
  const Percentiles p = percentiles(nano_units_);
  const auto units = [](std::chrono::nanoseconds value) {
    return static_cast<double>(value.count()) * 1e-9;
  };
  return {units(p.p50), units(p.p99), units(p.p999), units(p.max), nano_units_.count()};
}

}  // namespace reckon::peer
