// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The receiver's side of a whole in numbered parts: which parts are missing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/numbered/part_request.hpp"

namespace reckon::aoim {

/// Parts that did not arrive yet. One thread; only begin() allocates.
class MissingParts {
 public:
  /// Begins a whole of `parts` parts; all are missing.
  void begin(std::size_t parts) {
    got_.assign(parts, false);
    missing_ = parts;
  }
  /// Notes an arrived part; false if it is none of the whole, or has arrived before.
  [[nodiscard]] bool take(std::size_t part) noexcept {
    if (part >= got_.size() || got_[part]) return false;
    got_[part] = true;
    --missing_;
    return true;
  }
  /// The missing parts from the first one at or behind `from` on, at most kMostRequested of them.
  [[nodiscard]] PartRequest request(std::size_t from) const noexcept {
    PartRequest request;
    request.first = next_missing(from);
    const std::size_t end = std::min(request.first + kMostRequested, got_.size());
    for (std::size_t i = request.first; i < end; ++i) {
      if (!got_[i]) request.parts |= std::uint64_t{1} << (i - request.first);
    }
    return request;
  }
  /// Where the request behind this one begins; 0 if that would be empty.
  [[nodiscard]] std::size_t behind(const PartRequest& request) const noexcept {
    const std::size_t end = std::min(request.first + kMostRequested, got_.size());
    return next_missing(end) < got_.size() ? end : 0;
  }

  [[nodiscard]] std::size_t parts() const noexcept { return got_.size(); }
  [[nodiscard]] std::size_t missing() const noexcept { return missing_; }

 private:
  [[nodiscard]] std::size_t next_missing(std::size_t from) const noexcept {
    const auto begin = got_.begin() + static_cast<std::ptrdiff_t>(std::min(from, got_.size()));
    return static_cast<std::size_t>(std::find(begin, got_.end(), false) - got_.begin());
  }

  std::vector<bool> got_;
  std::size_t missing_ = 0;
};

}  // namespace reckon::aoim
