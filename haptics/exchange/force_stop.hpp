// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The software stop: one switch for the forces of all hands of a program.
#pragma once

#include <atomic>
#include <cstdint>

namespace reckon::haptics {

/// Cause of the last change of the software stop.
enum class StopCause : std::uint8_t { none, program, signal, key, button };

/// Any thread or signal handler may press and release it; every servo that uses it checks it in
/// each step. While it is pressed, no hand has a force. Never blocks, allocates or fails.
///
///     ForceStop stop;
///     config.stop = &stop;           // of each ServoConfig
///     stop.press(StopCause::program);
class ForceStop {
 public:
  /// State at one instant.
  struct State {
    bool pressed = false;
    std::uint32_t presses = 0;  ///< since its construction; counts to 2^23 and starts again at 0
    StopCause cause = StopCause::none;  ///< of the last change
  };

  /// No effect while it is pressed.
  void press(StopCause cause) noexcept { change(cause, 0); }
  /// No effect while it is released.
  void release(StopCause cause) noexcept { change(cause, 1); }
  /// Presses it if it is released, and releases it if it is pressed.
  void toggle(StopCause cause) noexcept {
    std::uint32_t seen = word_.load(std::memory_order_relaxed);
    while (!word_.compare_exchange_weak(seen, after(seen, cause))) {
    }
  }

  [[nodiscard]] bool is_pressed() const noexcept { return (changes() & 1U) != 0; }
  /// Number of presses and releases since its construction: odd while it is pressed.
  [[nodiscard]] std::uint32_t changes() const noexcept { return word_.load() >> kCauseBits; }
  [[nodiscard]] State state() const noexcept {
    const std::uint32_t word = word_.load();
    const std::uint32_t changes = word >> kCauseBits;
    return {(changes & 1U) != 0, (changes + 1) / 2,
            static_cast<StopCause>(word & ((1U << kCauseBits) - 1))};
  }

 private:
  static constexpr unsigned kCauseBits = 8;

  [[nodiscard]] static std::uint32_t after(std::uint32_t word, StopCause cause) noexcept {
    return (((word >> kCauseBits) + 1) << kCauseBits) | static_cast<std::uint32_t>(cause);
  }
  // Changes it if the count of changes has this lowest bit.
  void change(StopCause cause, std::uint32_t lowest) noexcept {
    std::uint32_t seen = word_.load(std::memory_order_relaxed);
    while (((seen >> kCauseBits) & 1U) == lowest &&
           !word_.compare_exchange_weak(seen, after(seen, cause))) {
    }
  }

  // Count of changes, then the cause of the last one: one word, so that a signal handler may change
  // it.
  std::atomic<std::uint32_t> word_{0};
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);
};

}  // namespace reckon::haptics
