// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An open device of the class HID PID: its uploaded effects and its last position.
#pragma once

#include <linux/input.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "reckon/haptics/hid/hid_calls.hpp"
#include "reckon/haptics/hid/pid_reports.hpp"

namespace reckon::haptics {

/// Failures return -errno. A report has reached the device when the call that sends it returns.
class HidDevice {
 public:
  /// Reads of PID Block Load until the device has created an effect or refused it.
  static constexpr int kTries = 60;
  /// Wait for a first input report if the device does not answer a request for one.
  static constexpr std::chrono::milliseconds kFirstReport{100};
  static constexpr std::size_t kMostEffects = 2;  ///< one wall on each side

  /// @param calls outlive the device @param file open descriptor
  HidDevice(HidCalls& calls, int file, std::string name, PidReports reports);

  [[nodiscard]] const PidReports& reports() const noexcept { return reports_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] int most_effects() const noexcept { return most_effects_; }
  /// Every axis of the device is known if fault() is empty.
  [[nodiscard]] const HidPlaces& places() const noexcept { return places_; }
  /// Why it cannot render the springs that walls need, as a sentence; empty: it can.
  [[nodiscard]] std::string fault() const;

  /// Locks the device against other programs, and clears all its effects.
  [[nodiscard]] int take() noexcept;
  /// Reads all pending input reports into places(). @return 0; -EAGAIN: no new values
  [[nodiscard]] int read() noexcept;
  /// Uploads a spring as EVIOCSFF does: with id -1 it is new and gets an id.
  [[nodiscard]] int upload(ff_effect& effect) noexcept;
  [[nodiscard]] int erase(int id) noexcept;
  [[nodiscard]] int play(int id, bool on) noexcept;
  [[nodiscard]] int set_full_gain() noexcept;

 private:
  struct Effect {
    std::uint8_t block = 0;  // 0: the slot is free
    std::array<ff_condition_effect, EventState::kAxes> sent{};
  };

  [[nodiscard]] int send(const HidReport& report) noexcept {
    return calls_.write(file_, report.span());
  }
  [[nodiscard]] int create(Effect& effect, std::chrono::milliseconds length) noexcept;
  [[nodiscard]] Effect* effect_of(int id) noexcept;
  [[nodiscard]] std::size_t axes() const noexcept { return reports_.axes()[1] ? 2 : 1; }
  void ask_for_places() noexcept;
  [[nodiscard]] bool says_where() const noexcept;

  HidCalls& calls_;
  int file_;
  std::string name_;
  PidReports reports_;
  int most_effects_ = kMostEffects;
  bool has_room_of_its_own_ = true;
  HidPlaces places_;
  std::array<Effect, kMostEffects> effects_;
};

}  // namespace reckon::haptics
