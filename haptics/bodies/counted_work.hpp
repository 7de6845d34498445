// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a step of bodies by counted work. No clock is read during the run: with equal pace
// (BodyWorld::set_pace) a scene takes the same steps on each host and under each load.
#pragma once

namespace reckon::haptics {

/// Upper estimates of the seconds of the reference host, an EPYC core of 2.4 GHz.
struct CountedWork {
  static constexpr double kStep = 2e-6;      ///< of a step with any awake body
  static constexpr double kBody = 1.5e-6;    ///< of an awake body: collision, energy, sleep
  static constexpr double kDistance = 2e-6;  ///< of two bodies on the way to an impact
  static constexpr double kIsland = 8e-6;    ///< of an island that is iterated
  static constexpr double kSweep = 4.5e-8;   ///< of a contact in an iteration
  static constexpr double kContact = 1e-6;   ///< of a contact that is solved exactly
  static constexpr double kMatrix = 6e-9;    ///< times the cube of these contacts of an island

  /// Exact solution of an island.
  [[nodiscard]] static constexpr double exact(double contacts) noexcept {
    return contacts * (kContact + kMatrix * contacts * contacts);
  }
  [[nodiscard]] static constexpr double iterated(double contacts, double iterations) noexcept {
    return kIsland + kSweep * contacts * iterations;
  }
};

}  // namespace reckon::haptics
