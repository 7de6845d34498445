// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the keys of a terminal do to a replay: the characters it sends, one by one, and the
// schedule.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "reckon/tools/captures/replay_schedule.hpp"

namespace reckon::tools {

/// Turns characters into changes of a schedule: space pauses and goes on, + and - double and halve
/// the rate, the arrows right and left leap by 10 s, q ends. Others do nothing.
class ReplayKeys {
 public:
  static constexpr std::chrono::seconds kLeap{10};
  static constexpr double kSlowest = 1.0 / 64;
  static constexpr double kFastest = 1024;
  static constexpr std::string_view kHelp =
      "keys: space pause, left and right 10 s, + and - speed, q end";

  /// What the caller has to do.
  enum class Demand : std::uint8_t {
    nothing,
    read_again,  ///< the capture, from its beginning
    end
  };

  /// One character as the terminal sent it; an arrow is three (ESC [ C), at any times.
  [[nodiscard]] Demand press(char key, ReplaySchedule& schedule, std::chrono::nanoseconds now);

 private:
  enum class State : std::uint8_t { plain, escape, sequence };
  [[nodiscard]] Demand plain_key(char key, ReplaySchedule& schedule, std::chrono::nanoseconds now);

  State state_ = State::plain;
};

}  // namespace reckon::tools
