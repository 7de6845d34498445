// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Measures a device by small pushes of its free handle.
#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
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
  readings,    ///< too many readings failed
  switch_off,  ///< the operator's switch is released
  restless,    ///< it moves without force: a hand holds it, or its weight pulls it
  speed,       ///< it was faster than kMostSpeed
  place,       ///< it moved farther than kMostWay
  active,      ///< it becomes faster after the push: it gains energy, or a hand moves it
  stuck,       ///< the greatest push does not move it far enough
  late,        ///< its delay is above kLongestDelay
  unlike,      ///< it does not move as a mass with friction
  busy,        ///< late steps: a gap above kMostGap, or more than a share kMostLate of the steps of
               ///< pushes
};

/// Result, of the worst axis: least damping, greatest friction and delay.
struct MeasuredDevice {
  double damping = 0.0;        ///< [N s/m]
  double damping_error = 0.0;  ///< [N s/m], one standard deviation
  double friction = 0.0;       ///< [N], dry
  double delay = 0.0;          ///< [s], from a write to the force at the handle
  double mass = 0.0;           ///< [kg], mean of the axes
  double resolution = 0.0;     ///< [m], step of the sensors; 0: too fine to measure
  double noise = 0.0;          ///< [m], standard deviation of readings at rest
  double residual = 0.0;       ///< [m], greatest root-mean-square misfit of an axis
};

/// Runs step by step in a servo: pass each reading, write the returned force. Along each axis, the
/// handle rests, is pushed back and forth by a force that grows until it moves kWay, and is then
/// pushed a few more times for the record. Any anomaly sets zero force and ends the run. Allocates.
///
///     DeviceMeasurement run(device.limits(), 1ms);
///     while (!run.is_done()) {
///       device.write(run.step(device.read(now), now), now);
///       if (run.needs_judging()) run.judge();
///       wait();
///     }
///
/// Steps need not be punctual. By the contract of delay_samples, the motion between two reads was
/// under the force written that many writes before the later one. Its duration is
/// DeviceSample::took, or the interval of `received`, or else the interval of the steps.
class DeviceMeasurement {
 public:
  static constexpr double kWay = 0.005;          ///< [m], motion that ends the growth of the force
  static constexpr double kMostWay = 0.04;       ///< [m], from the start of the axis
  static constexpr double kMostSpeed = 0.6;      ///< [m/s]
  static constexpr double kMostPush = 3.0;       ///< [N]; also at most 0.4 of the greatest force
  static constexpr double kLongestDelay = 0.05;  ///< [s]
  static constexpr int kMostFailed = 3;          ///< failed readings in a row
  static constexpr int kMostHoles = 100;         ///< pushes repeated because of failed readings
  static constexpr double kMostGap = 0.005;      ///< [s] between two steps of a push
  /// Greatest share of steps of pushes that are more than half a period late.
  static constexpr double kMostLate = 0.02;

  using Axes = std::array<bool, 3>;

  /// @param period of the steps, 0.1 to 10 ms @param axes of frame D that the device has, at least
  /// one: only these are pushed
  DeviceMeasurement(const DeviceLimits& limits, std::chrono::nanoseconds period,
                    Axes axes = {true, true, true});

  /// @param now time of the read, steady @param heard receive time of the sample's report, on any
  /// steady clock; default: `now` @return the force to write [N], frame D
  [[nodiscard]] Eigen::Vector3d step(const DeviceSample& sample, std::chrono::nanoseconds now,
                                     std::optional<std::chrono::nanoseconds> heard = {});

  /// All pushes of an axis are recorded. Until judge(), the force is zero.
  [[nodiscard]] bool needs_judging() const noexcept { return phase_ == Phase::judge; }
  /// Fits the last axis, in about 0.5 s, so in a running servo another thread calls it,
  /// concurrently with step(). Only if needs_judging().
  void judge();
  /// Number of fitted axes. The thread of judge().
  [[nodiscard]] std::size_t judged() const noexcept { return fits_.size(); }

  /// Once true, any thread may call the functions below, and step() and judge() do nothing.
  [[nodiscard]] bool is_done() const noexcept { return phase_ == Phase::done; }
  [[nodiscard]] MeasurementProblem problem() const noexcept { return problem_; }
  /// Greatest force so far [N].
  [[nodiscard]] double most_push() const noexcept { return most_push_; }
  /// std::nullopt until it is done, or if a problem ended it.
  [[nodiscard]] const std::optional<MeasuredDevice>& result() const noexcept { return result_; }

 private:
  enum class Phase : std::uint8_t { rest, push, judge, done };

  void end(MeasurementProblem problem) noexcept;
  [[nodiscard]] bool is_safe(const DeviceSample& sample);
  [[nodiscard]] bool is_punctual(std::chrono::nanoseconds now);
  void rest(double place);
  [[nodiscard]] double push(const DeviceSample& sample);
  void begin_push();
  void end_push();
  void begin_anew();
  [[nodiscard]] AxisPush recorded() const;
  [[nodiscard]] double way_time(const DeviceSample& sample) const noexcept;
  [[nodiscard]] double force_at(std::size_t k) const noexcept;
  [[nodiscard]] int axis_from(int axis) const noexcept;
  void conclude();

  double period_;  // [s]
  std::size_t delay_;
  Axes axes_;
  double greatest_;
  std::atomic<Phase> phase_{
      Phase::rest};  // while `judge`, the judging thread owns the other members
  MeasurementProblem problem_ = MeasurementProblem::none;
  std::optional<MeasuredDevice> result_;
  int axis_, failed_ = 0, holes_ = 0, pushes_ = 0;
  double amplitude_, most_push_ = 0.0;
  bool recording_ = false;
  double start_ = 0.0;  // [m], start of the axis
  bool has_start_ = false;
  std::optional<std::chrono::nanoseconds> last_;   // time of the last step
  std::optional<std::chrono::nanoseconds> heard_;  // receive time of the last report
  double heard_gap_ = 0.0;                         // [s], since the report before
  double gap_ = 0.0;                               // [s], since the step before
  std::size_t in_push_ = 0, late_ = 0;             // steps of pushes, and late ones among them
  std::vector<double> at_rest_;                    // positions during the present rest
  AxisPush now_;                                   // the present push: forces and places
  std::vector<double> took_;                       // [s], duration of the motion to each position
  std::vector<AxisPush> record_;                   // recorded pushes of the axis
  std::vector<double> moves_;                      // [m], differences of readings, of all axes
  std::vector<double> rests_;                      // [m], readings at rest minus their mean
  std::vector<AxisFit> fits_;
};

}  // namespace reckon::haptics
