// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes finished datagrams to the link, so that a slow send never delays the model loop.
#pragma once

#include <array>
#include <cstddef>

#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/datagram_ring.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// The loop. One thread calls step(); no allocation.
class NetworkWriteLoop {
 public:
  NetworkWriteLoop(Link& link, DatagramRing& in, Counters& counters)
      : link_(link),
        in_(in),
        datagrams_(counters.make("datagrams_out", "datagrams sent")),
        octets_(counters.make("octets_out", "octets of UDP payload sent")),
        errors_(counters.make("send_errors", "datagrams that the kernel refused")) {}

  /// Sends all pending datagrams, in batches; returns their number. A datagram that the kernel
  /// refuses is counted and lost: the next update repairs it.
  std::size_t step() noexcept {
    std::size_t taken = 0;
    while (const std::size_t count = in_.front(waiting_)) {
      for (std::size_t i = 0; i < count; ++i) batch_[i] = {waiting_[i].group, waiting_[i].octets};
      const SentBatch sent = link_.send_batch(std::span(batch_).first(count));
      in_.pop();
      datagrams_.add(sent.datagrams);
      octets_.add(sent.octets);
      errors_.add(count - sent.datagrams);
      taken += count;
    }
    return taken;
  }

 private:
  static constexpr std::size_t kBatch = 64;

  Link& link_;
  DatagramRing& in_;
  std::array<QueuedDatagram, kBatch> waiting_{};
  std::array<OutgoingDatagram, kBatch> batch_{};
  Counter& datagrams_;
  Counter& octets_;
  Counter& errors_;
};

}  // namespace reckon::peer
