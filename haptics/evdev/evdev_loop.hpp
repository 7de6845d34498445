// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The session of a force feedback device of Linux: finds it, sets it up, uploads the models that
// its energy books can pay for, and reads it.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "reckon/haptics/devices/device_session.hpp"
#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/haptics/evdev/event_facts.hpp"
#include "reckon/haptics/evdev/event_state.hpp"
#include "reckon/haptics/evdev/wall_effects.hpp"

namespace reckon::haptics {

/// Session of one device, run by its thread.
class EvdevLoop final : public DeviceSession {
 public:
  static constexpr std::chrono::milliseconds kRetry{500};                     ///< between attempts
  static constexpr std::chrono::milliseconds kLength = WallEffects::kLength;  ///< of an effect
  /// Assumed interval of reports to a device that does not declare it: a frame of USB at full
  /// speed.
  static constexpr std::chrono::milliseconds kReport{1};

  /// @param exchange outlives it @param time steady clock of the servo
  /// @throws std::invalid_argument as evdev_limits()
  EvdevLoop(EvdevExchange& exchange, const EvdevSettings& settings,
            std::unique_ptr<EventCalls> calls, SteadyTime time);
  /// Removes the walls.
  ~EvdevLoop() override;

 private:
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] bool is_open() const noexcept override { return file_ >= 0; }
  [[nodiscard]] std::string open() override;
  void opened(std::chrono::nanoseconds now, std::string& problem) override;
  void wait(std::chrono::microseconds longest) override;
  void exchange(std::chrono::microseconds longest) override;
  [[nodiscard]] std::string open_one(const std::string& path, bool by_path);
  [[nodiscard]] bool is_gone(int file) noexcept;
  [[nodiscard]] std::string set_up();
  void close_device() noexcept;
  void detach(const std::string& why);
  [[nodiscard]] bool read_events() noexcept;
  [[nodiscard]] int look(std::chrono::nanoseconds& now) noexcept;
  [[nodiscard]] SpringModel wanted(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::string learn_intervals(const std::string& path, int file);
  void publish(std::chrono::nanoseconds now) noexcept;

  EvdevExchange& exchange_;
  EvdevSettings settings_;
  std::unique_ptr<EventCalls> calls_;
  int file_ = -1;
  EventFacts facts_;
  EventState state_;
  std::chrono::nanoseconds interval_{kReport};  // of reports to the device
  std::chrono::nanoseconds age_{kReport};       // greatest age of a position when it is read
  WallEffects walls_;
  std::chrono::nanoseconds placed_at_{0};  // of the newest position
};

}  // namespace reckon::haptics
