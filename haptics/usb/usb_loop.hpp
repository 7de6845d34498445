// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The session of a device on USB: finds it, sets it up and exchanges forces and readings.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "reckon/haptics/devices/device_session.hpp"
#include "reckon/haptics/usb/usb_driver.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"
#include "reckon/haptics/usb/usb_line.hpp"
#include "reckon/haptics/usb/usb_session.hpp"

namespace reckon::haptics {

/// How a UsbLoop finds its device.
struct UsbLoopOptions {
  std::function<std::chrono::nanoseconds()> clock;  ///< steady clock of the servo's writes
  UsbOpener open;                                   ///< empty: opens the first attached device
  bool discover = true;                             ///< see UsbContext
};

/// Session of one device, run by its thread.
class UsbLoop final : public DeviceSession {
 public:
  static constexpr std::chrono::milliseconds kRetry{200};  ///< between attempts

  /// @param exchange outlives it @throws std::runtime_error if the host has no USB
  UsbLoop(UsbExchange& exchange, std::unique_ptr<UsbDriver> driver, UsbLoopOptions options);
  /// Sends the device a zero force; blocks 10 ms at most.
  ~UsbLoop() override;

  /// Stage of the device; std::nullopt: none is set up. Only on the thread of step().
  [[nodiscard]] std::optional<UsbStage> stage() const noexcept;
  void stop() noexcept override { stopped_.store(true, std::memory_order_relaxed); }

 private:
  [[nodiscard]] std::string name() const override { return driver_->facts().name; }
  [[nodiscard]] bool is_open() const noexcept override { return line_.has_value(); }
  [[nodiscard]] std::string open() override;
  void opened(std::chrono::nanoseconds now, std::string& problem) override;
  void wait(std::chrono::microseconds longest) override { context_.wait(longest); }
  void exchange(std::chrono::microseconds longest) override;
  void detach(const std::string& why);
  void tell_stage();

  UsbExchange& exchange_;
  std::unique_ptr<UsbDriver> driver_;
  UsbOpener opener_;
  bool discover_;
  UsbContext context_;
  std::optional<UsbLine> line_;
  std::optional<UsbSession> session_;
  std::uint32_t run_;
  std::optional<UsbStage> told_;
  bool timed_ = false;  // the exchange time has been reported
  std::atomic<bool> stopped_{false};
};

}  // namespace reckon::haptics
