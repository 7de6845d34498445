// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whether what we send to a group that we joined comes back to us, as the kernel does it: the one
// sign, without anybody else's help, that this host hears a group. Private to the peer library.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Watches the first group that was joined. send() by the writing thread, all else by the reading
/// one. No allocation, no clock.
class EchoWatch {
 public:
  /// So many datagrams in a row without an echo, for so long, are silence.
  static constexpr std::uint64_t kUnanswered = 3;
  static constexpr std::chrono::nanoseconds kPatience = std::chrono::milliseconds(2500);

  enum class Turn : std::uint8_t { none, silent, heard };

  /// A datagram has left.
  void send(const IpEndpoint& to) noexcept {
    if (watches(to)) sent_.fetch_add(1, std::memory_order_relaxed);
  }
  /// Whether that is the group. Any thread.
  [[nodiscard]] bool watches(const IpEndpoint& to) const noexcept {
    return hash(to) == watched_.load(std::memory_order_relaxed);
  }
  /// One of ours came back.
  void hear(const GroupAddress& group) noexcept {
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
  /// What has been sent so far is forgiven: the interface is another one.
  void restart() noexcept {
    answered_ = sent_.load(std::memory_order_relaxed);
    waits_ = false;
  }

  /// Tells the beginning and the end of silence. Call it when all that came has been taken.
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
