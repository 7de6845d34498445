// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counts heap allocations of this thread inside a scope, so that a test can show a loop makes none,
// or that what it holds is bounded.
#pragma once

#include <cstddef>

namespace reckon::test {

/// Counts operator new (all forms) called by the constructing thread while alive.
class AllocationGuard {
 public:
  AllocationGuard();
  /// Allocations since construction.
  [[nodiscard]] std::size_t count() const;
  /// Most octets held at one time since construction, beyond those held before; as the allocator
  /// rounds them up. One guard at a time.
  [[nodiscard]] std::size_t peak_octets() const;

 private:
  std::size_t start_;
  std::ptrdiff_t held_;
};

}  // namespace reckon::test
