// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// State of one tab in the stage: the instant that it shows, and the messages that it has.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/viewer/history/history.hpp"
#include "reckon/tools/viewer/picture_sender.hpp"

namespace reckon::tools {

/// Playback state of a tab.
enum class PlayState : std::uint8_t { live, playing, paused, end };

/// Plain data, changed by ViewStage only.
struct Watcher {
  /// Limit of pictures that are sent and not yet drawn. A tab that draws late, for example on a
  /// slow connection, gets one at a time: a second would only be older when drawn.
  static constexpr std::size_t kCredit = 2, kLateCredit = 1;
  /// Ticks from sending to drawing: from kLate on a tab is late, up to kInTime it no longer is.
  static constexpr std::uint64_t kLate = 8, kInTime = 3;

  std::uint64_t number = 0;  ///< unique
  bool may_push = false;

  PlayState state = PlayState::live;
  double speed = 1;
  std::chrono::nanoseconds time{};      ///< shown instant, unless live
  std::chrono::nanoseconds advanced{};  ///< last change of `time` by playback
  std::unique_ptr<History::Cursor> cursor;
  std::optional<std::chrono::nanoseconds> shown;  ///< instant of the last picture
  bool needs_picture = true;                      ///< even if time does not advance
  PictureSender pictures;
  std::uint64_t gaps = 0;                ///< of the source, up to the last picture
  std::vector<std::uint32_t> under_way;  ///< numbers of pictures sent and not drawn
  std::size_t credit = kCredit;          ///< limit of under_way
  std::uint64_t tick = 0;                ///< of the last picture

  bool greeted = false, knows_origin = false, knows_touch = false, knows_state = false;
  std::uint32_t epoch = 0;  ///< of the roster sent to it
  std::uint64_t notes = 0;  ///< sent to it, counted from the first
  /// Of the last numbers, and of the last look at the owners of bodies.
  std::uint64_t numbers_tick = 0, owners_tick = 0;
  std::uint64_t cells_tick = 0, groups_tick = 0;
  std::string cells, groups;  ///< last messages sent
  std::shared_ptr<const std::string> owners;
  std::uint16_t follow = kNoNumber;
  std::optional<std::uint16_t> hand;
  std::string answer;  ///< pending answer about a hand
};

}  // namespace reckon::tools
