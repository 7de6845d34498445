// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the thread of a device on USB does: finds it, sets it up, exchanges forces and readings, and
// finds it again.
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
#include "reckon/haptics/usb/usb_driver.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"
#include "reckon/haptics/usb/usb_line.hpp"
#include "reckon/haptics/usb/usb_session.hpp"

namespace reckon::haptics {

/// How a UsbLoop finds its device.
struct UsbLoopOptions {
  std::function<std::chrono::nanoseconds()> clock;  ///< steady, that of the servo's writes
  UsbOpener open;                                   ///< empty: the first that is attached
  bool discover = true;                             ///< see UsbContext
};

/// One device. Its thread calls step() over and over; any thread may take the notices.
///
/// Whatever fails, the force is zero here within 10 ms, one sentence says so, and the device is set
/// up again by itself as soon as it can be.
class UsbLoop {
 public:
  static constexpr std::chrono::milliseconds kRetry{200};  ///< between attempts

  /// @param exchange outlives it @throws std::runtime_error where the host has no USB
  UsbLoop(UsbExchange& exchange, std::unique_ptr<UsbDriver> driver, UsbLoopOptions options);
  /// Tells the device a zero; waits 10 ms for it at most.
  ~UsbLoop();
  UsbLoop(const UsbLoop&) = delete;
  UsbLoop& operator=(const UsbLoop&) = delete;

  /// Waits for the device so long at most, except while setting it up, and does what is due.
  void step(std::chrono::microseconds longest);
  /// Sentences since the last call, each once. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices() { return notices_.take(); }
  /// How far it is; nothing while no device is set up. The thread of step().
  [[nodiscard]] std::optional<UsbStage> stage() const noexcept;
  /// Any thread: ends an attempt to set the device up.
  void stop() noexcept { stopped_.store(true, std::memory_order_relaxed); }

 private:
  void attach();
  [[nodiscard]] std::string open();
  void detach(const std::string& why);
  void tell_stage();
  void tell(const std::string& sentence);

  UsbExchange& exchange_;
  std::unique_ptr<UsbDriver> driver_;
  UsbLoopOptions options_;
  UsbContext context_;
  std::optional<UsbLine> line_;
  std::optional<UsbSession> session_;
  std::uint32_t run_;
  std::chrono::nanoseconds next_try_{0};
  std::optional<UsbStage> told_;
  bool timed_ = false;  // and told so
  std::atomic<bool> stopped_{false};
  DeviceNotices notices_;
};

}  // namespace reckon::haptics
