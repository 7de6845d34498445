// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The session of a serial board: opens its line, queries the board, and exchanges forces and
// readings.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "reckon/haptics/devices/device_session.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/serial/serial_port.hpp"
#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"

namespace reckon::haptics {

/// Serial port of a board.
struct SerialPlace {
  static constexpr unsigned kBaud = 1'000'000;

  std::string port;  ///< such as /dev/ttyACM0
  unsigned baud = kBaud;
};

/// Session of one board, run by its thread.
class SerialLoop final : public DeviceSession {
 public:
  static constexpr std::chrono::milliseconds kRetry{200};  ///< between attempts
  /// The line is reopened after it has accepted no octets for so long.
  static constexpr std::chrono::milliseconds kStuck{6};

  /// @param exchange outlives it @param time steady clock of the servo's writes
  SerialLoop(UsbExchange& exchange, const DeviceLimits& limits, SerialPlace place, SteadyTime time);
  /// Sends the board a zero force; blocks 10 ms at most.
  ~SerialLoop() override;

  /// Stage of the session; std::nullopt: the line is not open. Only on the thread of step().
  [[nodiscard]] std::optional<SerialStage> stage() const noexcept;
  [[nodiscard]] unsigned axes() const noexcept override { return axes_; }

 private:
  [[nodiscard]] std::string name() const override { return place_.port; }
  [[nodiscard]] bool is_open() const noexcept override { return port_ != nullptr; }
  [[nodiscard]] std::string open() override;
  void opened(std::chrono::nanoseconds now, std::string& problem) override;
  void wait(std::chrono::microseconds longest) override { wait_without_line(longest); }
  void exchange(std::chrono::microseconds longest) override;
  void exchange_octets(std::chrono::nanoseconds now);
  void detach(const std::string& why, std::chrono::nanoseconds pause);
  void tell_stage(std::chrono::nanoseconds now);

  UsbExchange& exchange_;
  DeviceLimits limits_;
  SerialPlace place_;
  std::unique_ptr<SerialPort> port_;
  std::optional<SerialSession> session_;
  std::uint32_t run_;
  std::uint16_t question_;
  std::chrono::nanoseconds taken_at_{0};  // when the line last accepted octets
  std::optional<SerialStage> told_;
  bool timed_ = false;  // the chain's delay has been reported
  std::atomic<unsigned> axes_{0};
};

}  // namespace reckon::haptics
