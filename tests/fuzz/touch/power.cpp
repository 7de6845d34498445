// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/power.hpp"

#include <algorithm>
#include <cstddef>

namespace reckon::fuzz {
namespace {

constexpr double kAsMuch = 1.5;
constexpr std::size_t kSecond = 1000, kBurst = 50, kShift = 100;  // samples

// The energy received within the `window` before each sample.
std::vector<double> came_within(const std::vector<double>& book, std::size_t window) {
  std::vector<double> came(book.size());
  for (std::size_t i = 0; i < book.size(); ++i) {
    came[i] = book[i] - (i >= window ? book[i - window] : 0.0);
  }
  return came;
}

double most_beyond(const std::vector<double>& got, const std::vector<double>& honest,
                   std::size_t window) {
  const std::vector<double> came = came_within(got, window), fair = came_within(honest, window);
  double most = 0;
  for (std::size_t i = 0; i < came.size(); ++i) {
    if (came[i] <= most) continue;
    const std::size_t first = i > kShift ? i - kShift : 0;
    const std::size_t last = std::min(i + kShift + 1, fair.size());
    double allowed = 0;
    for (std::size_t j = first; j < last; ++j) allowed = std::max(allowed, fair[j]);
    most = std::max(most, came[i] - kAsMuch * allowed);
  }
  return most;
}

}  // namespace

Excess excess_over(const std::vector<double>& got, const std::vector<double>& honest) {
  const double second = static_cast<double>(kSecond) * kSampled;
  return {most_beyond(got, honest, kSecond) / second, most_beyond(got, honest, kBurst)};
}

}  // namespace reckon::fuzz
