// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the thread of a serial board does: opens its line, asks it, exchanges forces and readings,
// and finds it again.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/haptics/devices/device_notices.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/serial/serial_port.hpp"
#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"

namespace reckon::haptics {

/// Where a board is.
struct SerialPlace {
  static constexpr unsigned kBaud = 1'000'000;

  std::string port;  ///< such as /dev/ttyACM0
  unsigned baud = kBaud;
};

/// One board. Its thread calls step() over and over; any thread may take the notices.
///
/// Whatever fails, the force is zero here within 10 ms, one sentence says so, and the board is
/// taken up again by itself as soon as it can be.
class SerialLoop {
 public:
  static constexpr std::chrono::milliseconds kRetry{200};  ///< between attempts
  /// Octets that the line does not take for so long are not waited for.
  static constexpr std::chrono::milliseconds kStuck{6};

  /// @param exchange outlives it  @param clock steady, that of the servo's writes
  SerialLoop(UsbExchange& exchange, const DeviceLimits& limits, SerialPlace place,
             std::function<std::chrono::nanoseconds()> clock);
  /// Tells the board a zero; waits 10 ms for it at most.
  ~SerialLoop();
  SerialLoop(const SerialLoop&) = delete;
  SerialLoop& operator=(const SerialLoop&) = delete;

  /// Waits for the board so long at most, and does what is due.
  void step(std::chrono::microseconds longest);
  /// Sentences since the last call, each once. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices() { return notices_.take(); }
  /// How far it is; nothing while the line is not open. The thread of step().
  [[nodiscard]] std::optional<SerialStage> stage() const noexcept;
  /// Axes of frame D that the board has, bit 0 for x, of the last one that was ready; 0: none was.
  /// Any thread.
  [[nodiscard]] unsigned axes() const noexcept { return axes_; }

 private:
  void attach();
  void exchange_octets(std::chrono::nanoseconds now);
  void detach(const std::string& why, std::chrono::nanoseconds pause);
  void tell_stage(std::chrono::nanoseconds now);
  void tell_problem(const std::string& problem);
  void tell(const std::string& sentence);

  UsbExchange& exchange_;
  DeviceLimits limits_;
  SerialPlace place_;
  std::function<std::chrono::nanoseconds()> clock_;
  std::unique_ptr<SerialPort> port_;
  std::optional<SerialSession> session_;
  std::uint32_t run_;
  std::uint16_t question_;
  std::chrono::nanoseconds next_try_{0}, taken_at_{0};  // when the line last took octets
  std::optional<SerialStage> told_;
  bool timed_ = false;  // and told so
  std::atomic<unsigned> axes_{0};
  DeviceNotices notices_;
};

}  // namespace reckon::haptics
