// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One tab as the stage knows it: the instant that it looks at, and what it has been told.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/viewer/history/history.hpp"

namespace reckon::tools {

/// What a tab does with time.
enum class PlayState : std::uint8_t { live, playing, paused, end };

/// Plain data, changed by ViewStage alone.
struct Watcher {
  /// Pictures that may be on their way: sent, and not yet drawn. To a tab that draws them late, on
  /// a slow line say, one is: the second would only be older when it is drawn.
  static constexpr std::size_t kCredit = 2, kLateCredit = 1;
  /// Ticks from sending to drawing: of a tab that is late from now on, and that no longer is.
  static constexpr std::uint64_t kLate = 8, kInTime = 3;

  std::uint64_t number = 0;  ///< never the same twice
  bool may_push = false;

  PlayState state = PlayState::live;
  double speed = 1;
  std::chrono::nanoseconds time{};      ///< that it looks at, unless live
  std::chrono::nanoseconds advanced{};  ///< when `time` was moved on last
  std::unique_ptr<History::Cursor> cursor;
  std::optional<std::chrono::nanoseconds> shown;  ///< instant of the last picture
  bool needs_picture = true;                      ///< though time stands still
  std::uint64_t gaps = 0;                         ///< of the source that it was told of
  std::vector<std::uint32_t> under_way;           ///< numbers of pictures
  std::size_t credit = kCredit;                   ///< of them
  std::uint64_t tick = 0;                         ///< of the last picture

  bool greeted = false, knows_origin = false, knows_touch = false, knows_state = false;
  std::uint32_t epoch = 0;         ///< of the roster that it has
  std::uint64_t notes = 0;         ///< that it has, counted from the first
  std::uint64_t numbers_tick = 0;  ///< of the last numbers
  std::uint64_t cells_tick = 0, groups_tick = 0;
  std::string cells, groups;  ///< messages that it has
  std::uint16_t follow = kNoNumber;
  std::optional<std::uint16_t> hand;
  std::string answer;  ///< about a hand, to be sent
};

}  // namespace reckon::tools
