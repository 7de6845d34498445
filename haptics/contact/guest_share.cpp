// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/guest_share.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

// Largest b in [0, 1] with |held + b more|^2 <= most; 0 if there is none.
double share_within(const Vector3d& held, const Vector3d& more, double most) noexcept {
  const double room = most - held.squaredNorm();
  if (!(room > 0)) return 0.0;
  const double square = more.squaredNorm(), along = held.dot(more);
  return std::clamp((std::sqrt(along * along + square * room) - along) / square, 0.0, 1.0);
}

}  // namespace

void GuestShare::make_room(std::span<RemoteContact* const> near, double spare, double level,
                           double dt) noexcept {
  Vector3d hands = Vector3d::Zero(), guests = Vector3d::Zero();
  double stored = 0.0;  // [J], in the springs of hands
  for (const RemoteContact* remote : near) {
    if (!remote->touching()) continue;
    (remote->is_guest() ? guests : hands) += remote->spring().force();
    if (!remote->is_guest()) stored += remote->spring().stored();
  }
  const bool both = !hands.isZero(0.0) && !guests.isZero(0.0);
  double goal = 1.0;
  if (both) {
    const double energy = std::max(0.0, level - stored);
    goal = share_within(hands, guests, 4 * std::max(0.0, spare) * energy);
  }
  left_ = both ? kOver : std::max(0.0, left_ - dt);
  share_ = std::min(goal, share_ + dt / RemoteContact::kRamp);
}

}  // namespace reckon::haptics
