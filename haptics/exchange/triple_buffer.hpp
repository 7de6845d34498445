// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The only path of state between the servo and the other loops: the newest value replaces older
// ones, and no thread waits.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace reckon::haptics {

/// Transfers the newest value from one writer thread to one reader thread. Wait-free on both sides,
/// without retries, because a servo must not spin for a preempted writer. T is any copyable type.
/// No allocation. Cost: one atomic exchange a publication.
template <typename T>
class TripleBuffer {
 public:
  TripleBuffer() = default;
  /// Every slot starts as `initial`.
  explicit TripleBuffer(const T& initial) : slots_{initial, initial, initial} {}

  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;

  /// Writer: the slot to fill in place. It holds an older value, so write every field.
  [[nodiscard]] T& write_slot() noexcept { return slots_[back_]; }

  /// Writer: publishes the filled slot.
  void publish() noexcept {
    const std::uint8_t previous =
        middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel);
    back_ = previous & kIndex;
  }

  /// Writer: copies `value` and publishes it.
  void write(const T& value) noexcept {
    write_slot() = value;
    publish();
  }

  /// Reader: takes the newest publication, if there is one since the last call.
  /// @return true if read() now returns a new value.
  bool update() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader: the value taken by the last update(), unchanged until the next one.
  [[nodiscard]] const T& read() const noexcept { return slots_[front_]; }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;

  std::array<T, 3> slots_{};
  alignas(64) std::uint8_t back_ = 0;                 // slot of the writer
  alignas(64) std::atomic<std::uint8_t> middle_ = 1;  // published slot
  alignas(64) std::uint8_t front_ = 2;                // slot of the reader
};

}  // namespace reckon::haptics
