// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The effects by which a force feedback device of Linux is told walls: what they are next, what
// that costs, when they are told and when they are played.
#pragma once

#include <linux/input.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/haptics/evdev/event_facts.hpp"
#include "reckon/haptics/evdev/event_state.hpp"
#include "reckon/haptics/passivity/wall_books.hpp"

namespace reckon::haptics {

/// Walls are two effects, one for each side, which stay on the device and are changed in place. The
/// device ends them by itself kLength after they were last played, so that a program that hangs
/// leaves none; one that ends leaves none because the kernel erases the effects of a closed file,
/// but of a device that it does not drive. A driver or a device that ignores the length of an
/// effect keeps them until then.
///
/// The kernel takes a change at once and sends it as reports, one in each interval of the device's
/// endpoint or, where it is late with the next, in every other one; how many wait, it does not
/// tell. So changes wait here until they are surely there within the delay that is stated, counted
/// from when the handle was where the newest reading has it. At most two are on their way: what is
/// stated beyond that is the device's, for what it does with a report. Walls are taken off without
/// that wait.
///
/// Where calls wait for the device, nothing is on its way when they return, but any of them may
/// take long. So each report then follows a reading of its own.
///
/// All of it belongs to the device's thread. Results are those of EventCalls.
class WallEffects {
 public:
  /// Of an effect, which is played again a third of it later.
  static constexpr std::chrono::milliseconds kLength = kEffectLength;
  static constexpr std::chrono::milliseconds kBetween{4};  ///< changes of an effect, at least
  static constexpr int kReportsOfAChange = 2;  ///< a condition for each of two axes, always
  static constexpr int kTurns = 2;             ///< of the endpoint, until a report is surely there
  /// At least, of the stated delay, until the device does what it has been told.
  static constexpr std::chrono::milliseconds kReaction{1};
  /// Reads the device again, for `state`, and says when that was. @return -ENODEV: it is gone
  using Look = std::function<int(std::chrono::nanoseconds& now)>;

  /// @param calls, facts, state of the device that is open; they outlive it
  WallEffects(EventCalls& calls, const EvdevSettings& settings, const EventFacts& facts,
              const EventState& state, std::function<std::chrono::nanoseconds()> clock, Look look);

  /// Uploads both, without walls. @param interval of the reports that it takes, > 0
  /// @param age that a place may have when it is read
  [[nodiscard]] int begin(int file, std::chrono::nanoseconds interval,
                          std::chrono::nanoseconds age) noexcept;
  [[nodiscard]] int play() noexcept;
  /// Takes them off; where there are none, nothing.
  void end() noexcept;
  /// What is due of these walls. @param now of the newest reading
  [[nodiscard]] int show(const SpringModel& asked, std::chrono::nanoseconds& now) noexcept;
  [[nodiscard]] const WallBooks& books() const noexcept { return books_; }

 private:
  using Sides = std::array<WallSide, SpringModel::kSides>;

  [[nodiscard]] int show_at_once(const SpringModel& asked, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] int show_in_turn(const SpringModel& asked, std::chrono::nanoseconds& now) noexcept;
  [[nodiscard]] Sides sides_in_turn() const noexcept;
  [[nodiscard]] PlaceRange places_of(std::size_t axis,
                                     std::chrono::nanoseconds longer) const noexcept;
  [[nodiscard]] SpringWall next_wall(std::size_t axis, WallSide side,
                                     const SpringWall& wanted) const noexcept;
  [[nodiscard]] int tell_side(WallSide side, const SpringModel& model,
                              std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] int tell_wall(std::size_t axis, WallSide side, const SpringWall& wall,
                              std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] int look_again(std::chrono::nanoseconds& now) noexcept;
  [[nodiscard]] int play_all(std::int32_t value) noexcept;
  [[nodiscard]] int play_one(const ff_effect& effect, std::int32_t value) noexcept;
  [[nodiscard]] int play_in_turn(std::chrono::nanoseconds& now, bool has_walls) noexcept;
  void line_up(int reports, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::chrono::nanoseconds left_of_delay() const noexcept;
  [[nodiscard]] std::chrono::nanoseconds longest_wait() const noexcept;
  [[nodiscard]] std::chrono::nanoseconds later_than_stated(
      std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] bool is_soon_there(std::chrono::nanoseconds now) const noexcept;

  EventCalls& calls_;
  const EvdevSettings& settings_;
  const EventFacts& facts_;
  const EventState& state_;
  std::function<std::chrono::nanoseconds()> clock_;
  Look look_;
  int file_ = -1;
  WallBooks books_;
  std::array<ff_effect, SpringModel::kSides> effects_{};  // as uploaded
  std::array<std::chrono::nanoseconds, SpringModel::kSides> changed_{};
  std::chrono::nanoseconds played_{0};
  std::chrono::nanoseconds interval_{0};  // of reports that the device takes
  std::chrono::nanoseconds age_{0};       // of a place when it is read, at most
  std::chrono::nanoseconds drained_{0};   // when it has all of them
};

}  // namespace reckon::haptics
