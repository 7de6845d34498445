// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Simulates an admittance device and the hand that holds it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/haptics/devices/motion_device.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::haptics {

struct SimulatedMotionConfig {
  MotionLoop loop = MotionLoop::position;
  double bandwidth = 30.0;         ///< [Hz] > 0, of its motion loop
  double mass = 5.0;               ///< [kg] > 0, moved by its motors
  double sensor_stiffness = 20e3;  ///< [N/m] > 0, of the force sensor between hand and handle
  double sensor_damping = 20.0;    ///< [N s/m] > 0
  double hand_mass = 0.2;          ///< [kg] > 0
  double hand_stiffness = 200.0;   ///< [N/m] >= 0, the hand's spring to its target
  double hand_damping = 3.0;       ///< [N s/m] >= 0
  double max_force = 10.0;         ///< [N] > 0, greatest measurable force
  double max_speed = 1.0;          ///< [m/s] > 0
  int delay_samples = 0;           ///< number of commands until one takes effect, 0 .. kMostDelay
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< [m], frame D
  Eigen::AlignedBox3d workspace{Eigen::Vector3d::Constant(-0.05), Eigen::Vector3d::Constant(0.05)};
};

/// For each axis: a mass that motors move as commanded, and a hand with mass that holds it through
/// a stiff sensor and follows a HandScript. Without a command for HapticDevice::kWatchdog it
/// brakes. The plant runs semi-implicit steps of 50 us or less. Its energy book is exact for these
/// steps and covers everything that a hand can feel.
class SimulatedMotion final : public MotionDevice {
 public:
  static constexpr int kMostDelay = 100;  ///< [samples]

  /// @throws std::invalid_argument for values out of range.
  explicit SimulatedMotion(const SimulatedMotionConfig& config, HandScript script = {});

  [[nodiscard]] MotionLimits limits() const noexcept override;
  /// Runs the plant from the last read to `now`; at most 1 s at once.
  [[nodiscard]] MotionSample read(std::chrono::nanoseconds now) noexcept override;
  void command(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
               std::chrono::nanoseconds now) noexcept override;

  void enable(bool held) noexcept { enabled_ = held; }
  /// While false, reads fail and it brakes.
  void plug(bool in) noexcept { plugged_ = in; }

  [[nodiscard]] const Eigen::Vector3d& position() const noexcept { return position_; }
  [[nodiscard]] const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  /// Force of the hand on the handle [N].
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }
  /// Work of the hand on the handle since the start [J]; >= 0 for a passive device.
  [[nodiscard]] double handle_work() const noexcept { return handle_work_; }

 private:
  struct Command {
    Eigen::Vector3d position, velocity;
  };

  void run(double duration, bool driven) noexcept;
  void substep(double h, bool driven) noexcept;

  SimulatedMotionConfig config_;
  HandScript script_;
  Eigen::Vector3d position_, hand_;  // [m]
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero(), hand_velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  Command command_;
  std::vector<Command> under_way_;  // pending commands, a ring buffer, the oldest at next_
  std::size_t next_ = 0;
  std::chrono::nanoseconds read_at_{0}, commanded_at_{0};
  double time_ = 0.0;  // [s], time of the plant
  double handle_work_ = 0.0;
  std::uint32_t buttons_ = 0;
  bool started_ = false, commanded_ = false, enabled_ = true, plugged_ = true;
};

}  // namespace reckon::haptics
