// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/former_lives.hpp"

#include <algorithm>

namespace reckon::aoim {
namespace {

// An epoch that was considered ended but sends after this time is alive.
constexpr std::chrono::milliseconds kRevival{1000};

}  // namespace

FormerLife* FormerLives::find(std::uint32_t epoch) noexcept {
  const auto life = std::ranges::find(lives_, epoch, &FormerLife::epoch);
  return life == lives_.end() ? nullptr : &*life;
}

bool FormerLives::contains(std::uint32_t epoch) const noexcept {
  return std::ranges::find(lives_, epoch, &FormerLife::epoch) != lives_.end();
}

bool FormerLives::is_over(const pdu::Presence& heard, std::chrono::nanoseconds now,
                          const SourceAddress& from, ProofJudge& proofs,
                          std::chrono::nanoseconds pin) noexcept {
  FormerLife* life = find(heard.epoch);
  if (life == nullptr) return false;
  if (life->tip.is_chained()) {
    if (proofs.judge(life->tip, heard, now, false) != Opening::newer) return true;
    life->tip = LifeTip(heard, now);  // remembered as one that returned
    return false;
  }
  const bool from_elsewhere =
      life->source.port != 0 && life->source != from && true;
  const bool is_straggler = heard.simulation == life->id && now - life->since <= kRevival;
  if (from_elsewhere || is_straggler) return true;
  take(heard.epoch);
  return false;
}

void FormerLives::add(const FormerLife& life) {
  const auto worth = [](const FormerLife& one) {
    const bool returns = one.tip.is_chained() && !one.has_announced_end;
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
