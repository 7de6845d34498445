// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Judges the proofs of announcements, and bounds the cost of wrong ones from other sources.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "reckon/aoim/presence/life_chain.hpp"

namespace reckon::aoim {

/// One thread; allocates nothing. See LifeTip::judge.
class ProofJudge {
 public:
  /// @param one_way null: no proofs
  explicit ProofJudge(OneWay one_way) noexcept : one_way_(one_way) {}

  /// @param tip of the epoch in `heard`  @param at_home whether it came from the source of that
  /// epoch: such a proof is judged after many more wrong ones
  [[nodiscard]] Opening judge(const LifeTip& tip, const pdu::Presence& heard,
                              std::chrono::nanoseconds now, bool at_home) noexcept {
    if (now - wrong_since_ >= std::chrono::seconds(1)) {
      wrong_since_ = now;
      wrong_steps_ = 0;
    }
    const bool is_tired = wrong_steps_ >= (at_home ? kMostAtHome : kMostWrongSteps);
    const std::uint32_t most = is_tired ? kAlways : tip.farthest(now);
    const Opening opening = tip.judge(heard, one_way_, most);
    if (opening == Opening::wrong && !is_tired) wrong_steps_ += std::min(most, kChainLength);
    return opening;
  }

 private:
  // Greatest number of calls of the function per second for wrong proofs from other sources, and
  // with a forged source of the epoch. Proofs that are only a little ahead are checked even beyond
  // these limits.
  static constexpr std::uint32_t kMostWrongSteps = 8192, kMostAtHome = 131'072,
                                 kAlways = 4 * kSlotLinks;

  OneWay one_way_;
  std::chrono::nanoseconds wrong_since_ = std::chrono::nanoseconds::min() / 2;
  std::uint32_t wrong_steps_ = 0;  // calls of the function for wrong proofs, since then
};

}  // namespace reckon::aoim
