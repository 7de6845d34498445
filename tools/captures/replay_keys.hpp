// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keys of a replay: converts the characters of a terminal to changes of the schedule.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string_view>

#include "reckon/tools/captures/replay_schedule.hpp"

namespace reckon::tools {

/// Converts characters to changes of a schedule: space pauses and resumes, + and - double and halve
/// the rate, the arrows right and left jump by 10 s, q ends. Others are ignored.
class ReplayKeys {
 public:
  static constexpr std::chrono::seconds kLeap{10};
  static constexpr double kSlowest = 1.0 / 64;
  static constexpr double kFastest = 1024;
  static constexpr std::string_view kHelp =
      "keys: space pause, left and right 10 s, + and - speed, q end";

  /// Action that the caller has to take.
  enum class Demand : std::uint8_t {
    nothing,
    read_again,  ///< read the capture again from its beginning
    end
  };

  /// Takes one character from the terminal. An arrow is three (ESC [ C), which may arrive
  /// separately.
  [[nodiscard]] Demand press(char key, ReplaySchedule& schedule, std::chrono::nanoseconds now) {
    if (key == kEscape) {
      state_ = State::escape;
      return Demand::nothing;
    }
    if (state_ == State::escape && (key == '[' || key == 'O')) {
      state_ = State::sequence;
      return Demand::nothing;
    }
    if (state_ == State::sequence) {
      // Numbers before the letter state which modifier keys were held.
      if ((key >= '0' && key <= '9') || key == ';') return Demand::nothing;
      state_ = State::plain;
      if (key == 'C') return leap(schedule, kLeap, now);
      if (key == 'D') return leap(schedule, -kLeap, now);
      return Demand::nothing;
    }
    state_ = State::plain;
    return plain_key(key, schedule, now);
  }

 private:
  static constexpr char kEscape = '\x1b';
  static void change_rate(ReplaySchedule& schedule, double factor, std::chrono::nanoseconds now) {
    if (schedule.rate() <= 0) return;  // the rate is already unlimited
    const double rate = std::clamp(schedule.rate() * factor, ReplayKeys::kSlowest,
                                   std::max(ReplayKeys::kFastest, schedule.rate()));
    if (rate != schedule.rate()) schedule.set_rate(rate, now);
  }
  static ReplayKeys::Demand leap(ReplaySchedule& schedule, std::chrono::seconds step,
                                 std::chrono::nanoseconds now) {
    return schedule.seek(step, now) ? ReplayKeys::Demand::read_again : ReplayKeys::Demand::nothing;
  }

  enum class State : std::uint8_t { plain, escape, sequence };
  [[nodiscard]] Demand plain_key(char key, ReplaySchedule& schedule, std::chrono::nanoseconds now) {
    if (key == 'q') return Demand::end;
    if (key == ' ' && schedule.is_paused())
      schedule.resume(now);
    else if (key == ' ')
      schedule.pause(now);
    else if (key == '+' || key == '=')  // the same key without shift
      change_rate(schedule, 2, now);
    else if (key == '-')
      change_rate(schedule, 0.5, now);
    return Demand::nothing;
  }

  State state_ = State::plain;
};

}  // namespace reckon::tools
