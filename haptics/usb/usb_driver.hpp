// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What one kind of device on USB knows that no other does. UsbLoop and UsbSession have the rest.
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

/// How far a device is.
enum class UsbStage : std::uint8_t {
  silent,   ///< has not answered yet
  homing,   ///< its counts are no angles yet: no force
  outside,  ///< its counts are no pose, or one near a singular one: no force
  running,  ///< forces are shown
};

/// Exchanges from a report to the middle of the time for which the command after it is held: a
/// torque is computed for where the handle will be then.
inline constexpr double kUsbAhead = 1.5;

/// A line on which a device is set up. All calls may wait for the device.
class UsbSetUp {
 public:
  /// All of it outlives this. @param tell takes sentences for the user
  UsbSetUp(UsbLine& line, const std::function<std::chrono::nanoseconds()>& clock,
           const std::atomic<bool>& stopped, std::function<void(std::string)> tell);

  [[nodiscard]] UsbLine& line() noexcept { return line_; }
  [[nodiscard]] std::chrono::nanoseconds now() const { return clock_(); }
  /// False after a fault, or where the program ends.
  [[nodiscard]] bool goes_on() const noexcept;
  /// Waits for what comes, 0.5 ms at most.
  void wait() noexcept;
  /// @return whether the device has taken these octets, within 0.5 s
  [[nodiscard]] bool sends(std::span<const std::uint8_t> octets);
  void tell(std::string sentence) { tell_(std::move(sentence)); }

 private:
  UsbLine& line_;
  const std::function<std::chrono::nanoseconds()>& clock_;
  const std::atomic<bool>& stopped_;
  std::function<void(std::string)> tell_;
};

/// One kind of device, and the one that is attached. The thread of its UsbLoop alone calls it. From
/// lost() on none of it allocates.
class UsbDriver {
 public:
  virtual ~UsbDriver() = default;

  [[nodiscard]] virtual const UsbFacts& facts() const noexcept = 0;
  /// How to home it: a sentence.
  [[nodiscard]] virtual const char* how_to_home() const noexcept = 0;
  /// Where its octets go. @return nothing where this is another device
  [[nodiscard]] virtual std::optional<UsbPipes> pipes(libusb_device_handle* handle) const = 0;
  /// Readies a device whose line is open. @return what is in the way, as a sentence; empty: nothing
  [[nodiscard]] virtual std::string set_up(UsbSetUp& desk) = 0;

  /// The line ended. @param is_unplugged it may have lost its power
  virtual void lost(bool is_unplugged) noexcept = 0;
  /// What came of a report so far is forgotten.
  virtual void restart() noexcept = 0;
  /// Reads on in a transfer: takes what it reads off the front of it. @return whether a report has
  /// ended; if not, all is read
  [[nodiscard]] virtual bool read(std::span<const std::uint8_t>& transfer) noexcept = 0;
  /// What the last report says. Of the reading it sets position, orientation, buttons, lever, step.
  /// @param follows whether the one before was read too, and its device was running
  [[nodiscard]] virtual UsbStage judge(bool follows, UsbReading& reading) noexcept = 0;
  /// The octets that ask for a force; null: none. Where its motors cannot hold the torques, or not
  /// so much is paid for, all of it is less. @return valid until the next call
  [[nodiscard]] virtual std::span<const std::uint8_t> command(UsbStage stage,
                                                              const UsbForce* force) noexcept = 0;
  /// Share of the last command's force that was asked for, [0, 1].
  [[nodiscard]] virtual double share() const noexcept = 0;
  /// Octets that were no reports, since the begin.
  [[nodiscard]] virtual std::uint64_t malformed() const noexcept = 0;

 protected:
  UsbDriver() = default;
  UsbDriver(const UsbDriver&) = default;
  UsbDriver& operator=(const UsbDriver&) = default;
};

}  // namespace reckon::haptics
