// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/introduction.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace reckon::aoim {

Introduction::Introduction(const IntroductionConfig& config) : config_(config) {
  if (config.settle.count() < 0 || config.settle > config.spread) {
    throw std::invalid_argument("introduction: settle must lie between 0 and spread");
  }
  if (config.capacity == 0) throw std::invalid_argument("introduction: capacity must be 1 or more");
  windows_.reserve(config.capacity);
}

void Introduction::begin(GroupIndex group, std::chrono::nanoseconds now) {
  expire(now);

  // One later newcomer of the same group is served by one schedule as long as nobody was served
  // yet.
  if (!windows_.empty() && windows_.back().group == group && windows_.back().start == now) return;
  if (windows_.size() == config_.capacity) {
    // Full: the latest two share the later start, so both are served, one of them later.
    const bool same = windows_.back().group == group;
    windows_.back() = {same ? group : kBaseGroup, now};
    return;
  }
  windows_.push_back({group, now});
}

bool Introduction::is_due(const pdu::EntityId& entity, GroupIndex group,
                          std::chrono::nanoseconds last_sent,
                          std::chrono::nanoseconds now) const noexcept {
  const std::chrono::nanoseconds wait = delay(entity);
  return std::any_of(windows_.begin(), windows_.end(), [&](const Window& window) {
    const bool concerns = window.group == kBaseGroup || window.group == group;
    // Sent once the newcomer could hear it: nothing to repeat.
    const bool heard = last_sent >= window.start + config_.settle;
    return concerns && !heard && now >= window.start + wait;
  });
}

std::chrono::nanoseconds Introduction::delay(const pdu::EntityId& entity) const noexcept {
  constexpr std::uint64_t kSteps = 4096;
  const std::uint64_t step = std::hash<pdu::EntityId>{}(entity) % kSteps;
  const auto room = static_cast<std::uint64_t>((config_.spread - config_.settle).count());
  return config_.settle + std::chrono::nanoseconds(step * room / (kSteps - 1));
}

void Introduction::expire(std::chrono::nanoseconds now) {
  std::erase_if(windows_,
                [&](const Window& window) { return now - window.start > config_.memory; });
}

}  // namespace reckon::aoim
