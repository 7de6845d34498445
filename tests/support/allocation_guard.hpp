// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counts heap allocations of this thread inside a scope, so that a test can show that a loop makes
// none, or that its memory is bounded.
#pragma once

#include <cstddef>

namespace reckon::test {

/// Counts operator new (all forms) called by the constructing thread while alive.
class AllocationGuard {
 public:
  AllocationGuard();
  /// Allocations since construction.
  [[nodiscard]] std::size_t count() const;
  /// Greatest number of octets held at one time since construction, beyond those held before; as
  /// rounded up by the allocator. One guard at a time.
  [[nodiscard]] std::size_t peak_octets() const;

 private:
  std::size_t start_;
  std::ptrdiff_t held_;
};

}  // namespace reckon::test
