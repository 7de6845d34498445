// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A haptic device that a program brings into an exercise.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace reckon::haptics {
class HapticDevice;
}

namespace reckon::peer {

/// A device of a peer and the hand that it moves.
struct PeerDevice {
  haptics::HapticDevice* device = nullptr;
  std::string marking;  ///< of the hand; empty: the peer's name, from the second device on with its
                        ///< number
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m], of the device's axes in S
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< v_S = q * v_D
  std::chrono::nanoseconds period{0};  ///< of its servo; 0: PeerOptions::servo_period
  double continuous_force = 0.0;       ///< [N], that its motors can hold permanently; 0: their
                                       ///< greatest
  double thermal_time = 20.0;          ///< [s] >= 1, see haptics::ServoConfig
  double max_force_rate = 0.0;  ///< [N/s], of growth and turning; 0: as haptics::ServoConfig has it
  double received_power = 0.0;  ///< [W], from others; 0: as haptics::ServoConfig has it
  /// Energy that regions may add, see haptics::ServoConfig; below 0: its default.
  double region_loan = -1.0, oscillation_power = -1.0, oscillation_energy = -1.0;
  std::uint32_t grab_button = 0;  ///< of the device, from 0: while pressed the hand holds bodies
  int stop_button = -1;           ///< of the software stop, 0 to 31; negative: none
  /// Of the tool on a device of six axes, see haptics::ServoConfig; none: the handle.
  std::vector<Eigen::Vector3d> probes{};
};

}  // namespace reckon::peer
