// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A run that finds what a device is like, by small pushes of a handle that nobody holds.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/measurement/axis_fit.hpp"

namespace reckon::haptics {

/// Why a run ended before its result.
enum class MeasurementProblem : std::uint8_t {
  none,
  readings,    ///< too many failed
  switch_off,  ///< the operator's switch is released
  restless,    ///< it moves while no force is there: held, or pulled by its weight
  speed,       ///< it went faster than kMostSpeed
  place,       ///< it went farther than kMostWay
  active,      ///< it goes on faster than the push left it: it gains energy, or a hand moves it
  stuck,       ///< the greatest push does not move it far enough
  late,        ///< its forces come too late for the delay to be found
  unlike,      ///< it moves otherwise than a mass with friction
};

/// What was found. Of the axes the one that is worse: least damping, most friction and delay.
struct MeasuredDevice {
  double damping = 0.0;        ///< [N s/m]
  double damping_error = 0.0;  ///< [N s/m], one standard deviation
  double friction = 0.0;       ///< [N], dry
  double delay = 0.0;          ///< [s], from a write to the force at the handle
  double mass = 0.0;           ///< [kg], mean of the axes
  double resolution = 0.0;     ///< [m], step of the sensors; 0: finer than can be told
  double noise = 0.0;          ///< [m], of readings at rest, standard deviation
  double residual = 0.0;       ///< [m], greatest misfit of an axis, root of the mean square
};

/// One servo step after the other: pass each reading, write the force. Along each axis the handle
/// is let rest, pushed to and fro by a force that grows until it goes kWay, and then pushed so a
/// few times more. Any surprise makes the force zero and ends the run. Allocates.
///
///     DeviceMeasurement run(device.limits(), 1ms);
///     while (!run.is_done()) device.write(run.step(device.read(now), now), now), wait();
class DeviceMeasurement {
 public:
  static constexpr double kWay = 0.005;      ///< [m], of the handle at the end of its first push
  static constexpr double kMostWay = 0.04;   ///< [m], from where its axis began
  static constexpr double kMostSpeed = 0.6;  ///< [m/s]
  static constexpr double kMostPush = 3.0;   ///< [N], and 0.4 of the greatest force
  static constexpr double kLongestDelay = 0.05;  ///< [s]
  static constexpr int kMostFailed = 3;          ///< readings in a row

  /// @param period of the steps, 0.1 to 10 ms
  DeviceMeasurement(const DeviceLimits& limits, std::chrono::nanoseconds period);

  /// @return the force to write [N], frame D
  [[nodiscard]] Eigen::Vector3d step(const DeviceSample& sample);

  [[nodiscard]] bool is_done() const noexcept { return phase_ == Phase::done; }
  [[nodiscard]] MeasurementProblem problem() const noexcept { return problem_; }
  /// Greatest force so far [N].
  [[nodiscard]] double most_push() const noexcept { return most_push_; }
  /// Without a value until it is done, or where a problem ended it.
  [[nodiscard]] const std::optional<MeasuredDevice>& result() const noexcept { return result_; }

 private:
  enum class Phase : std::uint8_t { rest, push, done };

  void end(MeasurementProblem problem) noexcept;
  [[nodiscard]] bool is_safe(const DeviceSample& sample);
  void rest(double place);
  [[nodiscard]] double push(double place);
  void begin_push();
  void end_push();
  [[nodiscard]] double force_at(std::size_t k) const noexcept;
  void next_axis();
  void conclude();

  double period_;  // [s]
  double greatest_;
  Phase phase_ = Phase::rest;
  MeasurementProblem problem_ = MeasurementProblem::none;
  std::optional<MeasuredDevice> result_;
  int axis_ = 0, failed_ = 0, pushes_ = 0;
  double amplitude_, most_push_ = 0.0;
  bool recording_ = false;
  double start_ = 0.0;  // [m], of the axis
  bool has_start_ = false;
  std::vector<double> at_rest_;   // of the present rest
  AxisPush now_;                  // the present push
  std::vector<AxisPush> record_;  // of the axis
  std::vector<double> moves_;     // [m], differences of readings, of all axes
  std::vector<double> rests_;     // [m], readings at rest less their mean
  std::vector<AxisFit> fits_;
};

}  // namespace reckon::haptics
