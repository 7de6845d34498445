// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Falcon and the hand that holds it, behind the calls of the kernel: its mass, its motors and
// encoders, its line and the timer of its FTDI chip, and what goes wrong with them.
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

#include "reckon/tests/haptics/support/usb_shim.hpp"

namespace reckon::test {

struct FalconModelOptions {
  unsigned seed = 1;
  double mass = 0.15;           ///< [kg]
  double damping = 2.0;         ///< [N s/m]
  double hand_stiffness = 200;  ///< [N/m]
  double hand_damping = 3;      ///< [N s/m]
  double tick_at = 0.5;         ///< [ms] of a frame, when the chip's timer fires
  bool has_firmware = true;
  bool homed = true;
  std::vector<std::uint8_t> firmware;  ///< that it takes
  int latency_set = -1;  ///< [ms] that its timer keeps, whatever is asked; -1: what is asked
};

/// Energies are those of its own motion, at a tenth of a millisecond or finer.
class FalconModel final : public UsbModel {
 public:
  /// @param hand where the hand wants it [m, frame D] at a time [s]
  FalconModel(const FalconModelOptions& options, std::function<Eigen::Vector3d(double)> hand);

  [[nodiscard]] std::chrono::nanoseconds now() const { return now_; }
  void pass(std::chrono::nanoseconds time) override;
  /// Called every 50 us of its time, whoever lets it pass: what runs beside the device's thread.
  void beside(std::function<void(std::chrono::nanoseconds)> call) { beside_ = std::move(call); }

  // What goes wrong from now on.
  void hang(std::chrono::nanoseconds time) { hangs_until_ = now_ + time; }  ///< no transfer ends
  void mute(std::chrono::nanoseconds time) { mute_until_ = now_ + time; }   ///< no reports
  void stall() { stalls_ = true; }                ///< the next transfer to it is refused
  void cut() { cuts_ = true; }                    ///< the next transfer to it ends early
  void damage(int octets) { damaged_ = octets; }  ///< of its next reports
  void split(bool on) { splits_ = on; }           ///< reports come in pieces
  void forget();                                  ///< without power: firmware, homing, motors
  void home() { homed_ = true; }
  void wake() { has_firmware_ = homed_ = true; }  ///< as after loading and homing

  // Its own books.
  [[nodiscard]] double port_work() const { return port_work_; }        ///< [J], of the motors
  [[nodiscard]] double damping_loss() const { return damping_loss_; }  ///< [J]
  [[nodiscard]] Eigen::Vector3d position() const;                      ///< [m], frame D
  [[nodiscard]] Eigen::Vector3d force() const;  ///< [N], of the motors, frame D
  [[nodiscard]] std::array<std::int16_t, 3> motors() const { return motors_; }
  [[nodiscard]] std::uint64_t commands() const { return commands_; }
  [[nodiscard]] bool has_firmware() const { return has_firmware_; }
  [[nodiscard]] int latency() const { return latency_; }

  [[nodiscard]] std::vector<std::uint8_t> descriptors() const override;
  int control(std::uint8_t request, std::uint16_t value, std::span<std::uint8_t> answer) override;
  void begin_out(std::span<const std::uint8_t> octets) override;
  std::optional<int> out_done() override;
  std::optional<int> in_done(std::span<std::uint8_t> octets) override;

 private:
  void move(double h);
  [[nodiscard]] Eigen::Vector3d own_force() const;
  void run_line();
  void take(std::uint8_t octet);
  void obey();
  void report();
  void echo(std::uint8_t octet);

  FalconModelOptions options_;
  std::function<Eigen::Vector3d(double)> hand_;
  std::function<void(std::chrono::nanoseconds)> beside_;
  std::mt19937 random_;
  std::chrono::nanoseconds now_{0};

  Eigen::Vector3d position_, velocity_ = Eigen::Vector3d::Zero();  // in the device's own axes
  Eigen::Vector3d angles_;
  Eigen::Matrix3d jacobian_;
  double port_work_ = 0, damping_loss_ = 0;

  std::vector<std::uint8_t> out_;
  std::chrono::nanoseconds out_at_{-1};  // a transfer ends
  bool out_ended_ = false;
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
  std::chrono::nanoseconds hangs_until_{0}, mute_until_{0};
  bool stalls_ = false, cuts_ = false, splits_ = false;
  int damaged_ = 0;
};

}  // namespace reckon::test
