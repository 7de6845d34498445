// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/damping_budget.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

using Shares = std::array<double, kMaxRemoteHands>;

// Water filling: whoever wants less than an equal part gets it, the rest is shared anew.
Shares fill(std::span<const DampingClaim, kMaxRemoteHands> claims, double total) {
  Shares shares{};
  std::array<bool, kMaxRemoteHands> open{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < kMaxRemoteHands; ++i) {
    open[i] = claims[i].present && claims[i].wanted > 0;
    count += open[i] ? 1 : 0;
  }
  for (bool settled = false; !settled && count > 0;) {
    settled = true;
    const double part = total / static_cast<double>(count);
    for (std::size_t i = 0; i < kMaxRemoteHands; ++i) {
      if (!open[i] || claims[i].wanted > part) continue;
      shares[i] = claims[i].wanted;
      total -= shares[i];
      open[i] = settled = false;
      --count;
    }
  }
  for (std::size_t i = 0; i < kMaxRemoteHands; ++i) {
    if (open[i]) shares[i] = std::max(0.0, total) / static_cast<double>(count);
  }
  return shares;
}

}  // namespace

std::array<double, kMaxRemoteHands> share_damping(
    std::span<const DampingClaim, kMaxRemoteHands> claims, double total, double step) noexcept {
  const Shares goal = fill(claims, total);
  Shares shares{};
  double left = total;
  for (std::size_t i = 0; i < kMaxRemoteHands; ++i) {  // first give back
    if (!claims[i].present) continue;
    const double least = claims[i].touching ? claims[i].held - step * total : 0.0;
    shares[i] = std::min(claims[i].held, std::max(goal[i], least));
    left -= shares[i];
  }
  for (std::size_t i = 0; i < kMaxRemoteHands; ++i) {  // then take
    if (!claims[i].present || goal[i] <= shares[i] || left <= 0) continue;
    const double most = claims[i].touching ? step * total : left;
    const double rise = std::min({goal[i] - shares[i], most, left});
    shares[i] += rise;
    left -= rise;
  }
  return shares;
}

}  // namespace reckon::haptics
