// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which value of a list stands for a share of it: the one rule of all studies, that of the
// product's histograms (peer::bucket_of_share).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace reckon::bench {

/// The smallest value with at least `share` (0 to 1) of all at or below it: index
/// ceil(share n) - 1 of the sorted list. 0 where there are none. The order of `values` is lost.
/// O(n).
template <typename Value>
[[nodiscard]] Value quantile(std::vector<Value>& values, double share) {
  if (values.empty()) return {};
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto at =
      values.begin() + std::max(static_cast<std::ptrdiff_t>(rank), std::ptrdiff_t{1}) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The one in the middle, or the mean of both in the middle. 0 where there are none. The order of
/// `values` is lost. O(n).
[[nodiscard]] inline double median(std::vector<double>& values) {
  const double lower = quantile(values, 0.5);
  if (values.empty() || values.size() % 2 == 1) return lower;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  return (lower + *std::min_element(middle, values.end())) / 2;
}

}  // namespace reckon::bench
