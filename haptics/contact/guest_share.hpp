// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a hand feels of guests, bodies of plain DIS programs, beside other hands. A guest has no
// energy to give: else its spring would take that of the hands, and part them for seconds.
#pragma once

#include <span>

#include "reckon/haptics/contact/remote_contact.hpp"

namespace reckon::haptics {

/// Share of the guests' springs beside hands. One thread, no allocation, linear in the contacts.
class GuestShare {
 public:
  /// For so long [s] after guests and hands have touched the device together, the energy that hands
  /// lack counts as taken by guests.
  static constexpr double kOver = 2.0;

  /// Before the load of a servo step: the share becomes the largest in [0, 1] that the energy of
  /// the port pays for after the hands and what their springs store. It rises within
  /// RemoteContact::kRamp. Without hands it is 1.
  /// @param spare [N/m], of the port at the probe  @param level [J], of the port  @param dt [s]
  void make_room(std::span<RemoteContact* const> near, double spare, double level,
                 double dt) noexcept;

  /// 1 for a hand and a body of a peer.
  [[nodiscard]] double share_of(const RemoteContact& remote) const noexcept {
    return remote.is_guest() ? share_ : 1.0;
  }
  [[nodiscard]] double share() const noexcept { return share_; }  ///< of guests
  [[nodiscard]] bool pressed_lately() const noexcept { return left_ > 0; }

 private:
  double share_ = 1.0;
  double left_ = 0.0;  // [s], of kOver
};

}  // namespace reckon::haptics
