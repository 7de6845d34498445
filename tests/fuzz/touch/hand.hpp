// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One hand of a scenario: its operator, device and servo, and the energy ledger that checks them.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/fuzz/touch/model_handle.hpp"
#include "reckon/tests/fuzz/touch/moving.hpp"
#include "reckon/tests/fuzz/touch/scenario.hpp"
#include "reckon/tests/fuzz/touch/trial.hpp"
#include "reckon/tests/haptics/support/drawn_touch.hpp"

namespace reckon::fuzz {

inline constexpr double kRadius = 0.02;    // [m], of each hand
inline constexpr double kRoundOff = 1e-9;  // [J]
inline constexpr double kMoved = 0.2;      // [s], time in which an unheard hand moves elsewhere

/// The shown positions of a hand, step by step.
struct Track {
  double period = 1e-3;  ///< [s]
  std::vector<Eigen::Vector3d> points;

  /// Position and velocity at t [s]; after the end it rests there.
  [[nodiscard]] haptics::HandTarget at(double t) const;
  /// Limits the speed to `most` [m/s], which an arm can reach.
  void slow_down(double most);
};

/// The home position of hand `hand` [m].
[[nodiscard]] double home_of(const Scenario& scenario, std::size_t hand);
/// The goal of its grip relative to home [m], at t [s].
[[nodiscard]] Eigen::Vector3d way_of(const Scenario& scenario, std::size_t hand, double t);

class Hand {
 public:
  /// @param led a firm grip leads the hand along it instead of along the scenario's path; may be
  ///     null, must outlive the hand
  /// @param begin of the run; if the first hand has a model, the model's
  Hand(const Scenario& scenario, std::size_t index, const Track* led = nullptr,
       std::chrono::nanoseconds begin = {});

  /// The model whose clock all hands use; null: none.
  [[nodiscard]] ModelHandle* model() const { return model_; }
  /// When its servo steps next.
  [[nodiscard]] std::chrono::nanoseconds next() const { return next_; }
  /// One servo step, if one is due. Draws failures and delays.
  void step(std::chrono::nanoseconds now, std::mt19937& random);
  void judge(Outcome& out) const;

  [[nodiscard]] const haptics::ServoSnapshot& snapshot() const { return snapshot_; }
  [[nodiscard]] haptics::ServoLoop& servo() const { return *servo_; }
  /// Whether it stepped in the last call of step().
  [[nodiscard]] bool stepped() const { return stepped_; }
  /// Work at the port and damping, of the device's own ledger [J].
  [[nodiscard]] double work() const { return handle_->work(); }
  /// Greatest energy that late or failed samples may have left open [J].
  [[nodiscard]] double open() const { return late_cost_ + failed_cost_; }
  /// Energy that encoder steps may have put into the servo's ledger, as the servo states it [J].
  [[nodiscard]] double allowance() const;
  [[nodiscard]] const MovingBooks& bodies() const { return *moving_; }
  /// Largest force of a neighbour [N].
  [[nodiscard]] double felt() const;
  /// From now on averages the force and counts the servo's reports of a reduced force.
  void watch();
  /// [N], mean of the written force, or of the model's force, since watch()
  [[nodiscard]] double mean_force() const;
  /// [s] since watch(), for which the servo reported a force smaller than requested
  [[nodiscard]] double told() const;

 private:
  void make_handle(const Track* led);
  [[nodiscard]] double time_of(std::chrono::nanoseconds now) const;
  [[nodiscard]] double told_so_far() const;
  void keep_model_books(double port, double dt);
  void note_step(double dt);
  void draw_faults(std::chrono::nanoseconds now, std::mt19937& random);
  void keep_books(double before, double dt, bool failed);
  void note_transfer();
  void note_surfaces();

  const Scenario& scenario_;
  std::size_t index_;
  std::chrono::nanoseconds period_;
  std::optional<test::DrawnTouch> drawn_;
  std::unique_ptr<Handle> handle_;
  SimulatedHandle* simulated_ = nullptr;  // the handle if it is simulated
  ModelHandle* model_ = nullptr;          // the handle if it is a model
  std::unique_ptr<haptics::ServoLoop> servo_;
  std::unique_ptr<MovingBooks> moving_;
  haptics::ServoSnapshot snapshot_;
  std::chrono::nanoseconds begin_, next_{0}, at_{0};
  bool stepped_ = false;
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();
  std::uint64_t let_go_ = 0;

  std::array<double, 1024> transfer_{};  // [J], received - given, by the entity number of the other
  double transferred_ = 0;
  double least_port_ = 0, least_held_ = 1e9, short_ = 0, meter_ = 0, meter_short_ = 0;
  double excess_ = -1e9, late_cost_ = 0, failed_cost_ = 0;
  bool finite_ = true;
  ModelBooks books_;
  double put_in_ = 0;      // [J], greatest so far
  double speechless_ = 0;  // [s], in which the model reports that it shows no force

  bool watched_ = false;
  double told_before_ = 0, force_sum_ = 0, force_time_ = 0;

  // Motion of surfaces on its springs, by the entity number of the other.
  struct Surface {
    double depth = 0, force = 0, x = 0;
    bool known = false;
  };
  std::array<Surface, 1024> surfaces_{};
  double seen_ = 0;       // [J]
  double unseen_ = -1e9;  // [J]
};

}  // namespace reckon::fuzz
