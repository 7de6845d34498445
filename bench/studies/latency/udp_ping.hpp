// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lower bound for a message between two threads over this interface: two bare UDP sockets.
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

/// Times of one question.
struct PingAnswer {
  std::chrono::nanoseconds there{0};           ///< until the other thread received it
  std::chrono::nanoseconds there_and_back{0};  ///< until its answer arrived
};

/// Sends questions, and answers them in a thread of its own. One thread calls ask().
class UdpPing {
 public:
  /// @param address of an interface of this host, port 0. @param octets of each datagram, at least
  /// 16. @throws std::system_error if the sockets cannot be created.
  UdpPing(const peer::IpEndpoint& address, std::size_t octets);
  ~UdpPing();

  UdpPing(const UdpPing&) = delete;
  UdpPing& operator=(const UdpPing&) = delete;

  /// One question; no value if no answer arrived within a second.
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
