// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Ordered transfer between loops: one writer, one reader, no lock, no allocation.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace reckon::haptics {

/// Bounded queue from exactly one writing thread to exactly one reading thread. Elements are
/// written and read in place. Wait-free on both sides. A full ring refuses new elements and counts
/// them, so that a slow reader never delays the writer.
template <class T>
class SpscRing {
 public:
  /// Holds at least `capacity` elements (rounded up to a power of two); allocates once, here.
  explicit SpscRing(std::size_t capacity)
      : mask_(std::bit_ceil(capacity < 2 ? std::size_t{2} : capacity) - 1),
        slots_(std::make_unique<T[]>(mask_ + 1)) {}

  /// Writer: the next free slot, or nullptr when the ring is full. publish() makes it visible.
  [[nodiscard]] T* claim() noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) > mask_) {
      refused_.fetch_add(1, std::memory_order_relaxed);
      return nullptr;
    }
    return &slots_[head & mask_];
  }

  void publish() noexcept {
    head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  /// Writer: copies one element; false if the ring is full.
  bool push(const T& value) noexcept {
    T* slot = claim();
    if (slot == nullptr) return false;
    *slot = value;
    publish();
    return true;
  }

  /// Reader: the oldest element, or nullptr if there is none. pop() frees its slot.
  [[nodiscard]] const T* front() noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return nullptr;
    return &slots_[tail & mask_];
  }

  void pop() noexcept {
    tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  /// Reader: moves the oldest element to `value`; false if there is none.
  bool pop(T& value) noexcept {
    const T* slot = front();
    if (slot == nullptr) return false;
    value = *slot;
    pop();
    return true;
  }

  /// Whether the ring is empty. Any thread.
  [[nodiscard]] bool empty() const noexcept {
    return tail_.load(std::memory_order_acquire) == head_.load(std::memory_order_acquire);
  }

  /// Number of times that the writer found the ring full. Any thread.
  [[nodiscard]] std::uint64_t refused() const noexcept {
    return refused_.load(std::memory_order_relaxed);
  }

 private:
  std::size_t mask_;
  std::unique_ptr<T[]> slots_;
  alignas(64) std::atomic<std::size_t> head_{0};
  std::atomic<std::uint64_t> refused_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace reckon::haptics
