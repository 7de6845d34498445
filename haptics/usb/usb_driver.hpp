// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The part of a USB device's driver that is specific to its kind. UsbLoop and UsbSession have the
// rest.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "reckon/haptics/usb/usb_exchange.hpp"
#include "reckon/haptics/usb/usb_limits.hpp"
#include "reckon/haptics/usb/usb_line.hpp"

namespace reckon::haptics {

/// Stage of a device.
enum class UsbStage : std::uint8_t {
  silent,   ///< no answer yet
  homing,   ///< its counts are no angles yet: no force
  outside,  ///< no pose has these counts, or it is near a singular one: no force
  running,  ///< forces are shown
};

/// Exchanges from a report to the middle of the time for which the next command is held. Torques
/// are computed for the predicted position at that instant.
inline constexpr double kUsbAhead = 1.5;

/// A line during the set-up of its device. All calls may block on the device.
class UsbSetUp {
 public:
  /// All arguments outlive this. @param tell reports a sentence to the user
  UsbSetUp(UsbLine& line, const std::function<std::chrono::nanoseconds()>& clock,
           const std::atomic<bool>& stopped, std::function<void(std::string)> tell);

  [[nodiscard]] UsbLine& line() noexcept { return line_; }
  [[nodiscard]] std::chrono::nanoseconds now() const { return clock_(); }
  /// False after a fault, or when the program ends.
  [[nodiscard]] bool goes_on() const noexcept;
  /// Waits for data, 0.5 ms at most.
  void wait() noexcept;
  /// @return whether the device has accepted these octets within 0.5 s
  [[nodiscard]] bool sends(std::span<const std::uint8_t> octets);
  void tell(std::string sentence) { tell_(std::move(sentence)); }

 private:
  UsbLine& line_;
  const std::function<std::chrono::nanoseconds()>& clock_;
  const std::atomic<bool>& stopped_;
  std::function<void(std::string)> tell_;
};

/// Driver of one kind of device, with the state of the attached one. For the thread of its UsbLoop
/// only. lost() and the functions after it allocate nothing.
class UsbDriver {
 public:
  virtual ~UsbDriver() = default;

  [[nodiscard]] virtual const UsbFacts& facts() const noexcept = 0;
  /// How the user homes it, as a sentence.
  [[nodiscard]] virtual const char* how_to_home() const noexcept = 0;
  /// Its endpoints. @return std::nullopt: another kind of device
  [[nodiscard]] virtual std::optional<UsbPipes> pipes(libusb_device_handle* handle) const = 0;
  /// Sets up a device whose line is open. @return the problem, as a sentence; empty: done
  [[nodiscard]] virtual std::string set_up(UsbSetUp& desk) = 0;

  /// The connection ended. @param is_unplugged the device may have lost its power
  virtual void lost(bool is_unplugged) noexcept = 0;
  /// Discards a partly received report.
  virtual void restart() noexcept = 0;
  /// Parses the front of a transfer and removes the parsed octets. @return whether a report is
  /// complete; if false, the whole transfer is parsed
  [[nodiscard]] virtual bool read(std::span<const std::uint8_t>& transfer) noexcept = 0;
  /// Evaluates the last report. Sets position, orientation, buttons, lever and step of the reading.
  /// @param follows whether the previous report was evaluated too, at stage `running`
  [[nodiscard]] virtual UsbStage judge(bool follows, UsbReading& reading) noexcept = 0;
  /// The command for a force; null: zero. If the motors cannot hold the torques, or the lever of
  /// the force does not cover them, the force is scaled down. @return valid until the next call
  [[nodiscard]] virtual std::span<const std::uint8_t> command(UsbStage stage,
                                                              const UsbForce* force) noexcept = 0;
  /// Share of the requested force that the last command has, [0, 1].
  [[nodiscard]] virtual double share() const noexcept = 0;
  /// Malformed octets since the start.
  [[nodiscard]] virtual std::uint64_t malformed() const noexcept = 0;

 protected:
  UsbDriver() = default;
  UsbDriver(const UsbDriver&) = default;
  UsbDriver& operator=(const UsbDriver&) = default;
};

}  // namespace reckon::haptics
