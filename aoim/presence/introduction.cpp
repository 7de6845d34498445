// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/introduction.hpp"

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
  const std::chrono::nanoseconds length = spread_ - config_.settle;
  if (windows_.empty() || round_.length != length) round_ = {now + config_.settle, length};

  // One later newcomer of the same group is served by one schedule as long as nobody was served
  // yet.
  if (!windows_.empty() && windows_.back().group == group && windows_.back().start == now) return;
  if (windows_.size() == config_.capacity) {
    // Full: the latest two share the later start, so both are served, one of them later.
    const bool same = windows_.back().group == group;
    windows_.back() = {same ? group : kBaseGroup, now, round_};
    return;
  }
  windows_.push_back({group, now, round_});
}

bool Introduction::is_due(const pdu::EntityId& entity, GroupIndex group,
                          std::chrono::nanoseconds last_sent,
                          std::chrono::nanoseconds now) const noexcept {
  return std::any_of(windows_.begin(), windows_.end(), [&](const Window& window) {
    const bool concerns = window.group == kBaseGroup || window.group == group;
    // Sent once the newcomer could hear it: nothing to repeat.
    const bool heard = last_sent >= window.start + config_.settle;
    return concerns && !heard && now >= moment(entity, window);
  });
}

std::chrono::nanoseconds Introduction::delay(const pdu::EntityId& entity) const noexcept {
  return config_.settle + place(entity, spread_ - config_.settle);
}

// Where in a round of this length an entity has its moment.
std::chrono::nanoseconds Introduction::place(const pdu::EntityId& entity,
                                             std::chrono::nanoseconds length) const noexcept {
  constexpr std::uint64_t kSteps = 4096;
  const std::uint64_t step = std::hash<pdu::EntityId>{}(entity) % kSteps;
  const auto room = static_cast<std::uint64_t>(length.count());
  return std::chrono::nanoseconds(step * room / (kSteps - 1));
}

// The first moment of the entity at which the newcomer hears it.
std::chrono::nanoseconds Introduction::moment(const pdu::EntityId& entity,
                                              const Window& window) const noexcept {
  const std::chrono::nanoseconds first = window.round.begin + place(entity, window.round.length);
  const std::chrono::nanoseconds late = window.start + config_.settle - first;
  if (late.count() <= 0 || window.round.length.count() == 0) return first + std::max(late, {});
  const auto rounds =
      (late + window.round.length - std::chrono::nanoseconds(1)) / window.round.length;
  return first + rounds * window.round.length;
}

// As long after the last entity's moment as at the usual spread.
std::chrono::nanoseconds Introduction::memory(const Window& window) const noexcept {
  return config_.memory + (window.round.length + config_.settle - config_.spread);
}

void Introduction::expire(std::chrono::nanoseconds now) {
  std::erase_if(windows_,
                [&](const Window& window) { return now - window.start > memory(window); });
}

}  // namespace reckon::aoim
