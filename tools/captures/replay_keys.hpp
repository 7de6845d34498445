// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keys of a replay: converts the characters of a terminal to changes of the schedule.
#pragma once

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
  [[nodiscard]] Demand press(char key, ReplaySchedule& schedule, std::chrono::nanoseconds now);

 private:
  enum class State : std::uint8_t { plain, escape, sequence };
  [[nodiscard]] Demand plain_key(char key, ReplaySchedule& schedule, std::chrono::nanoseconds now);

  State state_ = State::plain;
};

}  // namespace reckon::tools
