// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/height_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

namespace reckon::haptics {
namespace {

constexpr std::size_t kLeast = 4;
constexpr std::size_t kRandom = 64;   // along each edge of a random map
constexpr std::size_t kEnough = 256;  // samples along each edge that suffice for a mean

}  // namespace

/// Four neighbours along one axis: their indices, and their weights in value and slope.
struct HeightMap::Weights {
  std::size_t at[4];
  double value[4], slope[4];

  Weights(double place, std::size_t count) noexcept {
    const double n = static_cast<double>(count);
    // NaN counts as the start.
    const double share = place - std::floor(place);
    const double x = std::isfinite(share) ? share * n : 0.0;
    const auto cell = std::min(static_cast<std::size_t>(x), count - 1);
    const double t = x - static_cast<double>(cell);
    for (std::size_t i = 0; i < 4; ++i) at[i] = (cell + count + i - 1) % count;
    value[0] = 0.5 * t * (-1.0 + t * (2.0 - t));
    value[1] = 1.0 + 0.5 * t * t * (-5.0 + 3.0 * t);
    value[2] = 0.5 * t * (1.0 + t * (4.0 - 3.0 * t));
    value[3] = 0.5 * t * t * (t - 1.0);
    slope[0] = 0.5 * n * (-1.0 + t * (4.0 - 3.0 * t));
    slope[1] = 0.5 * n * t * (-10.0 + 9.0 * t);
    slope[2] = 0.5 * n * (1.0 + t * (8.0 - 9.0 * t));
    slope[3] = 0.5 * n * t * (3.0 * t - 2.0);
  }
};

HeightMap::HeightMap(std::size_t columns, std::size_t rows, std::vector<float> heights)
    : columns_(columns), rows_(rows), heights_(std::move(heights)) {
  if (columns < kLeast || rows < kLeast || heights_.size() != columns * rows)
    throw std::invalid_argument("a height map needs at least 4 x 4 heights, one for each point");
}

// Each height is the mean of a random one and of its eight neighbours, spread over [0, 1] again.
HeightMap HeightMap::random(std::uint64_t seed) {
  std::mt19937_64 numbers(seed);
  std::vector<float> rough(kRandom * kRandom), even(kRandom * kRandom);
  for (float& height : rough) height = static_cast<float>(numbers() >> 40);
  for (std::size_t i = 0; i < even.size(); ++i) {
    const std::size_t column = i % kRandom, row = i / kRandom;
    for (std::size_t k = 0; k < 9; ++k)
      even[i] += rough[(column + k % 3 + kRandom - 1) % kRandom +
                       (row + k / 3 + kRandom - 1) % kRandom * kRandom];
  }
  const auto [least, most] = std::ranges::minmax(even);
  for (float& height : even) height = (height - least) / (most - least);
  return {kRandom, kRandom, std::move(even)};
}

double HeightMap::sum(const Weights& x, const double* across, const Weights& y,
                      const double* along) const noexcept {
  double total = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    const float* const row = heights_.data() + y.at[j] * columns_;
    double in_row = 0.0;
    for (std::size_t i = 0; i < 4; ++i) in_row += across[i] * static_cast<double>(row[x.at[i]]);
    total += along[j] * in_row;
  }
  return total;
}

double HeightMap::at(const Eigen::Vector2d& place) const noexcept {
  const Weights x(place.x(), columns_), y(place.y(), rows_);
  return sum(x, x.value, y, y.value);
}

Eigen::Vector2d HeightMap::gradient(const Eigen::Vector2d& place) const noexcept {
  const Weights x(place.x(), columns_), y(place.y(), rows_);
  return {sum(x, x.slope, y, y.value), sum(x, x.value, y, y.slope)};
}

// For h = cos(2 pi x / length) the spread of the slope is 2 pi / length times the spread of h. A
// sample of the heights suffices for a large map.
double HeightMap::wavelength(const Eigen::Vector2d& size) const noexcept {
  const std::size_t across = std::max<std::size_t>(1, columns_ / kEnough);
  const std::size_t along = std::max<std::size_t>(1, rows_ / kEnough);
  double count = 0.0, mean = 0.0, squares = 0.0, slopes = 0.0;
  for (std::size_t row = 0; row < rows_; row += along) {
    for (std::size_t column = 0; column < columns_; column += across) {
      const double height = static_cast<double>(heights_[row * columns_ + column]);
      const Eigen::Vector2d place(static_cast<double>(column) / static_cast<double>(columns_),
                                  static_cast<double>(row) / static_cast<double>(rows_));
      count += 1.0;
      mean += height;
      squares += height * height;
      slopes += gradient(place).cwiseQuotient(size).squaredNorm();
    }
  }
  const double spread = squares / count - mean * mean / (count * count);
  if (!(slopes > 0.0) || !(spread > 0.0)) return std::numeric_limits<double>::infinity();
  return 2.0 * std::numbers::pi * std::sqrt(spread / (slopes / count));
}

}  // namespace reckon::haptics
