// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Quantiles of a list: one rule for all studies, the same as in the product's histograms
// (peer::bucket_of_share).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace reckon::bench {

/// The smallest value such that at least `share` (0 to 1) of all values are at or below it: index
/// ceil(share n) - 1 of the sorted list. 0 for an empty list. The order of `values` is lost. O(n).
template <typename Value>
[[nodiscard]] Value quantile(std::vector<Value>& values, double share) {
  if (values.empty()) return {};
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto at =
      values.begin() + std::max(static_cast<std::ptrdiff_t>(rank), std::ptrdiff_t{1}) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The middle value, or the mean of the two middle values. 0 for an empty list. The order of
/// `values` is lost. O(n).
[[nodiscard]] inline double median(std::vector<double>& values) {
  const double lower = quantile(values, 0.5);
  if (values.empty() || values.size() % 2 == 1) return lower;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  return (lower + *std::min_element(middle, values.end())) / 2;
}

}  // namespace reckon::bench
