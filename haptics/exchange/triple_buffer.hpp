// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The only way state passes between the servo and the other loops: newest value wins, nobody waits.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace reckon::haptics {

/// Newest-value hand-over from one writer thread to one reader thread. Wait-free on both sides,
/// without retries: a reader that a preempted writer could make spin has no place in a servo.
/// T is any copyable type; nothing is allocated here. Cost: one atomic exchange a publication.
template <typename T>
class TripleBuffer {
 public:
  TripleBuffer() = default;
  /// Every slot starts as `initial`.
  explicit TripleBuffer(const T& initial) : slots_{initial, initial, initial} {}

  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;

  /// Writer: the slot to fill in place. It holds some older value, so write every field.
  [[nodiscard]] T& write_slot() noexcept { return slots_[back_]; }

  /// Writer: hands the filled slot over.
  void publish() noexcept {
    const std::uint8_t previous =
        middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel);
    back_ = previous & kIndex;
  }

  /// Writer: copies `value` in and hands it over.
  void write(const T& value) noexcept {
    write_slot() = value;
    publish();
  }

  /// Reader: takes the newest publication, if there is one since the last call.
  /// @return true when read() now shows a value not shown before.
  bool update() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader: the value taken by the last update(); it stays put until the next one.
  [[nodiscard]] const T& read() const noexcept { return slots_[front_]; }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;

  std::array<T, 3> slots_{};
  alignas(64) std::uint8_t back_ = 0;                 // writer's own
  alignas(64) std::atomic<std::uint8_t> middle_ = 1;  // handed over
  alignas(64) std::uint8_t front_ = 2;                // reader's own
};

}  // namespace reckon::haptics
