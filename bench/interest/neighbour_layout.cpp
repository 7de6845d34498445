// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/neighbour_layout.hpp"

#include <bit>
#include <numeric>

namespace reckon::bench {

NeighbourLayout::Span NeighbourLayout::span_of(double x, double range, double per_unit,
                                               std::int64_t count) {
  // Widens the range by more than rounding can take.
  const double wide = range + 1e-15 * (std::abs(x) + range);
  const Span span{index(x - wide, per_unit), index(x + wide, per_unit)};
  if (span.last - span.first + 1 >= count) return {0, count - 1};
  return span;
}

void NeighbourLayout::plan(std::size_t count, double reach, double slack,
                           const Surroundings& around) {
  // So that the error of a distance in single precision is far below the reach.
  constexpr double kMostExtent = 0x1p16;
  reach_ = reach;
  extent_ = kMostExtent * reach;
  farthest_ = 0;
  least_squared_ = std::numeric_limits<double>::infinity();
  most_squared_ = Hearer::kNobody;
  origin_ = around.middle;
  // A little more, for rounding.
  const double apart = 1.0001 * (reach + slack);
  per_y_ = apart > 0 ? static_cast<double>(kRowsUp) / apart : 1.0;
  per_x_ = apart > 0 ? static_cast<double>(kColumnsOut) / apart : 1.0;
  choose_cells(count, around);
  hearers_.resize(count + 1);
  entity_.resize(count + 1);
  apart_.resize(count + 1);
  for (auto* column : {&x_, &y_, &z_}) column->resize(count + kBorderPadding);
}

// As many cells as the surroundings need, and enough that no two cells are neighbours in both
// directions around the torus. If the surroundings need too many cells, the cells cover a part,
// which is square unless the surroundings are narrower. Most positions are then wrapped, so the
// counts are powers of two.
void NeighbourLayout::choose_cells(std::size_t count, const Surroundings& around) {
  const auto most = static_cast<std::int64_t>(std::bit_ceil(std::max<std::size_t>(count, 256)));
  const std::int64_t room = most + most / 4;
  const auto cells_of = [room](double length, std::int64_t out, std::int64_t least) {
    constexpr double kWider = 1.0625;  // than the extent of the sampled entities
    const double cells = std::min(kWider * length, static_cast<double>(room));
    return std::max(static_cast<std::int64_t>(cells) + out, least);
  };
  rows_ = cells_of((around.most.y - around.least.y) * per_y_, kRowsUp, kLeastRows);
  columns_ = cells_of((around.most.x - around.least.x) * per_x_, kColumnsOut, kLeastColumns);
  corner_row_ = index(around.least.y, per_y_);
  corner_column_ = index(around.least.x, per_x_);
  row_mask_ = column_mask_ = -1;
  if (rows_ * columns_ > room) {
    const auto power = [](std::int64_t cells) {
      return static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(cells)));
    };
    const auto bits = std::bit_width(static_cast<std::uint64_t>(most));
    rows_ = std::min(power(rows_), std::max(kLeastRows, std::int64_t{1} << (bits - 3) / 2));
    columns_ = std::min(power(columns_), most / rows_);
    rows_ = most / columns_;
    row_mask_ = rows_ - 1;
    column_mask_ = columns_ - 1;
    corner_row_ = corner_column_ = 0;  // so that the order is the same at each tick
  }
  starts_.reserve(static_cast<std::size_t>(room) + 2);
  starts_.assign(static_cast<std::size_t>(rows_ * columns_) + 2, 0);
}

// Each count is stored two places after its cell. put() advances it from the start of the cell to
// the start of the next.
void NeighbourLayout::sort_cells() {
  std::inclusive_scan(starts_.begin(), starts_.end(), starts_.begin());
  hearers_[size()] = {};
  apart_[size()] = Apart::no;
}

void NeighbourLayout::set_border(double inside, double outside) {
  // Greatest difference between distances in single and in double precision.
  const double away = std::max({std::abs(origin_.x), std::abs(origin_.y), std::abs(origin_.z)});
  const double error = 0x1p-21 * static_cast<double>(farthest_) + 0x1p-50 * away + 1e-18;
  const auto least = [wide = inside + error](double squared) {
    const double edge = squared < 0 ? INFINITY : std::max(0.0, std::sqrt(squared) - wide);
    return static_cast<float>(0.999999 * edge * edge);
  };
  const auto most = [wide = outside + error](double squared) {
    const double edge = squared < 0 ? -1.0 : std::sqrt(squared) + wide;
    return static_cast<float>(1.000001 * edge * std::abs(edge));
  };
  same_for_all_ = least_squared_ >= most_squared_;
  least_of_all_ = least(most_squared_);
  most_of_all_ = most(most_squared_);
  if (same_for_all_) return;
  least_.resize(size() + kBorderPadding);
  most_.resize(size() + kBorderPadding);
  for (std::uint32_t slot = 0; slot < size(); ++slot) {
    const double squared = is_apart(slot) ? Hearer::kNobody : hearers_[slot].squared_radius;
    least_[slot] = least(squared);
    most_[slot] = most(squared);
  }
}

BorderColumns NeighbourLayout::columns() const noexcept {
  const bool own = !same_for_all_;
  return {.x = x_.data(),
          .y = y_.data(),
          .z = z_.data(),
          .least = own ? least_.data() : nullptr,
          .most = own ? most_.data() : nullptr,
          .least_of_all = least_of_all_,
          .most_of_all = most_of_all_};
}

std::size_t NeighbourLayout::memory() const noexcept {
  return 4 * (starts_.capacity() + entity_.capacity() + x_.capacity() + y_.capacity() +
              z_.capacity() + least_.capacity() + most_.capacity()) +
         sizeof(Hearer) * hearers_.capacity() + apart_.capacity();
}

}  // namespace reckon::bench
