// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A board that runs the example's program, its handle and the hand that holds it, with its own
// ledger: the work of the held force on the handle's motion.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "reckon/haptics/serial/reckon_board.h"

namespace reckon::test {

struct SerialBoardOptions {
  unsigned seed = 1;
  int axes = 3;
  double mass = 0.1;            ///< [kg]
  double damping = 2.0;         ///< [N s/m]
  double hand_stiffness = 200;  ///< [N/m]
  double hand_damping = 3;      ///< [N s/m]
  int nm_per_count = 20'000;    ///< of each axis; of the second negative
  int most_force = 5'000;       ///< [mN]
  int watchdog = 10;            ///< [ms]
  int period = 1'000;           ///< [us]
  bool is_led = false;          ///< its handle follows the hand's goal, for any force
  int jitter = 50;              ///< [us], of its ticks
  int lag = 0;                  ///< [ms], of its motors behind its reports
};

class SerialBoard {
 public:
  using Vector3d = Eigen::Vector3d;

  /// @param hand the hand's goal [m, frame D] at a time [s]
  SerialBoard(const SerialBoardOptions& options, std::function<Vector3d(double)> hand);
  SerialBoard(const SerialBoard&) = delete;
  SerialBoard& operator=(const SerialBoard&) = delete;

  /// An octet from the host.
  void take(std::uint8_t octet);
  /// Advances time by 50 us. @return frames sent meanwhile
  [[nodiscard]] std::vector<std::vector<std::uint8_t>> pass();

  [[nodiscard]] std::chrono::nanoseconds now() const { return now_; }
  /// [J], the hand's input: through the motors, and the damping loss.
  [[nodiscard]] double books() const { return port_work_ + damping_loss_; }
  /// [J], largest part of its work that the rounding to whole mN may add beyond the host's
  /// knowledge.
  [[nodiscard]] double rounding() const { return rounding_; }
  [[nodiscard]] const Vector3d& position() const { return position_; }  ///< [m, D]
  [[nodiscard]] const Vector3d& force() const { return force_; }        ///< [N, D] that is held

  /// Its state in a tick.
  struct Tick {
    std::uint32_t stamp;  // [us]
    std::array<std::int32_t, 3> counts;
    Vector3d force;  // [N, D] from then on
  };
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }
  /// Number of question and force frames received.
  [[nodiscard]] std::uint64_t commands() const { return commands_; }
  /// Whether it holds a force, or will from its next tick on by its received frames.
  [[nodiscard]] bool will_hold() const;

  void let_go() { options_.hand_stiffness = options_.hand_damping = 0; }  ///< nobody holds it
  /// An unyielding hand holds the handle here, at rest, until it is released. This is not booked.
  void hold(const Vector3d& place) { held_at_ = place; }
  void release() { held_at_.reset(); }
  [[nodiscard]] bool is_held() const { return held_at_.has_value(); }
  void forget();  ///< as after its reset: counters, force, received frames
  void hold_button(bool on) { buttons_ = on ? 1 : 0; }
  void lose_place(bool on) { homed_ = !on; }  ///< its counts are no positions
  void run_clock_at(double rate) { clock_rate_ = rate; }
  void hang(bool on) { hangs_ = on; }  ///< its program stops, and holds its force
  reckon_board program;                ///< the example's

 private:
  void move(double h);
  void tick();

  SerialBoardOptions options_;
  std::function<Vector3d(double)> hand_;
  std::mt19937 random_;
  std::chrono::nanoseconds now_{0}, next_tick_{0}, late_{0};
  Vector3d position_, velocity_ = Vector3d::Zero(), force_ = Vector3d::Zero();
  std::deque<Vector3d> lagging_;  // forces of the last steps
  double port_work_ = 0, damping_loss_ = 0, rounding_ = 0;
  std::uint32_t first_stamp_;
  double clock_rate_ = 1;
  std::optional<Vector3d> held_at_;
  std::uint64_t commands_ = 0;
  std::uint8_t buttons_ = 0;
  bool homed_ = true, hangs_ = false;
  std::vector<std::vector<std::uint8_t>> sent_;
  std::vector<Tick> ticks_;
};

}  // namespace reckon::test
