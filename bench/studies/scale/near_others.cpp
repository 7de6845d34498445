// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/near_others.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::bench {
namespace {

double farthest_end(const aoim::ChannelTable& table) {
  double farthest = 1;
  for (std::size_t row = 0; row < table.size(); ++row)
    if (std::isfinite(table.channel(row).farthest)) farthest = table.channel(row).farthest;
  return farthest;
}

constexpr double kFastest = 200;  // [m/s] at which two come nearer to each other

// Where a coordinate lies among so many cells.
std::size_t cell_at(double offset, double side, std::size_t count) {
  return static_cast<std::size_t>(
      std::clamp(std::floor(offset / side), 0.0, static_cast<double>(count - 1)));
}

}  // namespace

NearOthers::NearOthers(std::span<const std::uint32_t> owners,
                       std::span<const aoim::Channel> channels)
    : owners_(owners),
      channels_(channels),
      reach_(aoim::kNearLeave * farthest_end(channels_.table()) + kFastest * aoim::kNearAhead) {}

std::size_t NearOthers::column_of(double x) const noexcept {
  return cell_at(x - left_, reach_, columns_);
}
std::size_t NearOthers::row_of(double y) const noexcept {
  return cell_at(y - bottom_, reach_, rows_);
}

void NearOthers::update(const Crowd& crowd) {
  double right = left_ = crowd.position(0).x, top = bottom_ = crowd.position(0).y;
  for (std::size_t e = 0; e < crowd.size(); ++e) {
    const aoim::Position& place = crowd.position(e);
    left_ = std::min(left_, place.x);
    right = std::max(right, place.x);
    bottom_ = std::min(bottom_, place.y);
    top = std::max(top, place.y);
  }
  constexpr double kMostAcross = 4096;
  const auto across = [&](double length) {
    return static_cast<std::size_t>(std::min(std::floor(length / reach_) + 1, kMostAcross));
  };
  columns_ = across(right - left_);
  rows_ = across(top - bottom_);
  begins_.assign(columns_ * rows_ + 1, 0);
  const auto cell_of = [&](std::size_t e) {
    const aoim::Position& place = crowd.position(e);
    return row_of(place.y) * columns_ + column_of(place.x);
  };
  for (std::size_t e = 0; e < crowd.size(); ++e) ++begins_[cell_of(e)];
  std::uint32_t sum = 0;
  for (std::uint32_t& begin : begins_) sum = begin = begin + sum;
  entities_.resize(crowd.size());
  for (std::size_t e = crowd.size(); e-- > 0;)
    entities_[--begins_[cell_of(e)]] = static_cast<std::uint32_t>(e);
}

void NearOthers::find_near(std::uint32_t entity, const Crowd& crowd) {
  channels_.clear();
  const aoim::Position& place = crowd.position(entity);
  const std::size_t column = column_of(place.x), row = row_of(place.y);
  const auto before = [](std::size_t i) { return i > 0 ? i - 1 : 0; };
  for (std::size_t y = before(row); y <= std::min(row + 1, rows_ - 1); ++y) {
    // The cells of one row lie one after the other.
    const std::size_t first = y * columns_ + before(column);
    const std::size_t last = y * columns_ + std::min(column + 1, columns_ - 1);
    for (std::uint32_t i = begins_[first]; i < begins_[last + 1]; ++i)
      if (const std::uint32_t other = entities_[i]; owners_[other] != owners_[entity])
        channels_.add(crowd.position(other), 1.0, crowd.speed(other));
  }
}

std::size_t NearOthers::served_row(std::uint32_t entity, const Crowd& crowd, double slack) {
  find_near(entity, crowd);
  return channels_.served_row(crowd.position(entity), crowd.speed(entity), slack);
}

const aoim::Channel& NearOthers::channel(std::uint32_t entity, const Crowd& crowd) {
  find_near(entity, crowd);
  const aoim::Channel* channel = channels_.of(crowd.position(entity));
  return channel != nullptr ? *channel : channels_.table().channel(channels_.table().size() - 1);
}

}  // namespace reckon::bench
