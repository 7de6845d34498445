// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/introduction.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "reckon/pdu/seconds.hpp"

namespace reckon::aoim {

Introduction::Introduction(const IntroductionConfig& config)
    : config_(config), spread_(config.spread) {
  if (config.settle.count() < 0 || config.settle > config.spread) {
    throw std::invalid_argument("introduction: settle must lie between 0 and spread");
  }
  if (config.capacity == 0) throw std::invalid_argument("introduction: capacity must be 1 or more");
  if (!(config.pace > 0.0)) throw std::invalid_argument("introduction: pace must be positive");
  windows_.reserve(config.capacity);
}

void Introduction::set_owned(std::size_t count) noexcept {
  constexpr double kLongest = 3600.0;  // [s]; whoever owns more is known by heartbeats before
  const double needed = std::min(static_cast<double>(count) / config_.pace, kLongest);
  spread_ = std::max(config_.spread, config_.settle + pdu::from_seconds(needed));
}

void Introduction::begin(GroupIndex group, std::chrono::nanoseconds now) {
  expire(now);

  // One later newcomer of the same group is served by one schedule as long as nobody was served
  // yet.
  if (!windows_.empty() && windows_.back().group == group && windows_.back().start == now) return;
  if (windows_.size() == config_.capacity) {
    // Full: the latest two share the later start, so both are served, one of them later.
    const bool same = windows_.back().group == group;
    windows_.back() = {same ? group : kBaseGroup, now, spread_};
    return;
  }
  windows_.push_back({group, now, spread_});
}

bool Introduction::is_due(const pdu::EntityId& entity, GroupIndex group,
                          std::chrono::nanoseconds last_sent,
                          std::chrono::nanoseconds now) const noexcept {
  return std::any_of(windows_.begin(), windows_.end(), [&](const Window& window) {
    const bool concerns = window.group == kBaseGroup || window.group == group;
    // Sent once the newcomer could hear it: nothing to repeat.
    const bool heard = last_sent >= window.start + config_.settle;
    return concerns && !heard && now >= window.start + delay(entity, window.spread);
  });
}

std::chrono::nanoseconds Introduction::delay(const pdu::EntityId& entity) const noexcept {
  return delay(entity, spread_);
}

std::chrono::nanoseconds Introduction::delay(const pdu::EntityId& entity,
                                             std::chrono::nanoseconds spread) const noexcept {
  constexpr std::uint64_t kSteps = 4096;
  const std::uint64_t step = std::hash<pdu::EntityId>{}(entity) % kSteps;
  const auto room = static_cast<std::uint64_t>((spread - config_.settle).count());
  return config_.settle + std::chrono::nanoseconds(step * room / (kSteps - 1));
}

// As long after the last entity's moment as at the usual spread.
std::chrono::nanoseconds Introduction::memory(const Window& window) const noexcept {
  return config_.memory + (window.spread - config_.spread);
}

void Introduction::expire(std::chrono::nanoseconds now) {
  std::erase_if(windows_,
                [&](const Window& window) { return now - window.start > memory(window); });
}

}  // namespace reckon::aoim
