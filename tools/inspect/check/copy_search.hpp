// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds datagrams that a capture contains twice, as captures of all interfaces or of a mirrored
// port do. A copy repeated by another host has another sender, and does not count.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::tools {

/// Counts datagrams with the same octets, sender and group as an earlier one within 5 ms, among the
/// last 64. One thread, no allocation, some 0.1 us per datagram.
class CopySearch {
 public:
  struct Copy {
    std::uint64_t frame = 0;
    std::uint64_t original = 0;  ///< frame of the first one
    std::chrono::nanoseconds time{};
    std::chrono::nanoseconds later{};
  };

  void look_at(const peer::SourceDatagram& datagram) {
    if (datagram.time == std::chrono::nanoseconds::zero()) return;
    const Seen now{hash_of(datagram), datagram.frame, datagram.time};
    const std::span<const Seen> known(seen_.data(),
                                      std::min(datagrams_, std::uint64_t{kRemembered}));
    const auto original = std::ranges::find_if(known, [&](const Seen& seen) {
      return seen.hash == now.hash && now.time - seen.time <= kWithin &&
             seen.time - now.time <= kWithin;
    });
    if (original != known.end() && copies_++ == 0)
      first_ = {now.frame, original->frame, now.time, now.time - original->time};
    seen_[datagrams_++ % kRemembered] = now;
  }

  [[nodiscard]] std::uint64_t copies() const noexcept { return copies_; }
  [[nodiscard]] std::uint64_t datagrams() const noexcept { return datagrams_; }
  /// The first copy, if there is any.
  [[nodiscard]] const Copy& first() const noexcept { return first_; }

 private:
  static constexpr std::chrono::nanoseconds kWithin = std::chrono::milliseconds(5);
  static std::uint64_t hash_of(const peer::SourceDatagram& datagram) {
    const auto* octets = reinterpret_cast<const char*>(datagram.bytes.data());
    const std::uint64_t content = std::hash<std::string_view>{}({octets, datagram.bytes.size()});
    const std::hash<peer::IpEndpoint> endpoint;
    constexpr std::uint64_t kOdd =
        0x9E3779B97F4A7C15;  // so that the three hashes do not cancel out
    return (content * kOdd + endpoint(datagram.source)) * kOdd + endpoint(datagram.group);
  }

  static constexpr std::size_t kRemembered = 64;
  struct Seen {
    std::uint64_t hash = 0;
    std::uint64_t frame = 0;
    std::chrono::nanoseconds time{};
  };

  std::array<Seen, kRemembered> seen_{};  // a ring: the next is written at datagrams_ % 64
  std::uint64_t datagrams_ = 0;
  std::uint64_t copies_ = 0;
  Copy first_;
};

}  // namespace reckon::tools
