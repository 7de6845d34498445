// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How the peer's loops hand things to each other: one writer, one reader, no lock, no allocation.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <memory>

namespace reckon::peer {

/// Bounded queue from exactly one writing thread to exactly one reading thread. Elements are
/// written and read in place. Wait-free on both sides; a full ring refuses, and the writer counts
/// what it could not say.
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
    if (head - tail_.load(std::memory_order_acquire) > mask_) return nullptr;
    return &slots_[head & mask_];
  }

  void publish() noexcept {
    head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  /// Writer: copies one element in; false when the ring is full.
  bool push(const T& value) noexcept {
    T* slot = claim();
    if (slot == nullptr) return false;
    *slot = value;
    publish();
    return true;
  }

  /// Reader: the oldest element, or nullptr when there is none. pop() gives the slot back.
  [[nodiscard]] const T* front() noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return nullptr;
    return &slots_[tail & mask_];
  }

  void pop() noexcept {
    tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

 private:
  std::size_t mask_;
  std::unique_ptr<T[]> slots_;
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace reckon::peer
