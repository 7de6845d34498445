// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recognises the copies of one datagram that came over several interfaces. Private to the network.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A datagram is a copy if one with the same octets, sender and destination was taken from another
/// interface shortly before, and this interface has not delivered its own copy yet. Therefore equal
/// datagrams of one interface are never copies: a sender may repeat itself. One thread.
class CopyFilter {
 public:
  using nanoseconds = std::chrono::nanoseconds;
  /// Time within which all copies arrive.
  static constexpr nanoseconds kWindow = std::chrono::milliseconds(500);
  /// Datagrams that are remembered; beyond this number the oldest are forgotten early.
  static constexpr std::size_t kMost = 65536;

  /// @param own addresses of this host: a program that sends over each interface does so from
  /// several of them and from one port, and counts as one sender
  void set_own_addresses(std::vector<IpEndpoint> own) { own_ = std::move(own); }

  /// Whether the datagram is a copy; if not, it is remembered. Its time may be less than the time
  /// of the previous call.
  /// @param interface index of the interface over which it came
  [[nodiscard]] bool is_copy(const Datagram& datagram, unsigned interface);

 private:
  struct Taken {
    std::uint64_t interfaces;  // over which it has come, a bit each
  };
  struct Age {
    nanoseconds time;
    std::size_t key;
  };
  [[nodiscard]] std::size_t key_of(const Datagram& datagram) const;
  void forget(nanoseconds now);

  std::vector<IpEndpoint> own_;
  std::unordered_map<std::size_t, std::deque<Taken>> taken_;  // the older first
  std::deque<Age> ages_;                                      // of all in taken_
};

}  // namespace reckon::peer
