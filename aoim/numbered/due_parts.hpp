// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sender's side of a whole in numbered parts: which parts are due.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/numbered/part_request.hpp"

namespace reckon::aoim {

/// Parts that are to be sent, in their order. One thread; only begin() allocates.
class DueParts {
 public:
  /// Begins a whole of `parts` parts; all are due.
  void begin(std::size_t parts) {
    due_.assign(parts, true);
    left_ = parts;
  }
  /// Makes requested parts due again. Ignores those that the whole does not have.
  void request(const PartRequest& request) noexcept {
    for (std::size_t i = 0; i < kMostRequested; ++i) {
      const std::size_t part = request.first + i;
      if ((request.parts >> i & 1) == 0 || part >= due_.size() || due_[part]) continue;
      due_[part] = true;
      ++left_;
    }
  }
  /// Takes the first due part; there must be one (assert).
  [[nodiscard]] std::size_t take() noexcept {
    assert(left_ > 0);
    const auto due = std::find(due_.begin(), due_.end(), true);
    *due = false;
    --left_;
    return static_cast<std::size_t>(due - due_.begin());
  }
  /// Number of due parts.
  [[nodiscard]] std::size_t left() const noexcept { return left_; }

 private:
  std::vector<bool> due_;
  std::size_t left_ = 0;
};

}  // namespace reckon::aoim
