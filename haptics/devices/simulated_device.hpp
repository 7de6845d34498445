// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A haptic device and the hand that holds it, simulated: for tests, demos and peers without
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

/// Where a hand wants the handle to be, frame D.
struct HandTarget {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d push = Eigen::Vector3d::Zero();      ///< [N], on top of the spring
  double grip = 1.0;  ///< 0 .. 1, share of the hand's spring and damper; 0: it has let go
  double most_pull = std::numeric_limits<double>::infinity();  ///< [N] >= 0, that the spring gives
  std::uint32_t buttons = 0;                                   ///< pressed
};

/// Target at a time [s] since the device's first read. Must not allocate; called about ten times a
/// step.
using HandScript = std::function<HandTarget(double)>;

/// How a hand wants a device of six axes to be turned, at such a time; the same rules.
using TurnScript = std::function<DeviceTurn(double)>;

struct SimulatedDeviceConfig {
  double mass = 0.1;              ///< [kg], > 0; of the handle and what moves with it
  double damping = 1.0;           ///< [N s/m], >= 0; all of it counts as sure
  double friction = 0.0;          ///< [N], >= 0; dry, of which nothing counts as sure
  double hand_stiffness = 200.0;  ///< [N/m], the hand's spring to its target; 0 = no hand
  double hand_damping = 3.0;      ///< [N s/m]
  double max_force = 10.0;        ///< [N], as the servo is given it
  double max_speed = 2.0;         ///< [m/s], as the servo is given it
  double max_stiffness = 0.0;     ///< [N/m], as the servo is given it; 0 = no limit of its own
  /// Writes until a force is at the handle, 0 .. kMostDelay, as the servo is given it: each write
  /// moves the queue on by one, so that it is so many servo periods late.
  int delay_samples = 0;
  /// Then the force drops to zero by itself, > 0 and at most HapticDevice::kWatchdog. One and a
  /// half servo periods keep a late step from holding a force that is out of date; it is dropped
  /// for the rest of that step, which the hand feels.
  std::chrono::nanoseconds hold = HapticDevice::kWatchdog;
  double resolution = 0.0;  ///< [m], encoder step; 0 = exact positions and velocities
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< [m], frame D
  /// [m], frame D, as the servo is given it; no wall holds the handle in it.
  Eigen::AlignedBox3d workspace{Eigen::Vector3d::Constant(-0.05), Eigen::Vector3d::Constant(0.05)};
  std::optional<SimulatedTurnConfig> turn{};  ///< none: a device of three axes
};

/// A point mass with viscous and dry friction, which also turns if it has six axes, moved by a held
/// force and by a hand: a spring and damper to a target that a script moves (scripted operator) or
/// that stays where it is (passive operator). The plant runs at a tenth of a millisecond or finer,
/// semi-implicit, between two reads. Its books are exact for its own steps: port_work +
/// damping_loss is what a passive environment keeps >= 0.
class SimulatedDevice : public HapticDevice {
 public:
  static constexpr int kMostDelay = 1000;  ///< [samples]

  /// @throws std::invalid_argument for a mass <= 0 or other values out of range.
  /// @param turns of a device of six axes; none: as at its start
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
  /// Its buttons from the next read on, as DeviceSample::buttons, besides those that its hand
  /// presses.
  void press(std::uint32_t buttons) noexcept { buttons_ = buttons; }
  /// While false, reads fail as if the cable were out, and the force is zero.
  void plug(bool in) noexcept;
  /// The handle is there at `now`, wherever it was: no force is held or on its way, the books begin
  /// anew, and of what happened since the last read only the hand's own path goes on. Between a
  /// read and a write. @param position [m], frame D  @param velocity [m/s]
  void restart(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
               std::chrono::nanoseconds now) noexcept;

  [[nodiscard]] const Eigen::Vector3d& position() const noexcept { return position_; }
  [[nodiscard]] const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  /// Force now at the handle [N].
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }
  /// How it turns; none of a device of three axes.
  [[nodiscard]] const std::optional<SimulatedTurn>& turn() const noexcept { return turn_; }
  /// Energy that the rendered forces and torques took from the handle since the start [J].
  [[nodiscard]] double port_work() const noexcept {
    return turn_ ? port_work_ + turn_->port_work() : port_work_;
  }
  /// Energy lost in the device's own viscous friction [J].
  [[nodiscard]] double damping_loss() const noexcept {
    return turn_ ? damping_loss_ + turn_->damping_loss() : damping_loss_;
  }
  /// Energy that the hand put in, less what its damper took [J].
  [[nodiscard]] double hand_work() const noexcept {
    return turn_ ? hand_work_ + turn_->hand_work() : hand_work_;
  }
  [[nodiscard]] double kinetic_energy() const noexcept {
    return 0.5 * config_.mass * velocity_.squaredNorm();
  }

 private:
  using Wrench = Eigen::Matrix<double, 6, 1>;  // force, then torque

  void let_go() noexcept;
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
  std::vector<Wrench> under_way_;  // a ring, the oldest at next_
  std::size_t next_ = 0;
  std::chrono::nanoseconds read_at_{0};
  std::chrono::nanoseconds written_at_{0};
  double time_ = 0.0;  // [s], of the plant
  std::uint32_t buttons_ = 0;
  bool started_ = false;
  bool enabled_ = true;
  std::uint32_t scripted_ = 0;  // buttons
  bool plugged_ = true;
  double port_work_ = 0.0;
  double damping_loss_ = 0.0;
  double hand_work_ = 0.0;
};

}  // namespace reckon::haptics
