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
  std::size_t sent = 0;
  while (const QueuedDatagram* datagram = in_.front()) {
    if (link_.send(datagram->group, datagram->octets)) {
      datagrams_.add();
      octets_.add(datagram->octets.size());
    } else {
      errors_.add();
    }
    in_.pop();
    ++sent;
  }
  return sent;
}

}  // namespace reckon::peer
