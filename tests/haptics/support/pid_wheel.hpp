// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A wheel or stick of the USB class HID PID that renders springs like its firmware, and the hand
// that holds it. Reports of the host go in, its own come out; it keeps its own ledger.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace reckon::test {

struct PidWheelOptions {
  int axes = 1;                  ///< 1: X; 2: Y too
  double travel = 0.25;          ///< [m], of each axis
  double full_force = 15;        ///< [N], at the greatest saturation
  double full_stiffness = 2000;  ///< [N/m], of the greatest coefficient
  double mass = 0.2;             ///< [kg]
  double hand_stiffness = 300;   ///< [N/m]
  double hand_damping = 10;      ///< [N s/m]
  double hand_speed = 0.1;       ///< [m/s], of the hand's goal
  int most_effects = 16;         ///< at once
  bool has_room_of_its_own = true;
  /// Usages of the page PID missing in its descriptor, which declares padding instead.
  std::vector<int> without = {};
};

/// Pure: time is passed in. Reports begin with their number. One thread at a time.
class PidWheel {
 public:
  static constexpr std::size_t kAxes = 2;
  static constexpr int kMostEffects = 16;  ///< that reports can name
  /// Steps of a coefficient, a saturation, and half the travel, in a report.
  static constexpr double kSteps = 10000;

  explicit PidWheel(const PidWheelOptions& options) : options_(options) {}

  /// Defines the reports for the host.
  [[nodiscard]] std::vector<std::uint8_t> descriptor() const;
  /// Processes an output or feature report of the host.
  void take(std::span<const std::uint8_t> report);
  /// A feature report requested by the host; nothing: there is none of this number.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> feature(std::uint8_t number) const;
  /// Report with the positions of its axes.
  [[nodiscard]] std::vector<std::uint8_t> input() const;
  /// Unplugged or plugged in: it has no effects and its actuators are off.
  void lose_power();

  /// Sets the hand's goal for the handle [m]; it moves there at hand_speed.
  void want(std::size_t axis, double place) { goal_[axis] = place; }
  /// An unyielding hand holds the handle here [m], at rest, until it is released. This is not
  /// booked.
  void hold(const std::optional<std::array<double, kAxes>>& place) { held_ = place; }
  [[nodiscard]] bool is_held() const { return held_.has_value(); }
  /// Advances its time to `now`.
  void run_until(std::chrono::nanoseconds now);

  [[nodiscard]] double place(std::size_t axis) const { return place_[axis]; }  ///< [m]
  [[nodiscard]] double speed(std::size_t axis) const { return speed_[axis]; }  ///< [m/s]
  [[nodiscard]] double force(std::size_t axis) const {                         ///< [N]
    return force_at(axis, place_[axis]);
  }
  [[nodiscard]] double fastest() const { return fastest_; }  ///< [m/s], so far
  // Energy that its springs took from the hand since the start, and its minimum [J].
  [[nodiscard]] double absorbed() const { return absorbed_; }
  [[nodiscard]] double least_absorbed() const { return least_; }
  [[nodiscard]] std::size_t effects() const { return effects_.size(); }
  [[nodiscard]] std::size_t playing() const;
  /// Number of conditions so far that changed an effect.
  [[nodiscard]] int changes() const { return changes_; }
  /// Number of conditions and starts so far.
  [[nodiscard]] std::uint64_t orders() const { return orders_; }
  /// Number of unknown reports so far, or reports of an effect that does not exist.
  [[nodiscard]] int strange() const { return strange_; }
  /// Time of the last report of the host.
  [[nodiscard]] std::chrono::nanoseconds told() const { return told_; }

 private:
  struct Condition {
    double at = 0;                      // [m]
    std::array<double, 2> stiffness{};  // [N/m], below and above
    std::array<double, 2> most{};       // [N]
    double half_dead = 0;               // [m]
    bool operator==(const Condition&) const = default;
  };
  struct Effect {
    std::array<Condition, kAxes> conditions{};
    std::chrono::milliseconds length{0};  // 0: without end
    double gain = 1;
    bool plays = false;
    std::chrono::nanoseconds until{0};
  };

  void set_effect(std::span<const std::uint8_t> report);
  void set_condition(std::span<const std::uint8_t> report);
  void operate(std::span<const std::uint8_t> report);
  void control(std::uint8_t what);
  void create(std::uint8_t type);
  [[nodiscard]] Effect* effect_of(std::span<const std::uint8_t> report);
  void run(double h);
  template <class Each>
  void each_spring(std::size_t axis, double x, Each&& each) const;
  [[nodiscard]] double force_at(std::size_t axis, double x) const;
  [[nodiscard]] double energy_at(std::size_t axis, double x) const;

  PidWheelOptions options_;
  std::map<std::uint8_t, Effect> effects_;
  std::uint8_t loaded_ = 0, load_status_ = 0;  // of the last requested effect
  bool actuates_ = false;
  double gain_ = 1;
  std::chrono::nanoseconds now_{0}, told_{0};
  std::array<double, kAxes> goal_{}, wanted_{}, place_{}, speed_{};
  double absorbed_ = 0, least_ = 0, fastest_ = 0;
  std::optional<std::array<double, kAxes>> held_;
  int changes_ = 0, strange_ = 0;
  std::uint64_t orders_ = 0;
};

}  // namespace reckon::test
