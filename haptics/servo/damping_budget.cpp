// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/damping_budget.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace reckon::haptics {
namespace {

// Water filling: whoever wants less than an equal part gets it, the rest is shared anew.
void fill(std::span<const DampingClaim> claims, double total, std::span<double> shares) {
  std::array<bool, kMaxRemoteHands> open{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    shares[i] = 0.0;
    open[i] = claims[i].wanted > 0;
    count += open[i] ? 1 : 0;
  }
  for (bool settled = false; !settled && count > 0;) {
    settled = true;
    const double part = total / static_cast<double>(count);
    for (std::size_t i = 0; i < claims.size(); ++i) {
      if (!open[i] || claims[i].wanted > part) continue;
      shares[i] = claims[i].wanted;
      total -= shares[i];
      open[i] = settled = false;
      --count;
    }
  }
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (open[i]) shares[i] = std::max(0.0, total) / static_cast<double>(count);
  }
}

}  // namespace

void share_damping(std::span<const DampingClaim> claims, double total, double step,
                   std::span<double> shares) noexcept {
  assert(claims.size() <= kMaxRemoteHands && shares.size() == claims.size());
  std::array<double, kMaxRemoteHands> room;
  const std::span<double> goal(room.data(), claims.size());
  fill(claims, total, goal);
  double left = total;
  for (std::size_t i = 0; i < claims.size(); ++i) {  // first give back
    const double least = claims[i].touching ? claims[i].held - step * total : 0.0;
    shares[i] = std::min(claims[i].held, std::max(goal[i], least));
    left -= shares[i];
  }
  for (std::size_t i = 0; i < claims.size(); ++i) {  // then take
    if (goal[i] <= shares[i] || left <= 0) continue;
    const double most = claims[i].touching ? step * total : left;
    const double rise = std::min({goal[i] - shares[i], most, left});
    shares[i] += rise;
    left -= rise;
  }
}

}  // namespace reckon::haptics
