// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/receiver_channels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reckon::aoim {
namespace {

constexpr double kNobody = std::numeric_limits<double>::infinity();

}  // namespace

void ReceiverChannels::add(const Position& position, double stretch, double speed) {
  if (!is_finite(position) || !(stretch >= 1.0)) return;
  receivers_.push_back({position, stretch * stretch, speed >= 0.0 ? speed : 0.0});
}

ReceiverChannels::Nearest ReceiverChannels::find(const Position& position) const noexcept {
  Nearest nearest{kNobody, kNobody};
  for (const Receiver& receiver : receivers_) {
    const double x = receiver.position.x - position.x, y = receiver.position.y - position.y,
                 z = receiver.position.z - position.z;
    const double squared = x * x + y * y + z * z;
    nearest.squared = std::min(nearest.squared, squared);
    nearest.stretched_squared =
        std::min(nearest.stretched_squared, squared * receiver.stretch_squared);
  }
  return nearest;
}

const Channel* ReceiverChannels::of(const Position& position) const noexcept {
  if (receivers_.empty()) return &table_.channel(table_.size() - 1);
  const Nearest nearest = find(position);
  const std::size_t plain = table_.row(std::sqrt(nearest.squared));
  const bool is_kept = plain < table_.size() && table_.channel(plain).kept;
  const std::size_t row = is_kept ? plain : table_.row(std::sqrt(nearest.stretched_squared));
  return row < table_.size() ? &table_.channel(row) : nullptr;
}

std::size_t ReceiverChannels::served_row(const Position& position, double speed,
                                         double slack) const noexcept {
  const double ahead = kNearAhead * speed + slack;
  double nearest = kNobody;
  for (const Receiver& receiver : receivers_) {
    const double least = ahead + kNearAhead * receiver.speed;
    const double away = std::max(0.0, distance(receiver.position, position) - least);
    nearest = std::min(nearest, away * std::sqrt(receiver.stretch_squared) / kNearLeave);
  }
  const std::size_t row = std::min(table_.row(nearest), table_.size() - 1);
  return row > table_.kept_rows() ? row - table_.kept_rows() : 0;
}

double ReceiverChannels::nearest(const Position& position) const noexcept {
  return std::sqrt(find(position).squared);
}

}  // namespace reckon::aoim
