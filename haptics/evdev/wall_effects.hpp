// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Renders walls as evdev condition effects: next effect, its energy cost, upload and play times.
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

/// Walls are two effects, one for each side. They stay on the device and are changed in place. The
/// device ends them kLength after they were last played, so a program that hangs leaves no walls.
/// When a program ends, the kernel erases the effects of its closed file, except on a device that
/// it does not drive. A driver or device that ignores the length of effects keeps them until then.
///
/// The kernel queues a change and sends it as reports, one in each interval of the device's
/// endpoint or, if it is late, in every other one. The queue length is unknown, so a change is sent
/// only when it will arrive within the declared delay, counted from the instant of the newest
/// position. At most two changes are in flight: the rest of the declared delay is for the device
/// itself. Walls are removed without that wait.
///
/// If calls wait for the device, nothing is in flight when they return, but any of them may take
/// long. So a new reading then precedes each report.
///
/// For the device's thread only. Returns results of EventCalls.
class WallEffects {
 public:
  /// Duration of an effect, which is replayed after a third of it.
  static constexpr std::chrono::milliseconds kLength = kEffectLength;
  static constexpr std::chrono::milliseconds kBetween{
      4};                                      ///< least time between two changes of an effect
  static constexpr int kReportsOfAChange = 2;  ///< always a condition for each of two axes
  static constexpr int kTurns =
      2;  ///< intervals of the endpoint within which a report surely arrives
  /// Least part of the declared delay that is left for the device to act on a report.
  static constexpr std::chrono::milliseconds kReaction{1};
  /// Reads the device again into `state`, and sets `now` to that time. @return -ENODEV: it is gone
  using Look = std::function<int(std::chrono::nanoseconds& now)>;

  /// @param calls, facts, state of the open device; they outlive this object
  WallEffects(EventCalls& calls, const EvdevSettings& settings, const EventFacts& facts,
              const EventState& state, std::function<std::chrono::nanoseconds()> clock, Look look);

  /// Uploads both effects without walls. @param interval of reports to the device, > 0
  /// @param greatest age of a position when it is read
  [[nodiscard]] int begin(int file, std::chrono::nanoseconds interval,
                          std::chrono::nanoseconds age) noexcept;
  [[nodiscard]] int play() noexcept;
  /// Stops and erases the effects, if any.
  void end() noexcept;
  /// Uploads and plays the due effects of these walls. @param now time of the newest reading;
  /// updated by further readings
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
  std::chrono::nanoseconds interval_{0};  // of reports to the device
  std::chrono::nanoseconds age_{0};       // greatest age of a position when it is read
  std::chrono::nanoseconds drained_{0};   // when the device has received all of them
};

}  // namespace reckon::haptics
