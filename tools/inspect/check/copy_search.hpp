// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds datagrams that a capture contains twice, as captures of all interfaces or of a mirrored
// port do. A copy repeated by another host has another sender, and does not count.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

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

  void look_at(const peer::SourceDatagram& datagram);

  [[nodiscard]] std::uint64_t copies() const noexcept { return copies_; }
  [[nodiscard]] std::uint64_t datagrams() const noexcept { return datagrams_; }
  /// The first copy, if there is any.
  [[nodiscard]] const Copy& first() const noexcept { return first_; }

 private:
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
