// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/power_ledger.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::bench {

double power(std::span<const PortValue> ports) {
  double sum = 0.0;
  for (const PortValue& port : ports) sum += port.effort * port.flow;
  return sum;
}

double junction_residual(Junction kind, std::span<const PortValue> ports) {
  if (ports.empty()) return 0.0;
  const double PortValue::*common =
      kind == Junction::common_effort ? &PortValue::effort : &PortValue::flow;
  const double PortValue::*added =
      kind == Junction::common_effort ? &PortValue::flow : &PortValue::effort;
  double difference = 0.0, sum = 0.0;
  for (const PortValue& port : ports) {
    difference = std::max(difference, std::abs(port.*common - ports.front().*common));
    sum += port.*added;
  }
  return std::max(difference, std::abs(sum));
}

double PowerLedger::tick(std::span<const PortValue> ports, double stored, double dissipated,
                         double period) {
  const double in = power(ports) * period;
  const double imbalance = in - (stored - stored_) - dissipated;
  stored_ = stored;
  absorbed_ += in;
  worst_ = std::max(worst_, std::abs(imbalance));
  made_ = std::max(made_, -(absorbed_ + start_));
  return imbalance;
}

}  // namespace reckon::bench
