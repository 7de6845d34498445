// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common parts of the searches without libFuzzer: their end, and the output lines that run.py reads
// from both kinds.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string_view>

namespace reckon::fuzz {

/// Counts runs since its construction.
class RunStatistics {
 public:
  void add() noexcept { ++runs_; }
  [[nodiscard]] std::uint64_t runs() const noexcept { return runs_; }
  /// Prints them in libFuzzer's format.
  void print() const {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began_;
    fmt::print("stat::number_of_executed_units: {}\nstat::average_exec_per_sec:     {:.0f}\n",
               runs_, static_cast<double>(runs_) / took.count());
  }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::uint64_t runs_ = 0;
};

/// Prints a finding and how to replay it.
inline void print_finding(std::string_view sentence, std::string_view target,
                          std::string_view replay) {
  fmt::print("reckon fuzz: {}\n        again: ./run fuzz {} --replay {}\n", sentence, target,
             replay);
}

/// Returns the result of `run`; 2, with a sentence, if it throws.
template <typename Run>
int guarded(Run&& run) {
  try {
    return run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "reckon fuzz: {}\n", error.what());
    return 2;
  }
}

}  // namespace reckon::fuzz
