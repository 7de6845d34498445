// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Simulates a haptic device and the hand that holds it: for tests, demos and peers without
// hardware.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/devices/simulated_turn.hpp"

namespace reckon::haptics {

/// Target of the hand for the handle, frame D.
struct HandTarget {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d push = Eigen::Vector3d::Zero();      ///< [N], added to the spring's force
  double grip = 1.0;  ///< 0 .. 1, share of the hand's spring and damper; 0: released
  double most_pull =
      std::numeric_limits<double>::infinity();  ///< [N] >= 0, greatest force of the spring
  std::uint32_t buttons = 0;                    ///< pressed buttons, bit by bit
};

/// Target at a time [s] since the device's first read. Must not allocate; called about ten times a
/// step.
using HandScript = std::function<HandTarget(double)>;

/// Target orientation of a hand for a device of six axes at a time [s]; the same rules.
using TurnScript = std::function<DeviceTurn(double)>;

struct SimulatedDeviceConfig {
  double mass = 0.1;              ///< [kg], > 0, of all moving parts
  double damping = 1.0;           ///< [N s/m], >= 0; all of it counts as guaranteed
  double friction = 0.0;          ///< [N], >= 0, dry friction; none of it counts as guaranteed
  double hand_stiffness = 200.0;  ///< [N/m], the hand's spring to its target; 0: no hand
  double hand_damping = 3.0;      ///< [N s/m]
  double max_force = 10.0;        ///< [N], reported limit
  double max_speed = 2.0;         ///< [m/s], reported limit
  double max_stiffness = 0.0;     ///< [N/m], reported limit; 0: no limit of its own
  /// Reported number of writes until a force is at the handle, 0 .. kMostDelay. Each write advances
  /// the queue by one, so a force is late by this number of servo periods.
  int delay_samples = 0;
  /// Time without a write until the force drops to zero, > 0 and at most HapticDevice::kWatchdog.
  /// With one and a half servo periods, a late step does not hold an outdated force: the force is
  /// zero for the rest of that step, which the hand feels.
  std::chrono::nanoseconds hold = HapticDevice::kWatchdog;
  double resolution = 0.0;  ///< [m], encoder step; 0: exact positions and velocities
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< [m], frame D
  /// [m], frame D, reported limit; no wall keeps the handle inside.
  Eigen::AlignedBox3d workspace{Eigen::Vector3d::Constant(-0.05), Eigen::Vector3d::Constant(0.05)};
  std::optional<SimulatedTurnConfig> turn{};  ///< std::nullopt: a device of three axes
};

/// A point mass with viscous and dry friction, with rotation if it has six axes. A held force and a
/// hand move it. The hand is a spring and damper to a target, which a script moves (scripted
/// operator) or which is fixed (passive operator). The plant runs semi-implicit steps of 0.1 ms or
/// less between two reads. Its energy books are exact for these steps: a passive environment keeps
/// port_work + damping_loss >= 0.
class SimulatedDevice : public HapticDevice {
 public:
  static constexpr int kMostDelay = 1000;  ///< [samples]

  /// @throws std::invalid_argument for a mass <= 0 or other values out of range.
  /// @param turns targets for a device of six axes; empty: its start
  explicit SimulatedDevice(const SimulatedDeviceConfig& config, HandScript script = {},
                           TurnScript turns = {});

  [[nodiscard]] DeviceLimits limits() const noexcept override;
  /// Runs the plant from the last read to `now`; at most 1 s at once.
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override;
  void write_wrench(const Eigen::Vector3d& force, const Eigen::Vector3d& torque,
                    std::chrono::nanoseconds now) noexcept override;

  /// The operator's switch.
  void enable(bool held) noexcept { enabled_ = held; }
  /// Sets its buttons from the next read on, as DeviceSample::buttons, in addition to the ones that
  /// its hand presses.
  void press(std::uint32_t buttons) noexcept { buttons_ = buttons; }
  /// While false, reads fail as if it were unplugged, and the force is zero.
  void plug(bool in) noexcept;
  /// Sets the handle's state at `now`. No force is held or pending, and the books restart; only the
  /// hand's path continues from the last read. Call between a read and a write. @param position
  /// [m], frame D @param velocity [m/s]
  void restart(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
               std::chrono::nanoseconds now) noexcept;

  [[nodiscard]] const Eigen::Vector3d& position() const noexcept { return position_; }
  [[nodiscard]] const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  /// Present force at the handle [N].
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }
  /// Its rotation; std::nullopt: a device of three axes.
  [[nodiscard]] const std::optional<SimulatedTurn>& turn() const noexcept { return turn_; }
  /// Work of the handle against the rendered forces and torques since the start [J].
  [[nodiscard]] double port_work() const noexcept {
    return turn_ ? port_work_ + turn_->port_work() : port_work_;
  }
  /// Energy lost in the device's own viscous friction [J].
  [[nodiscard]] double damping_loss() const noexcept {
    return turn_ ? damping_loss_ + turn_->damping_loss() : damping_loss_;
  }
  /// Work of the hand, minus the loss in its damper [J].
  [[nodiscard]] double hand_work() const noexcept {
    return turn_ ? hand_work_ + turn_->hand_work() : hand_work_;
  }
  [[nodiscard]] double kinetic_energy() const noexcept {
    return 0.5 * config_.mass * velocity_.squaredNorm();
  }

 private:
  using Wrench = Eigen::Matrix<double, 6, 1>;  // force, then torque

  void drop_force() noexcept;
  [[nodiscard]] bool holds_force() const noexcept;
  void run(double duration) noexcept;
  void substep(double h) noexcept;
  void run_turn(int steps, double h) noexcept;

  SimulatedDeviceConfig config_;
  HandScript script_;
  TurnScript turns_;
  Eigen::Vector3d position_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_ = Eigen::Vector3d::Zero();
  std::optional<SimulatedTurn> turn_;
  std::vector<Wrench> under_way_;  // pending wrenches, a ring buffer, the oldest at next_
  std::size_t next_ = 0;
  std::chrono::nanoseconds read_at_{0};
  std::chrono::nanoseconds written_at_{0};
  double time_ = 0.0;  // [s], time of the plant
  std::uint32_t buttons_ = 0;
  bool started_ = false;
  bool enabled_ = true;
  std::uint32_t scripted_ = 0;  // buttons that the script presses
  bool plugged_ = true;
  double port_work_ = 0.0;
  double damping_loss_ = 0.0;
  double hand_work_ = 0.0;
};

}  // namespace reckon::haptics
