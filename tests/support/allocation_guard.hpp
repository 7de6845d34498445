// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counts heap allocations of this thread inside a scope, so that a test can show a loop makes none.
#pragma once

#include <cstddef>

namespace reckon::test {

/// Counts operator new (all forms) called by the constructing thread while alive.
class AllocationGuard {
 public:
  AllocationGuard();
  /// Allocations since construction.
  [[nodiscard]] std::size_t count() const;

 private:
  std::size_t start_;
};

}  // namespace reckon::test
