// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counters of a running link: LinkStatistics that its threads write.
#pragma once

#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// The counts of LinkStatistics, each written by one thread and read by any.
struct LinkCounters {
  Counter sent, sent_bytes, send_errors, too_big, send_calls, held_back, received, received_bytes,
      own, truncated, kernel_drops, receive_errors, joins, leaves, join_errors, interface_losses,
      recoveries, last_send_error, last_join_error;

  /// The present values.
  [[nodiscard]] LinkStatistics values() const noexcept {
    LinkStatistics out;
    out.sent = sent.value();
    out.sent_bytes = sent_bytes.value();
    out.send_errors = send_errors.value();
    out.too_big = too_big.value();
    out.send_calls = send_calls.value();
    out.held_back = held_back.value();
    out.received = received.value();
    out.received_bytes = received_bytes.value();
    out.own = own.value();
    out.truncated = truncated.value();
    out.kernel_drops = kernel_drops.value();
    out.receive_errors = receive_errors.value();
    out.joins = joins.value();
    out.leaves = leaves.value();
    out.join_errors = join_errors.value();
    out.interface_losses = interface_losses.value();
    out.recoveries = recoveries.value();
    out.last_send_error = static_cast<int>(last_send_error.value());
    out.last_join_error = static_cast<int>(last_join_error.value());
    return out;
  }
};

}  // namespace reckon::peer
