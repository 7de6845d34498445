// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Polhem and the hand that holds it, behind the kernel's calls: its links, its motors and
// counters, its HID reports, and their faults.
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

#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/tests/haptics/support/held_model.hpp"

namespace reckon::test {

struct PolhemModelOptions : HeldModelOptions {
  double in_at = 0.3;       ///< [ms] in a frame, when a report is requested
  double upper_weight = 0;  ///< [N m], of a level link
  double fore_weight = 0;   ///< [N m]
  std::size_t report = 14;  ///< octets
  bool is_hid = true;       ///< false: its interface is of another class
};

/// It sends a report, waits until this is fetched, obeys the newest received command, and sends the
/// next one with its present counts.
class PolhemModel final : public HeldModel {
 public:
  /// Actions of a person: if it is not homed, moves it to its start pose and presses its button,
  /// and then moves to the hand's goal. Until then the person carries the links.
  class Care {
   public:
    [[nodiscard]] Eigen::Vector3d hand(const Eigen::Vector3d& wanted) const;
    void tend(PolhemModel& model, const haptics::UsbLoop& loop);

   private:
    static constexpr double kRest = -1.5;  // before any motion
    double share_ = kRest;                 // of the path from the start pose to the goal
    int still_ = 0;                        // steps in the start pose so far
  };

  /// @param hand the hand's goal [m, frame D] at a time [s]
  PolhemModel(const PolhemModelOptions& options, std::function<Eigen::Vector3d(double)> hand);

  void leave_alone() { is_tended_ = false; }   ///< nobody homes it
  void press() { asks_ = true; }               ///< its calibration button
  void hold_button(bool on) { button_ = on; }  ///< at the handle
  void turn_gimbal(const std::array<int, 3>& counts) { gimbal_ = counts; }  ///< outwards
  void forget();                                     ///< power loss: counters, motors
  void forget_line() { command_.reset(); }           ///< bus loss: received commands
  void disguise(bool on) { options_.is_hid = !on; }  ///< another device under its number
  void merge(int count) { merged_ = count; }  ///< the next reports come twice in one transfer
  void ask_once() { asks_once_ = true; }      ///< requests homing in one report
  void lie(int counts) { lie_ = counts; }     ///< falsifies the next report, about its base

  /// Position of the handle in its start pose [m].
  [[nodiscard]] static Eigen::Vector3d start();
  [[nodiscard]] std::array<std::int16_t, 3> motors() const { return motors_; }  ///< [mA]
  [[nodiscard]] std::uint64_t commands() const { return commands_; }
  [[nodiscard]] std::array<int, 3> counts() const;  ///< of its arm, beyond 16 bits

  [[nodiscard]] std::vector<std::uint8_t> descriptors() const override;
  int control(std::uint8_t request, std::uint16_t value, std::span<std::uint8_t> answer) override;
  std::optional<int> in_done(std::span<std::uint8_t> octets) override;

 private:
  [[nodiscard]] std::optional<Joints> joints_at(const Eigen::Vector3d& position) const override;
  [[nodiscard]] Eigen::Vector3d torques() const override;
  [[nodiscard]] Eigen::Vector3d half_steps() const override;
  [[nodiscard]] double height(const Eigen::Vector3d& angles) const override;
  [[nodiscard]] bool has_room() const override { return !command_; }
  void take_transfer(std::span<const std::uint8_t> octets) override;
  void run_line() override;
  void obey(std::span<const std::uint8_t> octets);
  void report();

  PolhemModelOptions options_;
  std::mt19937 random_;
  std::optional<std::vector<std::uint8_t>> command_;  // received, not obeyed yet
  std::deque<std::vector<std::uint8_t>> reports_;     // to be fetched
  std::chrono::nanoseconds fetched_at_{0};            // earliest time for the first of them
  std::array<std::int16_t, 3> motors_{};
  std::chrono::nanoseconds obeyed_at_{0};
  std::uint64_t commands_ = 0;
  std::array<int, 3> zero_{};  // added to the counts of its angles
  std::array<int, 3> gimbal_{};
  bool asks_ = false, button_ = false, is_tended_ = true, asks_once_ = false;
  int merged_ = 0, lie_ = 0;
};

}  // namespace reckon::test
