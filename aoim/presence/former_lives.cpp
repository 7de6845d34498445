// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/former_lives.hpp"

#include <algorithm>

namespace reckon::aoim {

FormerLife* FormerLives::find(std::uint32_t epoch) noexcept {
  const auto life = std::ranges::find(lives_, epoch, &FormerLife::epoch);
  return life == lives_.end() ? nullptr : &*life;
}

bool FormerLives::contains(std::uint32_t epoch) const noexcept {
  return std::ranges::find(lives_, epoch, &FormerLife::epoch) != lives_.end();
}

void FormerLives::add(const FormerLife& life) {
  const auto worth = [](const FormerLife& one) {
    const bool returns = one.tip.is_chained() && !one.said_goodbye;
    return returns ? one.last_heard - one.known_since : std::chrono::nanoseconds(0);
  };
  take(life.epoch);
  if (lives_.size() == kMost) lives_.erase(std::ranges::min_element(lives_, {}, worth));
  lives_.push_back(life);
}

std::optional<FormerLife> FormerLives::take(std::uint32_t epoch) noexcept {
  const auto life = std::ranges::find(lives_, epoch, &FormerLife::epoch);
  if (life == lives_.end()) return {};
  const FormerLife known = *life;
  lives_.erase(life);
  return known;
}

}  // namespace reckon::aoim
