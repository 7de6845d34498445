// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/usb/usb_session.hpp"

#include <algorithm>

namespace reckon::haptics {

using std::chrono::nanoseconds;

void UsbSession::take(std::span<const std::uint8_t> transfer, nanoseconds now) noexcept {
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

void UsbSession::answer(nanoseconds now) noexcept {
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

void UsbSession::end_run() noexcept {
  exchange_.ended_run.store(run_++, std::memory_order_release);
}

// The next command drops the force, and a new run of readings begins.
void UsbSession::leave(UsbStage stage) noexcept {
  if (stage_ == UsbStage::running) end_run();
  stage_ = stage;
}

std::optional<std::span<const std::uint8_t>> UsbSession::next(nanoseconds now) noexcept {
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

}  // namespace reckon::haptics
