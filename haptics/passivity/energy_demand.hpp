// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy demand of a device, and its gifts to others that request energy.
#pragma once

namespace reckon::haptics {

/// Demand of a device for its contacts, in two tiers. The first is the need of the whole force if
/// no part of it is booked as a spring. Two hands that press each other share just that amount. The
/// second is the need of local springs that release normally.
struct EnergyDemand {
  double full = 0.0;    ///< [J], first tier
  double spring = 0.0;  ///< [J], second tier
  double level = 0.0;   ///< [J], present energy

  [[nodiscard]] double need() const noexcept { return level < full ? full - level : 0.0; }
  [[nodiscard]] double surplus() const noexcept { return level - full; }
  [[nodiscard]] double spring_need() const noexcept {
    return level < spring ? spring - level : 0.0;
  }
  [[nodiscard]] double spring_surplus() const noexcept { return level - spring; }
};

/// Request of a neighbour that touches us.
struct EnergyRequest {
  double need = 0.0;         ///< [J], lack in its first tier
  double spring_need = 0.0;  ///< [J], lack in its second tier
  double most = 0.0;         ///< [J], greatest first tier of its contact with us
  double share = 0.0;        ///< [J], greatest lack by our own observation
  bool contested = false;    ///< others request too: an excessive request gets `share`
  bool near = false;         ///< answers arrive soon: a shortage is shared at once, else gradually
};

/// First tier of a force, with a margin. @param force [N]
/// @param spare [N/m], damping over a sample less half the slope of touched walls
[[nodiscard]] double first_tier(double force, double spare) noexcept;

/// Energy to give: the surplus beyond our own first tier. In a shortage it is the amount that gives
/// both sides the same share of their needs, or a fifth of it if answers come late. @return [J] >=
/// 0
[[nodiscard]] double gift(const EnergyRequest& request, const EnergyDemand& own) noexcept;

}  // namespace reckon::haptics
