// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The talk with a device that is set up: what it is told, what its reports mean, and when its force
// has to be dropped. Pure: octets and time are passed in.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/haptics/usb/usb_driver.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"

namespace reckon::haptics {

/// One command at a time, one report in answer, of the instant from which the command holds. The
/// device's thread alone calls it; no allocation.
///
/// The force is dropped, and the run of readings ends, where the servo has not written for
/// kSilence, a report has not come for kLate, or the stage is not `running`. It comes back by
/// itself: the servo, whose readings failed meanwhile, lets its contacts ramp up.
class UsbSession {
 public:
  /// With an exchange of 2 ms a zero is at the device 10 ms after the servo's last write.
  static constexpr std::chrono::milliseconds kSilence{8};
  /// An exchange takes 2 ms. Later than this the command is answered for by a zero.
  static constexpr std::chrono::milliseconds kLate{6};
  /// Then reports that are under way belong to no command, and are not listened to.
  static constexpr std::chrono::milliseconds kPause{20};
  /// Without a report for so long it has to be set up anew.
  static constexpr std::chrono::milliseconds kLost{200};

  /// @param exchange, driver outlive it  @param run of the first readings  @param now of its begin
  UsbSession(UsbExchange& exchange, UsbDriver& driver, std::uint32_t run,
             std::chrono::nanoseconds now) noexcept
      : exchange_(exchange), driver_(driver), run_(run), heard_at_(now) {}

  /// A transfer that the device sent.
  void take(std::span<const std::uint8_t> transfer, std::chrono::nanoseconds now) noexcept;
  /// What to tell the device now, if anything: valid until the next call. Call while nothing is on
  /// its way to it, and send the answer at once.
  [[nodiscard]] std::optional<std::span<const std::uint8_t>> next(
      std::chrono::nanoseconds now) noexcept;
  /// Whether a report is overdue.
  [[nodiscard]] bool is_late(std::chrono::nanoseconds now) const noexcept {
    return awaiting_ && now - sent_at_ > kLate;
  }
  /// Whether it has to be set up anew.
  [[nodiscard]] bool is_lost(std::chrono::nanoseconds now) const noexcept {
    return now - heard_at_ > kLost;
  }
  [[nodiscard]] UsbStage stage() const noexcept { return stage_; }
  /// The line is gone: what was read tells no place any more. Its last call.
  void end_run() noexcept;
  /// Of the readings that it gives next.
  [[nodiscard]] std::uint32_t run() const noexcept { return run_; }
  /// Reports that came too late, since the begin.
  [[nodiscard]] std::uint64_t late() const noexcept { return late_; }
  /// Longest of the first kTimed exchanges; 0: there were not so many yet.
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
  std::int64_t sent_ = 0;                       // number of the force that was sent last
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
