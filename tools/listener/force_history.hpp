// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Forces over time for a plot, in bounded memory: when it is full, the time span doubles, and each
// column keeps the greater of two.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace reckon::tools {

/// Greatest force in each of at most kColumns equal time intervals. Histories with samples at the
/// same times have the same intervals. One thread.
class ForceHistory {
 public:
  static constexpr std::size_t kColumns = 2048;

  /// @param step > 0, interval of the samples and width of the first column.
  explicit ForceHistory(std::chrono::nanoseconds step) : width_(step) {}

  /// @param since time since the start of all histories, >= 0, not decreasing; NaN counts as 0.
  void add(std::chrono::nanoseconds since, double newtons) {
    reach(since);
    float& column = peaks_[static_cast<std::size_t>(since / width_)];
    if (newtons > static_cast<double>(column)) column = static_cast<float>(newtons);
  }
  /// Widens the columns to cover `since`, and adds zeros up to there.
  void reach(std::chrono::nanoseconds since) {
    while (since / width_ >= static_cast<std::chrono::nanoseconds::rep>(kColumns)) halve();
    const auto column = static_cast<std::size_t>(since / width_);
    if (peaks_.size() <= column) peaks_.resize(column + 1, 0.0F);
  }

  [[nodiscard]] std::chrono::nanoseconds width() const { return width_; }
  [[nodiscard]] const std::vector<float>& peaks() const { return peaks_; }

 private:
  void halve() {
    const std::size_t half = (peaks_.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i)
      peaks_[i] = std::max(peaks_[2 * i], 2 * i + 1 < peaks_.size() ? peaks_[2 * i + 1] : 0.0F);
    peaks_.resize(half);
    width_ *= 2;
  }

  std::chrono::nanoseconds width_;
  std::vector<float> peaks_;  // [N]
};

}  // namespace reckon::tools
