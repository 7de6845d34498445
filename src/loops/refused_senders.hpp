// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Collects senders that the gate refuses, with the reason, so that the user can see a wrong
// exercise number or a length field of 0.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/datagram_gate.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Refused datagrams of one sender and one reason.
struct RefusedSender {
  IpEndpoint who;  ///< port 0: all further senders together
  Refusal why = Refusal::none;
  std::uint8_t octet = 0;  ///< of the first datagram: its exercise, or the octet that is no version
  std::uint64_t count = 0;
};

/// Reports each sender and reason once: the number of datagrams in the second after the first one.
/// Senders without a row are reported together: after 1 s, then at most once a minute, with the
/// total so far. One thread, fixed memory, no allocation; some ns per refused datagram.
class RefusedSenders {
 public:
  static constexpr std::size_t kMost = 16;
  static constexpr std::chrono::nanoseconds kGather = std::chrono::seconds(1);
  static constexpr std::chrono::nanoseconds kAgain = std::chrono::minutes(1);

  /// @param out receives the reports; outlives this
  explicit RefusedSenders(haptics::SpscRing<RefusedSender>& out) noexcept : out_(out) {}

  /// @param datagram refused, for a reason other than `none`  @param now steady time
  void note(const Datagram& datagram, Refusal why, std::chrono::nanoseconds now) noexcept {
    if (why == Refusal::sealed) return;  // LimitWatch reports it
    for (Row& row : rows_) {
      if (row.report.count == 0) {
        const std::size_t at = why == Refusal::exercise ? 1 : 0;
        const auto octet = at < datagram.bytes.size() ? datagram.bytes[at] : std::byte{0};
        row = {{datagram.sender, why, std::to_integer<std::uint8_t>(octet), 0}, now + kGather};
      }
      if (row.report.who != datagram.sender || row.report.why != why) continue;
      ++row.report.count;
      return;
    }
    ++others_.report.count;
    if (others_.due < std::chrono::nanoseconds(0))
      others_.due = now + (others_.report.count == 1 ? kGather : kAgain);
  }
  /// Call it some times a second.
  void look(std::chrono::nanoseconds now) noexcept {
    const auto report = [&](Row& row) {
      if (row.due < std::chrono::nanoseconds(0) || now < row.due) return;
      row.due = std::chrono::nanoseconds(-1);
      static_cast<void>(out_.push(row.report));
    };
    for (Row& row : rows_) report(row);
    report(others_);
  }

 private:
  struct Row {
    RefusedSender report;
    std::chrono::nanoseconds due{-1};  // < 0: reported, or free
  };
  std::array<Row, kMost> rows_{};
  Row others_;
  haptics::SpscRing<RefusedSender>& out_;
};

}  // namespace reckon::peer
