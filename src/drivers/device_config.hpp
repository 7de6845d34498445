// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Configuration of a device, as [[device]] gives it: plain structs with the defaults of
// docs/scene_files.md.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "reckon/haptics/devices/motion_device.hpp"

namespace reckon::peer {

struct Driver;

/// Source of a simulated device's motion.
enum class DeviceSource : std::uint8_t {
  simulated,  ///< its operator
  pointer,    ///< a person's pointer, starting where its operator holds it
};

/// A contact point of a tool.
struct ProbeConfig {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] from the handle, in the tool's axes
};

/// A simulated device that measures the hand's force and moves like a mass.
struct AdmittanceConfig {
  double mass = 0.0;               ///< [kg], virtual mass; 0: it is not such a device
  double bandwidth = 30.0;         ///< [Hz] > 0, of its motion
  double sensor_stiffness = 20e3;  ///< [N/m] > 0, of its force sensor
  haptics::MotionLoop loop = haptics::MotionLoop::position;
};

/// Values of a device that only a descriptor gives.
struct DescribedDevice {
  std::string name;                   ///< product name; empty: the device has no descriptor
  std::chrono::nanoseconds delay{0};  ///< >= 0, until a force reaches the handle
  double mass = 0.1;                  ///< [kg] > 0
  double friction = 0.0;              ///< [N] >= 0, dry
  double inertia = 1e-4;              ///< [kg m^2] > 0, for six axes
  Eigen::AlignedBox3d work_space{Eigen::Vector3d::Constant(-0.05),
                                 Eigen::Vector3d::Constant(0.05)};  ///< [m], frame D
};

/// What a device can show, and what the servo relies on: from a descriptor or from [[device]].
struct DeviceAbility {
  int axes = 3;                   ///< 3, or 6: it turns and shows torque
  double max_force = 10.0;        ///< [N] > 0
  double continuous_force = 0.0;  ///< [N], permanent limit of its motors; 0: max_force
  double thermal_time = 20.0;     ///< [s] >= 1, time constant of their warming
  double damping = 1.0;           ///< [N s/m] >= 0, guaranteed physical damping
  double joint_damping = 0.0;     ///< [N m s/rad] >= 0, of each joint; 0: not given
  double max_stiffness = 0.0;     ///< [N/m]; 0: the limit by its damping
  double max_speed = 2.0;         ///< [m/s] > 0; a faster reading switches the force off
  double max_torque = 1.0;        ///< [N m] > 0
  double turn_damping = 0.01;     ///< [N m s/rad] > 0, guaranteed, about each axis
  double turn_resolution = 0.0;   ///< [rad] >= 0, step of its angle sensors; 0: exact
  double resolution = 0.0;        ///< [m] >= 0, step of its position sensors; 0: exact
};

/// The value of a key that one driver has; a file is a path, absolute once loaded.
using DriverValue = std::variant<double, std::uint32_t, std::string, std::filesystem::path>;

/// Energy that regions may put into a hand.
struct RegionEnergyConfig {
  double loan = 0.12;                ///< [J] >= 0, greatest loan for potentials
  double oscillation_power = 0.1;    ///< [W] >= 0, power of oscillations
  double oscillation_energy = 0.02;  ///< [J] >= 0, limit of oscillations at once
};

struct DeviceConfig : DeviceAbility {
  std::uint32_t peer = 1;             ///< number of its peer, from 1
  std::uint32_t operator_number = 1;  ///< number of the [[operator]] that holds it, from 1
  DeviceSource source = DeviceSource::simulated;
  const Driver* driver = nullptr;  ///< of a real device; null: it is simulated
  /// By DriverKey::key, of any driver; an absent one has its default. See driver_value().
  std::map<std::string_view, DriverValue> driver_values;
  std::string descriptor;     ///< file or name; absolute once loaded; empty: none
  DescribedDevice described;  ///< values of the descriptor without a member in DeviceAbility
  double scale = 1.0;         ///< > 0, motion of the hand in S per motion of the handle
  bool left_handed = false;   ///< left and right are exchanged
  int clutch_button = -1;     ///< while it is pressed the hand does not move; negative: none
  AdmittanceConfig admittance;
  double reach = 0.5;   ///< [m] > 0, of a pointer from the start, along each of the device's axes
  std::string marking;  ///< of its hand; empty: the peer's name and a number
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] S, of the device's own origin
  bool is_placed = false;                              ///< the file gives its position
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< device axes to S
  std::vector<ProbeConfig> probes;  ///< of the tool on six axes; none: the handle
  /// [N/s], limit of the rate of its force in size and direction; 0: as in haptics::ServoConfig.
  double max_force_rate = 0.0;
  double received_power = 0.2;  ///< [W] > 0, largest average power that others put into its hand
  RegionEnergyConfig regions;
  int stop_button = -1;           ///< button that stops all forces, 0 to 31; negative: none
  std::uint32_t grab_button = 0;  ///< of the device, from 0: the hand holds bodies while it is
                                  ///< pressed
  int delay_samples = 0;  ///< servo periods between a write and the force at the handle, >= 0
  std::chrono::nanoseconds period = std::chrono::milliseconds(1);  ///< of its servo, 0.1 .. 10 ms
};

}  // namespace reckon::peer
