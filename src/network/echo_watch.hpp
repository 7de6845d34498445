// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Detects whether the kernel loops our datagrams to a joined group back to us: without the help of
// others the only sign that this host receives a group. Private to the peer library.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Watches the first group that was joined. The writing thread calls send(), the reading one all
/// else. No allocation, no clock.
class EchoWatch {
 public:
  /// Silence is this many datagrams in a row without an echo, for this long.
  static constexpr std::uint64_t kUnanswered = 3;
  static constexpr std::chrono::nanoseconds kPatience = std::chrono::milliseconds(2500);

  enum class Turn : std::uint8_t { none, silent, heard };

  /// Records a sent datagram.
  void send(const IpEndpoint& to) noexcept {
    if (watches(to)) sent_.fetch_add(1, std::memory_order_relaxed);
  }
  /// Whether that is the watched group. Any thread.
  [[nodiscard]] bool watches(const IpEndpoint& to) const noexcept {
    return hash(to) == watched_.load(std::memory_order_relaxed);
  }
  /// Records an echo.
  void receive(const GroupAddress& group) noexcept {
    if (hash(group) != watched_.load(std::memory_order_relaxed)) return;
    heard_ = true;
    restart();
  }
  void joined(const GroupAddress& group) noexcept {
    if (watched_.load(std::memory_order_relaxed) != 0) return;
    watched_.store(hash(group), std::memory_order_relaxed);
    group_ = group;
    restart();
  }
  void left(const GroupAddress& group) noexcept {
    if (hash(group) == watched_.load(std::memory_order_relaxed)) watched_.store(0);
  }
  /// Ignores what has been sent so far, because the interface is another one.
  void restart() noexcept {
    answered_ = sent_.load(std::memory_order_relaxed);
    waits_ = false;
  }

  /// Returns the beginning and the end of silence. Call it when all arrived datagrams were taken.
  [[nodiscard]] Turn look(std::chrono::nanoseconds now) noexcept {
    const std::uint64_t unanswered = sent_.load(std::memory_order_relaxed) - answered_;
    if (unanswered == 0) {
      waits_ = false;
    } else if (!waits_) {
      waits_ = true;
      since_ = now;
    }
    const bool is_silent = unanswered >= kUnanswered && now - since_ >= kPatience;
    const bool was_heard = std::exchange(heard_, false);
    if (silent_ ? !was_heard : !is_silent) return Turn::none;
    silent_ = !silent_;
    return silent_ ? Turn::silent : Turn::heard;
  }
  [[nodiscard]] const GroupAddress& group() const noexcept { return group_; }

 private:
  static std::size_t hash(const IpEndpoint& endpoint) noexcept {
    return std::hash<IpEndpoint>()(endpoint) | 1u;  // 0: no group
  }

  std::atomic<std::size_t> watched_{0};
  std::atomic<std::uint64_t> sent_{0};
  GroupAddress group_;
  std::uint64_t answered_ = 0;
  bool waits_ = false, silent_ = false, heard_ = false;
  std::chrono::nanoseconds since_{0};
};

}  // namespace reckon::peer
