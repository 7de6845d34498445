// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Puts the datagrams of several sockets, which are read in turn, into the order of their stamps.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
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

  void add(const peer::SourceDatagram& datagram) {
    heap_.push_back({datagram,
                     {datagram.bytes.begin(), datagram.bytes.end()},
                     {datagram.captured.begin(), datagram.captured.end()},
                     std::string(datagram.interface),
                     number_++});
    std::ranges::push_heap(heap_, is_later);
    newest_ = std::max(newest_, datagram.time);
    while (heap_.size() > kMost || newest_ - heap_.front().datagram.time >= kHold) write_oldest();
  }
  /// Writes all; call it when no older datagram can arrive.
  void flush() {
    while (!heap_.empty()) write_oldest();
  }
  [[nodiscard]] std::size_t held() const noexcept { return heap_.size(); }

 private:
  struct Held {
    peer::SourceDatagram datagram;  // its views are set when it is written
    std::vector<std::byte> bytes, captured;
    std::string interface;
    std::uint64_t number = 0;
  };
  [[nodiscard]] static bool is_later(const Held& a, const Held& b) noexcept {
    return std::tie(a.datagram.time, a.number) > std::tie(b.datagram.time, b.number);
  }
  void write_oldest() {
    std::ranges::pop_heap(heap_, is_later);
    Held oldest = std::move(heap_.back());
    heap_.pop_back();
    oldest.datagram.bytes = oldest.bytes;
    oldest.datagram.captured = oldest.captured;
    oldest.datagram.interface = oldest.interface;
    write_(oldest.datagram);
  }

  std::function<void(const peer::SourceDatagram&)> write_;
  std::vector<Held> heap_;  // the oldest first
  std::chrono::nanoseconds newest_{0};
  std::uint64_t number_ = 0;
};

}  // namespace reckon::tools
