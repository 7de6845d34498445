// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The number of tries of a test: a sample in the gate of each commit, everything in `./run soak
// tests`.
#pragma once

#include <cstdlib>

namespace reckon::test {

/// True if RECKON_SOAK is set.
[[nodiscard]] inline bool soaks() { return std::getenv("RECKON_SOAK") != nullptr; }

/// @return `gate`, or `soak` in a soak
template <typename T>
[[nodiscard]] T tries(T gate, T soak) {
  return soaks() ? soak : gate;
}

/// Thins a grid that nested loops visit: a gate keeps every nth cell. If n has no factor in common
/// with the lengths of the inner loops, every value of each loop still appears beside those of the
/// others.
class Thinned {
 public:
  /// @param n 1: keeps all  @param first the first cell to keep, below n
  explicit Thinned(int n, int first = 0) : n_(tries(n, 1)), next_(n_ - first % n_) {}
  /// Whether to skip the next cell.
  [[nodiscard]] bool skips() { return next_++ % n_ != 0; }

 private:
  int n_, next_;
};

}  // namespace reckon::test
