// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Polhem and the hand that holds it, behind the calls of the kernel: its links, its motors and
// counters, its reports of HID, and what goes wrong with them.
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
  double in_at = 0.3;       ///< [ms] of a frame, when it is asked for a report
  double upper_weight = 0;  ///< [N m], of a link that is level
  double fore_weight = 0;   ///< [N m]
  std::size_t report = 14;  ///< octets
  bool is_hid = true;       ///< false: its interface is of another class
};

/// It sends a report, waits until that is fetched, obeys the newest command that has come, and
/// sends the next: what it counts right then.
class PolhemModel final : public HeldModel {
 public:
  /// What a person does to it: brings it to its start pose and presses its button, where it is not
  /// homed, and then goes where a hand is wanted. Until then it carries the links.
  class Care {
   public:
    [[nodiscard]] Eigen::Vector3d hand(const Eigen::Vector3d& wanted) const;
    void tend(PolhemModel& model, const haptics::UsbLoop& loop);

   private:
    static constexpr double kRest = -1.5;  // before it goes anywhere
    double share_ = kRest;                 // of the way from the start pose to where it is wanted
    int still_ = 0;                        // steps for which it has been in the start pose
  };

  /// @param hand where the hand wants it [m, frame D] at a time [s]
  PolhemModel(const PolhemModelOptions& options, std::function<Eigen::Vector3d(double)> hand);

  void leave_alone() { is_tended_ = false; }   ///< nobody homes it
  void press() { asks_ = true; }               ///< its calibration button
  void hold_button(bool on) { button_ = on; }  ///< at the handle
  void turn_gimbal(const std::array<int, 3>& counts) { gimbal_ = counts; }  ///< outwards
  void forget();                                     ///< without power: counters, motors
  void forget_line() { command_.reset(); }           ///< without the bus: what has come over it
  void disguise(bool on) { options_.is_hid = !on; }  ///< another device under its number
  void merge(int count) { merged_ = count; }  ///< the next reports come twice in one transfer
  void ask_once() { asks_once_ = true; }      ///< to be homed, in one report
  void lie(int counts) { lie_ = counts; }     ///< the next report, about its base

  /// Where the handle is in its start pose [m].
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
  std::optional<std::vector<std::uint8_t>> command_;  // came, not obeyed yet
  std::deque<std::vector<std::uint8_t>> reports_;     // to be fetched
  std::chrono::nanoseconds fetched_at_{0};            // the first of them, not before
  std::array<std::int16_t, 3> motors_{};
  std::chrono::nanoseconds obeyed_at_{0};
  std::uint64_t commands_ = 0;
  std::array<int, 3> zero_{};  // added to what its angles give
  std::array<int, 3> gimbal_{};
  bool asks_ = false, button_ = false, is_tended_ = true, asks_once_ = false;
  int merged_ = 0, lie_ = 0;
};

}  // namespace reckon::test
