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
#include <string>
#include <vector>

#include "reckon/haptics/devices/device_notices.hpp"
#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/haptics/evdev/event_facts.hpp"
#include "reckon/haptics/evdev/event_state.hpp"
#include "reckon/haptics/evdev/wall_effects.hpp"

namespace reckon::haptics {

/// One device. Its thread calls step() over and over; any thread may take the notices.
class EvdevLoop {
 public:
  static constexpr std::chrono::milliseconds kRetry{500};                     ///< between attempts
  static constexpr std::chrono::milliseconds kLength = WallEffects::kLength;  ///< of an effect
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
  [[nodiscard]] std::vector<std::string> take_notices() { return notices_.take(); }

 private:
  void attach();
  [[nodiscard]] std::string open();
  [[nodiscard]] std::string open_one(const std::string& path, bool by_path);
  [[nodiscard]] bool is_gone(int file) noexcept;
  [[nodiscard]] std::string set_up();
  void let_go() noexcept;
  void detach(const std::string& why);
  [[nodiscard]] bool read_events() noexcept;
  [[nodiscard]] int look(std::chrono::nanoseconds& now) noexcept;
  [[nodiscard]] SpringModel wanted(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::string learn_intervals(const std::string& path, int file);
  void publish(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::string name() const;

  EvdevExchange& exchange_;
  EvdevSettings settings_;
  std::unique_ptr<EventCalls> calls_;
  std::function<std::chrono::nanoseconds()> clock_;
  int file_ = -1;
  EventFacts facts_;
  EventState state_;
  std::chrono::nanoseconds interval_{kReport};  // of reports that the device takes
  std::chrono::nanoseconds age_{kReport};       // of a place when it is read, at most
  WallEffects walls_;
  std::chrono::nanoseconds placed_at_{0};  // of the newest place
  std::chrono::nanoseconds next_try_{0};
  DeviceNotices notices_;
};

}  // namespace reckon::haptics
