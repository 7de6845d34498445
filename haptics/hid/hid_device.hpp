// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An open device of the class HID PID: the effects that it was told, and where it says that it is.
#pragma once

#include <linux/input.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "reckon/haptics/hid/hid_calls.hpp"
#include "reckon/haptics/hid/pid_reports.hpp"

namespace reckon::haptics {

/// What fails returns -errno. Each report that it sends has reached the device when the call
/// returns.
class HidDevice {
 public:
  /// What asking for an effect may take until the device has it or has no room.
  static constexpr int kTries = 60;
  /// That a device has to say where it is, unless it is asked.
  static constexpr std::chrono::milliseconds kFirstReport{100};
  static constexpr std::size_t kMostEffects = 2;  ///< walls on both sides

  /// @param calls outlive it  @param file that is open
  HidDevice(HidCalls& calls, int file, std::string name, PidReports reports);

  [[nodiscard]] const PidReports& reports() const noexcept { return reports_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] int most_effects() const noexcept { return most_effects_; }
  /// Of each axis that it has, unless fault() says otherwise.
  [[nodiscard]] const HidPlaces& places() const noexcept { return places_; }
  /// Why it gives no springs as walls need them, as a sentence; empty: it does.
  [[nodiscard]] std::string fault() const;

  /// Takes it from other programs, and all effects from it.
  [[nodiscard]] int take() noexcept;
  /// The newest of what it has sent since. @return -EAGAIN: nothing
  [[nodiscard]] int read() noexcept;
  /// As EVIOCSFF, of a spring: a new one gets its id.
  [[nodiscard]] int upload(ff_effect& effect) noexcept;
  [[nodiscard]] int erase(int id) noexcept;
  [[nodiscard]] int play(int id, bool on) noexcept;
  [[nodiscard]] int set_full_gain() noexcept;

 private:
  struct Effect {
    std::uint8_t block = 0;  // 0: there is none
    std::array<ff_condition_effect, EventState::kAxes> told{};
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
