// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Share of the force of guests, bodies of plain DIS programs, beside other hands. A guest has no
// energy to give, so its spring would take the energy of the hands and separate them for seconds.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "reckon/haptics/contact/remote_contact.hpp"

namespace reckon::haptics {

/// Share of the guests' springs beside hands. One thread, no allocation, linear in the contacts.
class GuestShare {
 public:
  /// Time after a joint contact of guests and hands [s] in which a lack of energy for hands counts
  /// as taken by guests.
  static constexpr double kOver = 2.0;

  /// Call before the load of a servo step. Sets the largest share in [0, 1] that the port's energy
  /// pays for after the hands and the storage of their springs. It rises within
  /// RemoteContact::kRamp; without hands it is 1.
  /// @param spare [N/m], of the port at the probe  @param level [J], of the port  @param dt [s]
  void make_room(std::span<RemoteContact* const> near, double spare, double level,
                 double dt) noexcept {
    Eigen::Vector3d hands = Eigen::Vector3d::Zero(), guests = Eigen::Vector3d::Zero();
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

  /// Share of a contact; 1 for a hand or body of a peer.
  [[nodiscard]] double share_of(const RemoteContact& remote) const noexcept {
    return remote.is_guest() ? share_ : 1.0;
  }
  [[nodiscard]] double share() const noexcept { return share_; }  ///< of guests
  [[nodiscard]] bool pressed_lately() const noexcept { return left_ > 0; }

 private:
  // Largest b in [0, 1] with |held + b more|^2 <= most; 0 if there is none.
  static double share_within(const Eigen::Vector3d& held, const Eigen::Vector3d& more,
                             double most) noexcept {
    const double room = most - held.squaredNorm();
    if (!(room > 0)) return 0.0;
    const double square = more.squaredNorm(), along = held.dot(more);
    return std::clamp((std::sqrt(along * along + square * room) - along) / square, 0.0, 1.0);
  }

  double share_ = 1.0;
  double left_ = 0.0;  // [s], remaining time of kOver
};

}  // namespace reckon::haptics
