// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How stiff a device shows what others move, where its energy does not allow the whole force: a
// spring that is too stiff for what the hands put in is shown softer, and its owner is informed, so
// that both ends feel the same softer spring instead of one a part and the other the whole.
#pragma once

namespace reckon::haptics {

/// Share of the stiffness that the port of one device stands for. It falls while a part of the
/// force is held back that lasts, and rises again while there is energy to spare. Each end of a
/// contact applies its own share and hears the other's with the other's stiffness: both show the
/// product.
class Softening {
 public:
  /// The softest.
  static constexpr double kLeast = 0.4;

  /// After a servo step of `dt` [s]. @param held share of the springs that was held, [0, 1]
  /// @param to_spare whether the level allows a little more than the whole force
  /// @param touching whether any such spring is
  void learn(double held, bool to_spare, bool touching, double dt) noexcept;

  /// In [kLeast, 1].
  [[nodiscard]] double share() const noexcept { return share_; }

 private:
  double lasting_ = 0.0;  // what is held back, smoothed
  double share_ = 1.0;
};

}  // namespace reckon::haptics
