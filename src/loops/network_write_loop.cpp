// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/network_write_loop.hpp"

namespace reckon::peer {

NetworkWriteLoop::NetworkWriteLoop(Link& link, DatagramRing& in, Counters& counters)
    : link_(link),
      in_(in),
      datagrams_(counters.make("datagrams_out", "datagrams sent")),
      octets_(counters.make("octets_out", "octets of UDP payload sent")),
      errors_(counters.make("send_errors", "datagrams that the kernel refused")) {}

std::size_t NetworkWriteLoop::step() noexcept {
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

}  // namespace reckon::peer
