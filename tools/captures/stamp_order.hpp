// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Puts the datagrams of several sockets, which are read in turn, into the order of their stamps.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::tools {

/// Holds each datagram until one that is kHold younger has arrived; holds at most kMost. Datagrams
/// with equal times keep their order. One thread; copies the octets.
class StampOrder {
 public:
  static constexpr std::chrono::nanoseconds kHold = std::chrono::milliseconds(200);
  static constexpr std::size_t kMost = 65'536;

  /// @param write receives the datagrams in order; their octets are valid during the call
  explicit StampOrder(std::function<void(const peer::SourceDatagram&)> write)
      : write_(std::move(write)) {}

  void add(const peer::SourceDatagram& datagram);
  /// Writes all; call it when no older datagram can arrive.
  void flush();
  [[nodiscard]] std::size_t held() const noexcept { return heap_.size(); }

 private:
  struct Held {
    peer::SourceDatagram datagram;  // its views are set when it is written
    std::vector<std::byte> bytes, captured;
    std::string interface;
    std::uint64_t number = 0;
  };
  [[nodiscard]] static bool is_later(const Held& a, const Held& b) noexcept;
  void write_oldest();

  std::function<void(const peer::SourceDatagram&)> write_;
  std::vector<Held> heap_;  // the oldest first
  std::chrono::nanoseconds newest_{0};
  std::uint64_t number_ = 0;
};

}  // namespace reckon::tools
