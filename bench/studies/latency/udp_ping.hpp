// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The least that a message between two threads over this interface takes: two bare UDP sockets.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <thread>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::bench {

/// What one question took.
struct PingAnswer {
  std::chrono::nanoseconds there{0};           ///< until the other thread had it
  std::chrono::nanoseconds there_and_back{0};  ///< until its answer was here
};

/// Asks, and answers itself in a thread of its own. One thread asks.
class UdpPing {
 public:
  /// @param address of an interface of this host, port 0. @param octets of each datagram, at least
  /// 16. @throws std::system_error where the sockets cannot be had.
  UdpPing(const peer::IpEndpoint& address, std::size_t octets);
  ~UdpPing();

  UdpPing(const UdpPing&) = delete;
  UdpPing& operator=(const UdpPing&) = delete;

  /// One question; nothing where no answer came within a second.
  [[nodiscard]] std::optional<PingAnswer> ask() noexcept;

 private:
  void answer() noexcept;

  std::vector<std::byte> question_, heard_;
  int asking_, answering_;  // connected to each other
  std::int64_t number_ = 0;
  std::atomic<std::int64_t> heard_at_{0};
  std::atomic<bool> stop_{false};
  std::thread answerer_;
};

}  // namespace reckon::bench
