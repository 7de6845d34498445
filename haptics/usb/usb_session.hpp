// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The protocol with a device after its set-up: commands, reports, and when the force is dropped.
// Pure: octets and time are passed in.
#pragma once

#include <algorithm>
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
  void take(std::span<const std::uint8_t> transfer, std::chrono::nanoseconds now) noexcept {
    while (driver_.read(transfer)) {
      if (!awaiting_) continue;
      awaiting_ = false;
      heard_at_ = now;
      if (stage_ == UsbStage::running && timed_ < kTimed) {
        longest_ = std::max(longest_, now - sent_at_);
        ++timed_;
      }
      answer(now);
    }
  }
  /// The command to send now, if any; valid until the next call. Call only while no command is
  /// being sent, and send the result at once.
  [[nodiscard]] std::optional<std::span<const std::uint8_t>> next(
      std::chrono::nanoseconds now) noexcept {
    if (awaiting_) {
      if (!is_late(now)) return std::nullopt;
      ++late_;
      leave(UsbStage::silent);
      awaiting_ = false;
      deaf_until_ = now + kPause;
      driver_.restart();
      return driver_.command(stage_, nullptr);
    }
    if (now < deaf_until_) return std::nullopt;

    exchange_.force.update();
    const UsbForce& newest = exchange_.force.read();
    const bool silent = newest.number == 0 || now - newest.at > kSilence;
    if (silent && !servo_silent_) end_run();
    servo_silent_ = silent;
    const bool shows = stage_ == UsbStage::running && !silent;
    sent_ = newest.number;
    sent_at_ = now;
    awaiting_ = true;
    const auto octets = driver_.command(stage_, shows ? &newest : nullptr);
    sent_share_ = driver_.share();
    return octets;
  }
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
  void end_run() noexcept { exchange_.ended_run.store(run_++, std::memory_order_release); }
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
  void answer(std::chrono::nanoseconds now) noexcept {
    UsbReading reading;
    reading.heard = now;
    reading.before = held_;
    reading.held = held_share_;
    held_ = sent_;
    held_share_ = sent_share_;
    const UsbStage stage = driver_.judge(stage_ == UsbStage::running, reading);
    if (stage != UsbStage::running) return leave(stage);
    stage_ = stage;
    if (servo_silent_) return;
    reading.after = sent_;
    reading.run = run_;
    exchange_.readings.push(reading);
  }
  void leave(UsbStage stage) noexcept {
    // The next command drops the force, and a new run of readings begins.
    if (stage_ == UsbStage::running) end_run();
    stage_ = stage;
  }

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
