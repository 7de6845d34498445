// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Detects readable sockets of a link and wake-ups of its reader: epoll. Private to the network.
#pragma once

#include <sys/epoll.h>
#include <sys/eventfd.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/descriptor.hpp"
#include "reckon/peer/network/interface_watch.hpp"
#include "reckon/peer/network/udp_send_batch.hpp"

namespace reckon::peer {

/// Sockets by number, an eventfd that ends a wait, and the kernel's notices of interfaces. For the
/// reading thread, except wake(). No allocation after construction.
class UdpReadiness {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  /// @param clock outlives this. @throws std::system_error
  explicit UdpReadiness(const Clock& clock);

  /// Watches a socket until it is closed.
  /// @param first it is found by find_first(), not by next(). @returns false with the reason in
  /// errno
  bool add(int socket, std::uint32_t number, bool first) noexcept;

  /// Finds readable sockets, and waits for them up to `timeout`. An interruption by a signal counts
  /// as woken, so that the caller sees what the signal handler wrote.
  void poll(nanoseconds timeout) noexcept;
  /// Whether poll() has found sockets that next() has not returned yet.
  [[nodiscard]] bool has_next() const noexcept { return next_event_ < event_count_; }
  /// The number of the next one of them.
  [[nodiscard]] std::uint32_t next() noexcept { return events_[next_event_++].data.u32; }
  /// Whether poll() has found as many sockets as it can, so that there may be others.
  [[nodiscard]] bool is_crowded() const noexcept { return crowded_; }
  /// Discards the result of poll().
  void clear() noexcept { event_count_ = next_event_ = 0; }
  /// Whether poll() has found a readable socket among the prioritised ones.
  [[nodiscard]] bool is_first_ready() const noexcept { return first_ready_; }
  /// The numbers of readable sockets among the prioritised ones, by another poll.
  /// @param out has room for 1 to kMostFirst. @returns their number
  [[nodiscard]] std::size_t find_first(std::span<std::uint32_t> out) noexcept;
  static constexpr std::size_t kMostFirst = 8;

  /// Last time at which all sockets were empty; steady.
  [[nodiscard]] nanoseconds all_empty() const noexcept { return all_empty_; }

  /// Ends the present poll(), or the next one. Any thread; safe in a signal handler.
  void wake() noexcept;
  /// Whether poll() has found that it was woken, since the last call.
  bool take_wake() noexcept;

  /// Whether the kernel sends notices of changed interfaces; else the caller has to examine the
  /// host.
  [[nodiscard]] bool has_host_notices() const noexcept { return has_host_notices_; }
  [[nodiscard]] bool host_changed() const noexcept { return host_changed_; }
  void clear_host_change() noexcept { host_changed_ = false; }

 private:
  static bool watch(const Descriptor& where, int descriptor, std::uint32_t tag) noexcept;

  const Clock& clock_;
  Descriptor epoll_{epoll_create1(EPOLL_CLOEXEC), "epoll_create1"};
  /// Of the prioritised sockets; itself a socket of `epoll_`.
  Descriptor first_epoll_{epoll_create1(EPOLL_CLOEXEC), "epoll_create1"};
  Descriptor wake_{eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd"};
  InterfaceWatch host_;
  bool has_host_notices_ = false, host_changed_ = false;
  std::array<epoll_event, kMaxBatch> events_{};
  std::size_t event_count_ = 0, next_event_ = 0;
  bool crowded_ = false;
  bool first_ready_ = false;  // at the last poll of `epoll_`
  bool woken_ = false;        // by a signal
  bool wake_waits_ = false;   // poll() has found it, take_wake() has not read it
  nanoseconds all_empty_{0};
};

}  // namespace reckon::peer
