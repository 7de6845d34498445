// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Configuration of a peer before it starts: plain structs with the defaults of docs/scene_files.md.
// scene_file.hpp fills them; nothing here changes while a peer runs.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reckon/haptics/devices/motion_device.hpp"
#include "reckon/peer/network/impairment.hpp"
#include "reckon/peer/settings/aoim_config.hpp"
#include "reckon/peer/settings/convergence_config.hpp"
#include "reckon/peer/settings/dead_reckoning_config.hpp"
#include "reckon/peer/settings/entity_config.hpp"
#include "reckon/peer/settings/hand_config.hpp"
#include "reckon/peer/settings/network_config.hpp"

namespace reckon::peer {

/// Source of a simulated device's motion.
enum class DeviceSource : std::uint8_t {
  simulated,  ///< its operator
  pointer,    ///< a person's pointer, starting where its operator holds it
};

/// Kind of a device.
enum class DeviceDriver : std::uint8_t {
  simulated,  ///< a simulated mass that its operator holds
  falcon,     ///< a Novint Falcon on USB, held by a person
  polhem,     ///< a Polhem on USB, held by a person
  serial,     ///< a board on a serial port, held by a person
  evdev,      ///< a Linux force feedback device, held by a person
  plugin,     ///< a device driven by a shared library
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

/// A haptic device of one peer, and the hand that it moves.
struct DeviceConfig {
  std::uint32_t peer = 1;             ///< number of its peer, from 1
  std::uint32_t operator_number = 1;  ///< number of the [[operator]] that holds it, from 1
  DeviceSource source = DeviceSource::simulated;
  DeviceDriver driver = DeviceDriver::simulated;
  std::filesystem::path firmware;  ///< of a Falcon; absolute once loaded; empty: none is loaded
  std::string descriptor;          ///< file or name; absolute once loaded; empty: none
  DescribedDevice described;       ///< values of the descriptor without a member below
  double scale = 1.0;              ///< > 0, motion of the hand in S per motion of the handle
  bool left_handed = false;        ///< left and right are exchanged
  int clutch_button = -1;          ///< while it is pressed the hand does not move; negative: none
  double upper_weight = 0.0;       ///< [N m] >= 0, of a Polhem's upper link when level
  double fore_weight = 0.0;        ///< [N m] >= 0, of its fore link when level
  std::string port;                ///< of a serial board, such as /dev/ttyACM0
  std::uint32_t baud = 1'000'000;  ///< of that port
  std::string event;               ///< of an event device: its path, or a part of its name
  int event_axes = 2;              ///< of an event device: 1 or 2
  double travel = 0.0;             ///< [m], of an event device, from end to end of an axis; 0: not
                                   ///< given
  double full_force = 0.0;         ///< [N], of an event device at its greatest level; 0: not given
  double full_stiffness = 0.0;     ///< [N/m], of its greatest coefficient; 0: not given
  std::filesystem::path plugin;    ///< shared library of its driver, as in the scene
  std::string plugin_options;      ///< for that driver
  AdmittanceConfig admittance;
  double reach = 0.5;   ///< [m] > 0, of a pointer from the start, along each of the device's axes
  std::string marking;  ///< of its hand; empty: the peer's name and a number
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] S, of the device's own origin
  bool is_placed = false;                              ///< the file gives its position
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< device axes to S
  double max_force = 10.0;                                          ///< [N] > 0
  double continuous_force = 0.0;    ///< [N], permanent limit of its motors; 0: max_force
  double thermal_time = 20.0;       ///< [s] >= 1, time constant of their warming
  double damping = 1.0;             ///< [N s/m] >= 0, guaranteed physical damping
  double joint_damping = 0.0;       ///< [N m s/rad] >= 0, of a Falcon or Polhem; 0: not given
  double max_stiffness = 0.0;       ///< [N/m]; 0: the limit by its damping
  int axes = 3;                     ///< 3, or 6: it turns and shows torque
  double turn_damping = 0.01;       ///< [N m s/rad] > 0, guaranteed, about each axis
  double max_torque = 1.0;          ///< [N m] > 0
  double turn_resolution = 0.0;     ///< [rad] >= 0, step of its angle sensors; 0: exact
  std::vector<ProbeConfig> probes;  ///< of the tool on six axes; none: the handle
  double max_speed = 2.0;           ///< [m/s] > 0; a faster reading switches the force off
  /// [N/s], limit of the rate of its force in size and direction; 0: as in haptics::ServoConfig.
  double max_force_rate = 0.0;
  double received_power = 0.2;     ///< [W] > 0, largest average power that others put into its hand
  double region_loan = 0.12;       ///< [J] >= 0, greatest loan for potentials of regions
  double oscillation_power = 0.1;  ///< [W] >= 0, power of oscillations of regions into its hand
  double oscillation_energy = 0.02;  ///< [J] >= 0, their limit at once
  int stop_button = -1;              ///< button that stops all forces, 0 to 31; negative: none
  std::uint32_t grab_button = 0;     ///< of the device, from 0: the hand holds bodies while it is
                                     ///< pressed
  double resolution = 0.0;           ///< [m] >= 0, step of its position sensors; 0: exact
  int delay_samples = 0;  ///< servo periods between a write and the force at the handle, >= 0
  std::chrono::nanoseconds period = std::chrono::milliseconds(1);  ///< of its servo, 0.1 .. 10 ms
};

}  // namespace reckon::peer
