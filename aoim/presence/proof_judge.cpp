// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/proof_judge.hpp"

#include <algorithm>

namespace reckon::aoim {
namespace {

// Greatest number of calls of the function per second for wrong proofs from other sources, and with
// a forged source of the epoch. Proofs that are only a little ahead are checked even beyond these
// limits.
constexpr std::uint32_t kMostWrongSteps = 8192, kMostAtHome = 131'072, kAlways = 4 * kSlotLinks;

}  // namespace

Opening ProofJudge::judge(const LifeTip& tip, const pdu::Presence& heard,
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

}  // namespace reckon::aoim
