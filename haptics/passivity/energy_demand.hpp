// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How much energy a device wants, and what it gives to others who want some.
#pragma once

namespace reckon::haptics {

/// What a device wants for its contacts, in two tiers. The first is what the whole force needs when
/// nothing of it is booked as a spring; two hands that press have just that much to share. The
/// second is what local springs need, which release as they should.
struct EnergyDemand {
  double full = 0.0;    ///< [J], first tier
  double spring = 0.0;  ///< [J], second tier
  double level = 0.0;   ///< [J], what there is

  [[nodiscard]] double need() const noexcept { return level < full ? full - level : 0.0; }
  [[nodiscard]] double surplus() const noexcept { return level - full; }
  [[nodiscard]] double spring_need() const noexcept {
    return level < spring ? spring - level : 0.0;
  }
  [[nodiscard]] double spring_surplus() const noexcept { return level - spring; }
};

/// What somebody who touches us asks for.
struct EnergyRequest {
  double need = 0.0;         ///< [J], of its first tier
  double spring_need = 0.0;  ///< [J], of its second
  double most = 0.0;         ///< [J], the most that its contact with us can want of a first tier
  double share = 0.0;        ///< [J], the most that it can be short of by what we saw of it
  bool contested = false;    ///< others ask too: whoever asks for too much gets `share`
  bool near = false;         ///< answers come soon: a shortage is shared at once, else by and by
};

/// First tier of a force of so many newtons, with something to spare. @param force [N]
/// @param spare [N/m], damping over a sample less half the slope of walls touched
[[nodiscard]] double first_tier(double force, double spare) noexcept;

/// What to give: what is beyond our own first tier, and of a shortage so much that both have the
/// same part of what they want, a fifth of that where answers come late. @return [J] >= 0
[[nodiscard]] double gift(const EnergyRequest& request, const EnergyDemand& own) noexcept;

}  // namespace reckon::haptics
