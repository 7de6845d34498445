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
  if (config.capacity < 2) throw std::invalid_argument("introduction: capacity must be 2 or more");
  if (config.pool > kMaximumPool) {
    throw std::invalid_argument("introduction: the pool is too large");
  }
  if (!(config.pace > 0.0)) throw std::invalid_argument("introduction: pace must be positive");
  lanes_.resize(config.pool + 1);
  for (Lane& lane : lanes_) lane.reserve(config.capacity);
  active_.reserve(lanes_.size());
}

void Introduction::set_owned(std::size_t count) noexcept {
  constexpr double kLongest = 3600.0;  // [s]; heartbeats introduce larger owners before
  const double needed = std::min(static_cast<double>(count) / config_.pace, kLongest);
  spread_ = std::max(config_.spread, config_.settle + pdu::from_seconds(needed));
}

void Introduction::begin(GroupIndex group, std::chrono::nanoseconds now) {
  expire(now);
  const std::chrono::nanoseconds length = spread_ - config_.settle;
  if (active_.empty() || round_.length != length) round_ = {now + config_.settle, length};

  Lane& lane = lanes_[group.value];
  if (lane.empty()) active_.push_back(group.value);
  add(lane, {now, round_});
}

void Introduction::add(Lane& lane, const Window& window) const {
  if (!lane.empty() && lane.back().start == window.start) return;
  if (lane.size() == config_.capacity) {
    const auto apart = config_.memory / static_cast<std::int64_t>(config_.capacity);
    const bool is_near = lane.back().start - lane[lane.size() - 2].start < apart;
    // Newcomers of the erased window share the next later one. It is one of the two latest if they
    // are close, else the oldest, whose newcomers have received all but the entities without
    // requests.
    lane.erase(is_near ? lane.end() - 1 : lane.begin());
  }
  lane.push_back(window);
}

bool Introduction::is_due(const pdu::EntityId& entity, GroupIndex group,
                          std::chrono::nanoseconds last_sent,
                          std::chrono::nanoseconds now) const noexcept {
  return group != kBaseGroup && is_due(entity, lanes_[group.value], last_sent, now);
}

bool Introduction::is_due(const pdu::EntityId& entity, const Lane& lane,
                          std::chrono::nanoseconds last_sent,
                          std::chrono::nanoseconds now) const noexcept {
  return std::any_of(lane.begin(), lane.end(), [&](const Window& window) {
    // Sent after the newcomer could receive it: nothing to repeat.
    const bool heard = last_sent >= window.start + config_.settle;
    return !heard && now >= moment(entity, window);
  });
}

std::chrono::nanoseconds Introduction::delay(const pdu::EntityId& entity) const noexcept {
  return config_.settle + place(entity, spread_ - config_.settle);
}

// Position of an entity's moment in a round of this length.
std::chrono::nanoseconds Introduction::place(const pdu::EntityId& entity,
                                             std::chrono::nanoseconds length) const noexcept {
  constexpr std::uint64_t kSteps = 4096;
  const std::uint64_t step = std::hash<pdu::EntityId>{}(entity) % kSteps;
  const auto room = static_cast<std::uint64_t>(length.count());
  return std::chrono::nanoseconds(step * room / (kSteps - 1));
}

// The first moment of the entity at which the newcomer receives it.
std::chrono::nanoseconds Introduction::moment(const pdu::EntityId& entity,
                                              const Window& window) const noexcept {
  const std::chrono::nanoseconds first = window.round.begin + place(entity, window.round.length);
  const std::chrono::nanoseconds late = window.start + config_.settle - first;
  if (late.count() <= 0 || window.round.length.count() == 0) return first + std::max(late, {});
  const auto rounds =
      (late + window.round.length - std::chrono::nanoseconds(1)) / window.round.length;
  return first + rounds * window.round.length;
}

// As long after the last entity's moment as with the usual spread.
std::chrono::nanoseconds Introduction::memory(const Window& window) const noexcept {
  return config_.memory + (window.round.length + config_.settle - config_.spread);
}

void Introduction::expire(std::chrono::nanoseconds now) {
  std::erase_if(active_, [&](std::uint16_t group) {
    Lane& lane = lanes_[group];
    std::erase_if(lane, [&](const Window& window) { return now - window.start > memory(window); });
    return lane.empty();
  });
}

}  // namespace reckon::aoim
