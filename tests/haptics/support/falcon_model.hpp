// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Falcon and the hand that holds it, behind the kernel's calls: its mass, its motors and
// encoders, its line and the timer of its FTDI chip, and their faults.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/tests/haptics/support/held_model.hpp"

namespace reckon::test {

struct FalconModelOptions : HeldModelOptions {
  double tick_at = 0.5;  ///< [ms] in a frame, when the chip's timer fires
  bool has_firmware = true;
  bool homed = true;
  std::vector<std::uint8_t> firmware;  ///< that it accepts
  int latency_set = -1;  ///< [ms] that its timer keeps, for any request; -1: as requested
};

class FalconModel final : public HeldModel {
 public:
  /// Actions of a person: only holding it.
  struct Care {
    [[nodiscard]] Eigen::Vector3d hand(const Eigen::Vector3d& wanted) const { return wanted; }
    void tend(FalconModel&, const haptics::UsbLoop&) {}
  };

  /// @param hand the hand's goal [m, frame D] at a time [s]
  FalconModel(const FalconModelOptions& options, std::function<Eigen::Vector3d(double)> hand);

  void forget();       ///< power loss: firmware, homing, motors
  void forget_line();  ///< bus loss: its FTDI chip, which is powered by the bus
  /// Invalid octets in its next reports.
  void damage_visibly(int count) {
    damage(count);
    is_visible_ = true;
  }
  void home() { homed_ = true; }
  void wake() { has_firmware_ = homed_ = true; }  ///< as after loading and homing

  [[nodiscard]] std::array<std::int16_t, 3> motors() const { return motors_; }
  [[nodiscard]] std::uint64_t commands() const { return commands_; }
  [[nodiscard]] bool has_firmware() const { return has_firmware_; }
  [[nodiscard]] int latency() const { return latency_; }

  [[nodiscard]] std::vector<std::uint8_t> descriptors() const override;
  int control(std::uint8_t request, std::uint16_t value, std::span<std::uint8_t> answer) override;
  std::optional<int> in_done(std::span<std::uint8_t> octets) override;

 private:
  [[nodiscard]] std::optional<Joints> joints_at(const Eigen::Vector3d& position) const override;
  [[nodiscard]] Eigen::Vector3d torques() const override;
  [[nodiscard]] Eigen::Vector3d half_steps() const override;
  void run_line() override;
  void take_transfer(std::span<const std::uint8_t> octets) override;
  void take(std::uint8_t octet);
  void obey();
  void report();
  void echo(std::uint8_t octet);

  FalconModelOptions options_;
  std::mt19937 random_;

  std::deque<std::pair<std::chrono::nanoseconds, std::uint8_t>> to_device_, to_host_;
  std::deque<std::vector<std::uint8_t>> packets_;  // of the chip, for the host
  std::chrono::nanoseconds next_tick_{0};
  std::string command_;
  std::array<std::int16_t, 3> motors_{};
  std::uint64_t commands_ = 0;
  std::chrono::nanoseconds obeyed_at_{0};

  int latency_ = 16;
  std::uint16_t baud_ = 0;
  bool has_firmware_, homed_;
  std::vector<std::uint8_t> loaded_;
  std::string greeting_;
  bool loading_ = false;
  bool is_visible_ = false;  // kind of damage
};

}  // namespace reckon::test
