// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/refused_senders.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

void RefusedSenders::note(const Datagram& datagram, Refusal why, nanoseconds now) noexcept {
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
  if (others_.due < nanoseconds(0))
    others_.due = now + (others_.report.count == 1 ? kGather : kAgain);
}

void RefusedSenders::look(nanoseconds now) noexcept {
  const auto report = [&](Row& row) {
    if (row.due < nanoseconds(0) || now < row.due) return;
    row.due = nanoseconds(-1);
    static_cast<void>(out_.push(row.report));
  };
  for (Row& row : rows_) report(row);
  report(others_);
}

}  // namespace reckon::peer
