// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Softening of a spring that others move, while the energy of the device does not allow the whole
// force. A spring too stiff for the energy of the hands is shown softer, and its owner is informed.
// Then both ends feel the same softer spring, instead of a part at one end and the whole at the
// other.
#pragma once

#include <algorithm>

namespace reckon::haptics {

/// Share of the stiffness that the port of one device can supply. It falls while part of the force
/// is held back for long, and rises again while there is surplus energy. Each end of a contact
/// applies its own share, and receives the other's with the other's stiffness: both show the
/// product.
class Softening {
 public:
  /// Lower limit of the share.
  static constexpr double kLeast = 0.4;

  /// Updates the share after a servo step of `dt` [s]. @param held share of the springs that was
  /// held, [0, 1]
  /// @param to_spare whether the level allows a little more than the whole force
  /// @param touching whether any such spring is touched
  void learn(double held, bool to_spare, bool touching, double dt) noexcept {
    const double back = touching ? 1.0 - held : 0.0;
    lasting_ += std::min(1.0, dt / kLasting) * (back - lasting_);
    const double felt = std::min(lasting_, back);
    if (!touching) {
      share_ += kFastest * dt;
    } else if (felt > kNoticed) {
      share_ -= std::min(kFastest, kFall * felt) * dt;
    } else if (to_spare) {
      share_ += kRise * dt;
    }
    share_ = std::clamp(share_, kLeast, 1.0);
  }

  /// The share, in [kLeast, 1].
  [[nodiscard]] double share() const noexcept { return share_; }

 private:
  static constexpr double kLasting = 0.1;   // [s], smoothing of the force held back
  static constexpr double kNoticed = 0.02;  // of the force; a smaller lack is not felt
  static constexpr double kFall = 3.0;      // [1/s], for each unit of force held back
  static constexpr double kFastest = 1.0;   // [1/s]
  static constexpr double kRise = 0.3;      // [1/s]

  double lasting_ = 0.0;  // smoothed share of the force held back
  double share_ = 1.0;
};

}  // namespace reckon::haptics
