// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The clock of benches and studies: CPU time of the calling thread.
#pragma once

#include <vector>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/peer/threads/cpu_time.hpp"

namespace reckon::bench {

/// CPU time of the calling thread so far [ns].
inline double cpu_ns() { return static_cast<double>(peer::thread_cpu_time().count()); }

/// CPU time between two readings of the clock with nothing between them [ns]: the median, from
/// which nine of ten differ by some 10 ns.
inline double clock_cost() {
  static const double cost = [] {
    std::vector<double> costs(1001);
    for (double& one : costs) {
      const double begin = cpu_ns();
      one = cpu_ns() - begin;
    }
    return quantile(costs, 0.5);
  }();
  return cost;
}

/// CPU time of one call [ns], without that of reading the clock.
///
///   rows.add(cpu_ns_of([&] { table.take(update); }));
template <typename Call>
double cpu_ns_of(Call&& call) {
  const double cost = clock_cost();
  const double begin = cpu_ns();
  call();
  return cpu_ns() - begin - cost;
}

}  // namespace reckon::bench
