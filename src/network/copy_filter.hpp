// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recognises the copies of one datagram that came over several interfaces. Private to the network.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string_view>
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
  [[nodiscard]] bool is_copy(const Datagram& datagram, unsigned interface) {
    forget(datagram.received);
    const std::uint64_t bit = std::uint64_t{1} << interface % 64;
    const std::size_t key = key_of(datagram);
    std::deque<Taken>& equal = taken_[key];
    for (Taken& one : equal) {
      if ((one.interfaces & bit) != 0) continue;
      one.interfaces |= bit;
      return true;
    }
    equal.push_back({bit});
    ages_.push_back({datagram.received, key});
    return false;
  }

 private:
  struct Taken {
    std::uint64_t interfaces;  // over which it has come, a bit each
  };
  struct Age {
    nanoseconds time;
    std::size_t key;
  };
  [[nodiscard]] std::size_t key_of(const Datagram& datagram) const {
    IpEndpoint sender = datagram.sender;
    sender.port = 0;
    const bool is_own = std::find(own_.begin(), own_.end(), sender) != own_.end();
    sender = is_own ? IpEndpoint() : datagram.sender;
    sender.port = datagram.sender.port;
    const std::string_view octets(reinterpret_cast<const char*>(datagram.bytes.data()),
                                  datagram.bytes.size());
    const std::hash<IpEndpoint> hash;
    return std::hash<std::string_view>()(octets) * 31 + hash(sender) * 7 + hash(datagram.group);
  }
  void forget(nanoseconds now) {
    while (!ages_.empty() && (now - ages_.front().time > kWindow || ages_.size() >= kMost)) {
      const auto found = taken_.find(ages_.front().key);
      found->second.pop_front();
      if (found->second.empty()) taken_.erase(found);
      ages_.pop_front();
    }
  }

  std::vector<IpEndpoint> own_;
  std::unordered_map<std::size_t, std::deque<Taken>> taken_;  // the older first
  std::deque<Age> ages_;                                      // of all in taken_
};

}  // namespace reckon::peer
