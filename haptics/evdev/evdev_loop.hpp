// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the thread of a force feedback device of Linux does: finds it, sets it up, tells it models
// that its books pay for, reads it, and finds it again.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/haptics/evdev/event_facts.hpp"
#include "reckon/haptics/evdev/event_state.hpp"
#include "reckon/haptics/passivity/wall_books.hpp"

namespace reckon::haptics {

/// One device. Its thread calls step() over and over; any thread may take the notices.
///
/// Walls are two effects, one for each side, which stay on the device and are changed in place. The
/// device ends them by itself kLength after they were last played, so that a program that hangs
/// leaves none; one that ends leaves none because the kernel erases the effects of a closed file. A
/// driver or a device that ignores the length of an effect keeps them until then.
///
/// The kernel takes a change at once and sends it as reports, one in each interval of the device's
/// endpoint or, where it is late with the next, in every other one; how many wait, it does not
/// tell. So changes wait here until they are surely there within the delay that is stated. Walls
/// are taken off without that wait.
class EvdevLoop {
 public:
  static constexpr std::chrono::milliseconds kRetry{500};  ///< between attempts
  /// Of an effect, which is played again a third of it later.
  static constexpr std::chrono::milliseconds kLength = kEffectLength;
  static constexpr std::chrono::milliseconds kBetween{4};  ///< changes of an effect, at least
  /// Between reports that a device takes which does not tell: that of USB at full speed.
  static constexpr std::chrono::milliseconds kReport{1};

  /// @param exchange outlives it  @param clock steady, that of the servo
  /// @throws std::invalid_argument as evdev_limits()
  EvdevLoop(EvdevExchange& exchange, const EvdevSettings& settings,
            std::unique_ptr<EventCalls> calls, std::function<std::chrono::nanoseconds()> clock);
  /// Takes the walls off.
  ~EvdevLoop();
  EvdevLoop(const EvdevLoop&) = delete;
  EvdevLoop& operator=(const EvdevLoop&) = delete;

  /// Waits for the device so long at most, and does what is due.
  void step(std::chrono::microseconds longest);
  /// Sentences since the last call, each once. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices();

 private:
  void attach();
  [[nodiscard]] std::string open();
  [[nodiscard]] std::string open_one(const std::string& path, bool by_path);
  [[nodiscard]] bool is_gone(int file) noexcept;
  [[nodiscard]] std::string set_up();
  void let_go() noexcept;
  void detach(const std::string& why);
  [[nodiscard]] bool read_events() noexcept;
  [[nodiscard]] int show(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] int show_in_turn(std::chrono::nanoseconds& now) noexcept;
  void judge(int result);
  [[nodiscard]] std::array<WallSide, SpringModel::kSides> sides_in_turn() const noexcept;
  [[nodiscard]] SpringModel wanted(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] PlaceRange places_of(std::size_t axis,
                                     std::chrono::nanoseconds longer) const noexcept;
  [[nodiscard]] SpringWall next_wall(std::size_t axis, WallSide side,
                                     const SpringWall& wanted) const noexcept;
  [[nodiscard]] int tell_side(WallSide side, const SpringModel& model,
                              std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] int tell_wall(std::size_t axis, WallSide side, const SpringWall& wall,
                              std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] int play(std::int32_t value) noexcept;
  [[nodiscard]] int look_again(std::chrono::nanoseconds& now) noexcept;
  [[nodiscard]] int play_one(const ff_effect& effect, std::int32_t value) noexcept;
  [[nodiscard]] int play_in_turn(std::chrono::nanoseconds& now, bool has_walls) noexcept;
  [[nodiscard]] std::string learn_interval(const std::string& path, int file);
  void line_up(int reports, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::chrono::nanoseconds later_than_stated(
      std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] bool is_soon_there(std::chrono::nanoseconds now) const noexcept;
  void publish(std::chrono::nanoseconds now) noexcept;
  void tell(std::string sentence);

  EvdevExchange& exchange_;
  EvdevSettings settings_;
  std::unique_ptr<EventCalls> calls_;
  std::function<std::chrono::nanoseconds()> clock_;
  int file_ = -1;
  EventFacts facts_;
  EventState state_;
  WallBooks books_;
  std::array<ff_effect, SpringModel::kSides> effects_{};  // as uploaded
  std::array<std::chrono::nanoseconds, SpringModel::kSides> changed_{};
  std::chrono::nanoseconds played_{0};
  std::chrono::nanoseconds placed_at_{0};       // of the newest place
  std::chrono::nanoseconds interval_{kReport};  // of reports that the device takes
  std::chrono::nanoseconds drained_{0};         // when it has all of them
  std::chrono::nanoseconds next_try_{0};
  std::string problem_;  // told already
  std::mutex telling_;   // never taken by the servo
  std::vector<std::string> notices_;
};

}  // namespace reckon::haptics
