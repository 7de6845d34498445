// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The protocol with a device after its set-up: commands, reports, and when the force is dropped.
// Pure: octets and time are passed in.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/haptics/usb/usb_driver.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"

namespace reckon::haptics {

/// One command at a time, answered by one report of the instant from which the command is held. For
/// the device's thread only; no allocation.
///
/// The force is dropped, and the run of readings ends, if the servo has not written for kSilence,
/// no report has arrived for kLate, or the stage is not `running`. The force resumes by itself:
/// readings have failed meanwhile, so the servo ramps its contacts up.
class UsbSession {
 public:
  /// With an exchange of 2 ms, a zero force is at the device 10 ms after the servo's last write.
  static constexpr std::chrono::milliseconds kSilence{8};
  /// An exchange takes 2 ms. If the report is later than this, a zero force follows the command.
  static constexpr std::chrono::milliseconds kLate{6};
  /// After that, reports in flight belong to no command and are ignored for so long.
  static constexpr std::chrono::milliseconds kPause{20};
  /// Without a report for so long, the device must be set up again.
  static constexpr std::chrono::milliseconds kLost{200};

  /// @param exchange, driver outlive it @param run of the first readings @param now start of the
  /// session
  UsbSession(UsbExchange& exchange, UsbDriver& driver, std::uint32_t run,
             std::chrono::nanoseconds now) noexcept
      : exchange_(exchange), driver_(driver), run_(run), heard_at_(now) {}

  /// Handles a received transfer.
  void take(std::span<const std::uint8_t> transfer, std::chrono::nanoseconds now) noexcept;
  /// The command to send now, if any; valid until the next call. Call only while no command is
  /// being sent, and send the result at once.
  [[nodiscard]] std::optional<std::span<const std::uint8_t>> next(
      std::chrono::nanoseconds now) noexcept;
  /// Whether a report is overdue.
  [[nodiscard]] bool is_late(std::chrono::nanoseconds now) const noexcept {
    return awaiting_ && now - sent_at_ > kLate;
  }
  /// Whether the device must be set up again.
  [[nodiscard]] bool is_lost(std::chrono::nanoseconds now) const noexcept {
    return now - heard_at_ > kLost;
  }
  [[nodiscard]] UsbStage stage() const noexcept { return stage_; }
  /// Ends the run: the connection is lost, and earlier readings are invalid. Only run() may follow.
  void end_run() noexcept;
  /// Run number of the next readings.
  [[nodiscard]] std::uint32_t run() const noexcept { return run_; }
  /// Reports that were late, since the start.
  [[nodiscard]] std::uint64_t late() const noexcept { return late_; }
  /// Longest of the first kTimed exchanges; 0: fewer so far.
  [[nodiscard]] std::chrono::nanoseconds exchange_time() const noexcept {
    return timed_ < kTimed ? std::chrono::nanoseconds(0) : longest_;
  }
  static constexpr int kTimed = 500;

 private:
  void answer(std::chrono::nanoseconds now) noexcept;
  void leave(UsbStage stage) noexcept;

  UsbExchange& exchange_;
  UsbDriver& driver_;
  std::uint32_t run_;
  std::chrono::nanoseconds heard_at_;
  UsbStage stage_ = UsbStage::silent;
  std::int64_t held_ = 0;                       // number of the force that the device holds
  std::int64_t sent_ = 0;                       // number of the last force sent
  double held_share_ = 1.0, sent_share_ = 1.0;  // of these forces
  std::chrono::nanoseconds sent_at_{0};
  std::chrono::nanoseconds deaf_until_{0};
  bool awaiting_ = false;
  bool servo_silent_ = true;
  std::uint64_t late_ = 0;
  int timed_ = 0;
  std::chrono::nanoseconds longest_{0};
};

}  // namespace reckon::haptics
