// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A run that finds what a device is like, by small pushes of a handle that nobody holds.
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
  readings,    ///< too many failed
  switch_off,  ///< the operator's switch is released
  restless,    ///< it moves while no force is there: held, or pulled by its weight
  speed,       ///< it went faster than kMostSpeed
  place,       ///< it went farther than kMostWay
  active,      ///< it goes on faster than the push left it: it gains energy, or a hand moves it
  stuck,       ///< the greatest push does not move it far enough
  late,        ///< its forces come too late for the delay to be found
  unlike,      ///< it moves otherwise than a mass with friction
  busy,        ///< steps came late: kMostGap once, or more than kMostLate of those of pushes
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
///     while (!run.is_done()) {
///       device.write(run.step(device.read(now), now), now);
///       if (run.needs_judging()) run.judge();
///       wait();
///     }
///
/// Steps need not be punctual: by the contract of delay_samples the way of the handle between two
/// reads was under the force written that many writes before the later, and how long it took the
/// device says (DeviceSample::took), or its driver, or else the steps' own times.
class DeviceMeasurement {
 public:
  static constexpr double kWay = 0.005;      ///< [m], of the handle at the end of its first push
  static constexpr double kMostWay = 0.04;   ///< [m], from where its axis began
  static constexpr double kMostSpeed = 0.6;  ///< [m/s]
  static constexpr double kMostPush = 3.0;   ///< [N], and 0.4 of the greatest force
  static constexpr double kLongestDelay = 0.05;  ///< [s]
  static constexpr int kMostFailed = 3;          ///< readings in a row
  static constexpr int kMostHoles = 100;         ///< pushes begun anew for readings that failed
  static constexpr double kMostGap = 0.005;      ///< [s], between two steps of a push
  /// Share of the steps of pushes that may come more than half a period late.
  static constexpr double kMostLate = 0.02;

  using Axes = std::array<bool, 3>;

  /// @param period of the steps, 0.1 to 10 ms  @param axes that it has, of frame D: the others are
  /// not pushed; one at least
  DeviceMeasurement(const DeviceLimits& limits, std::chrono::nanoseconds period,
                    Axes axes = {true, true, true});

  /// @param now when the sample was read, steady  @param heard when the driver had the report that
  /// it is of, on any steady clock; none: it is as new as `now`  @return the force to write [N],
  /// frame D
  [[nodiscard]] Eigen::Vector3d step(const DeviceSample& sample, std::chrono::nanoseconds now,
                                     std::optional<std::chrono::nanoseconds> heard = {});

  /// All pushes of an axis are recorded, and until judge() has been called no force is asked for.
  [[nodiscard]] bool needs_judging() const noexcept { return phase_ == Phase::judge; }
  /// Works out what the last axis is like: some 0.5 s, so in a running servo another thread calls
  /// it, beside step(). Only with needs_judging().
  void judge();
  /// Axes that were judged so far. The thread of judge().
  [[nodiscard]] std::size_t judged() const noexcept { return fits_.size(); }

  /// From then on the rest may be asked for by any thread, and step() and judge() do nothing.
  [[nodiscard]] bool is_done() const noexcept { return phase_ == Phase::done; }
  [[nodiscard]] MeasurementProblem problem() const noexcept { return problem_; }
  /// Greatest force so far [N].
  [[nodiscard]] double most_push() const noexcept { return most_push_; }
  /// Without a value until it is done, or where a problem ended it.
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
  std::atomic<Phase> phase_{Phase::rest};  // judge(): all else is the judging thread's
  MeasurementProblem problem_ = MeasurementProblem::none;
  std::optional<MeasuredDevice> result_;
  int axis_, failed_ = 0, holes_ = 0, pushes_ = 0;
  double amplitude_, most_push_ = 0.0;
  bool recording_ = false;
  double start_ = 0.0;  // [m], of the axis
  bool has_start_ = false;
  std::optional<std::chrono::nanoseconds> last_;   // step
  std::optional<std::chrono::nanoseconds> heard_;  // of the last report
  double heard_gap_ = 0.0;                         // [s], from that before it
  double gap_ = 0.0;                               // [s], from that before it
  std::size_t in_push_ = 0, late_ = 0;  // steps of pushes, and those of them that came late
  std::vector<double> at_rest_;         // of the present rest
  AxisPush now_;                        // the present push: forces and places
  std::vector<double> took_;            // [s], of its ways, each to a place
  std::vector<AxisPush> record_;        // of the axis
  std::vector<double> moves_;           // [m], differences of readings, of all axes
  std::vector<double> rests_;           // [m], readings at rest less their mean
  std::vector<AxisFit> fits_;
};

}  // namespace reckon::haptics
