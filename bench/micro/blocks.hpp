// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Times alternatives in short blocks in turn, by the CPU time of their thread, so that other load
// on the machine affects all of them little and equally. Results are medians of blocks, or of the
// ratios of neighbouring blocks.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"

namespace reckon::bench {

/// CPU time of one call [ns], averaged over a block.
template <typename Call>
double nanoseconds_of(Call&& call) {
  constexpr int kCalls = 500;
  return cpu_ns_of([&] {
           for (int i = 0; i < kCalls; ++i) {
             call();
             benchmark::ClobberMemory();
           }
         }) /
         kCalls;
}

/// One number for each block; reported as median, 10th and 90th percentile.
class Blocks {
 public:
  void add(double value) { values_.push_back(value); }
  void report(benchmark::State& state, const std::string& name) {
    state.counters[name] = quantile(values_, 0.5);
    state.counters[name + "_p10"] = quantile(values_, 0.1);
    state.counters[name + "_p90"] = quantile(values_, 0.9);
  }

 private:
  std::vector<double> values_;
};

}  // namespace reckon::bench
