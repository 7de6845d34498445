// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a UdpMulticast sends: the writing thread's part.
#include <linux/sockios.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>

#include "reckon/peer/network/udp_multicast_state.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr int kFlags = MSG_DONTWAIT | MSG_NOSIGNAL;

// What the kernel charges a waiting datagram besides its octets, roughly.
constexpr std::size_t kChargedMore = 768;

// Why a message that is to be cut is refused, but not each of its datagrams: the kernel, the device
// or a rule of IPsec cannot cut, or a length is above an MTU that has shrunk.
bool is_refusal_to_cut(int error) {
  return error == EINVAL || error == EMSGSIZE || error == EIO || error == EOPNOTSUPP;
}

}  // namespace

// Octets that have not left the host, as the kernel charges them. Some 0.1 us.
std::size_t UdpMulticast::State::queued() noexcept {
  int octets = 0;
  return ioctl(slots[0].socket.native_handle(), SIOCOUTQ, &octets) == 0
             ? static_cast<std::size_t>(octets)
             : 0;
}

void UdpMulticast::State::count_sent(const OutgoingDatagram& datagram) noexcept {
  counts.sent.add();
  counts.sent_bytes.add(datagram.bytes.size());
  echo.send(datagram.to);
  note(DatagramTap::Loop::write, DatagramFate::sent, datagram.to, datagram.bytes);
}

void UdpMulticast::State::count_refused(std::span<const OutgoingDatagram> datagrams,
                                        int error) noexcept {
  // Why before that: another thread may look in between.
  counts.last_send_error.set(static_cast<std::uint64_t>(error));
  if (error == EMSGSIZE) counts.too_big.add(datagrams.size());
  counts.send_errors.add(datagrams.size());
  for (const OutgoingDatagram& datagram : datagrams)
    note(DatagramTap::Loop::write, DatagramFate::send_error, datagram.to, datagram.bytes);
}

bool UdpMulticast::State::send_alone(const OutgoingDatagram& datagram) noexcept {
  sockaddr_storage address{};
  const socklen_t size =
      to_sockaddr(datagram.to, interface_index.load(std::memory_order_relaxed), address);
  counts.send_calls.add();
  const ssize_t sent =
      ::sendto(slots[0].socket.native_handle(), datagram.bytes.data(), datagram.bytes.size(),
               kFlags, reinterpret_cast<const sockaddr*>(&address), size);
  if (sent < 0) {
    count_refused({&datagram, 1}, errno);
    return false;
  }
  count_sent(datagram);
  return true;
}

// Leaves out what would wait too long behind what waits already; the rest is in `going`.
std::size_t UdpMulticast::State::choose_going(std::span<const OutgoingDatagram> batch,
                                              std::size_t waiting) noexcept {
  const bool may = pace.may_send(waiting, waiting > 0 ? clock.now() : nanoseconds(0));
  std::size_t count = 0, charged = waiting;
  for (const OutgoingDatagram& datagram : batch) {
    // The first group that was joined is the peers' own business: it goes before states.
    const bool fits = waiting == 0 || (may && pace.is_short(charged));
    if (!fits && !echo.watches(datagram.to)) {
      counts.held_back.add();
      note(DatagramTap::Loop::write, DatagramFate::held_back, datagram.to, datagram.bytes);
      continue;
    }
    charged += datagram.bytes.size() + kChargedMore;
    going[count++] = datagram;
  }
  return count;
}

SentBatch UdpMulticast::State::send_going(std::size_t count) noexcept {
  const bool cuts = segment_refusal.load(std::memory_order_relaxed) == 0;
  outgoing.plan(std::span(going).first(count), cuts ? max_payload : 0,
                interface_index.load(std::memory_order_relaxed));
  SentBatch sent;
  const std::span<mmsghdr> going_messages = outgoing.messages();
  for (std::size_t next = 0; next < going_messages.size();) {
    counts.send_calls.add();
    const int done = sendmmsg(slots[0].socket.native_handle(), going_messages.data() + next,
                              static_cast<unsigned>(going_messages.size() - next), kFlags);
    const int error = done > 0 ? 0 : errno;
    for (const std::size_t end = next + static_cast<std::size_t>(std::max(done, 0)); next < end;
         ++next) {
      for (const OutgoingDatagram& datagram : outgoing.carried(next)) {
        count_sent(datagram);
        ++sent.datagrams;
        sent.octets += datagram.bytes.size();
      }
    }
    if (error == 0) continue;
    if (outgoing.carried(next).size() > 1 && is_refusal_to_cut(error)) {
      send_uncut(outgoing.carried(next), error, sent);
    } else {
      count_refused(outgoing.carried(next), error);
    }
    ++next;
  }
  return sent;
}

// One by one what was not to be cut; where that goes, the socket does not try again.
void UdpMulticast::State::send_uncut(std::span<const OutgoingDatagram> run, int why,
                                     SentBatch& sent) noexcept {
  const std::size_t before = sent.datagrams;
  for (const OutgoingDatagram& datagram : run) {
    if (!send_alone(datagram)) continue;
    ++sent.datagrams;
    sent.octets += datagram.bytes.size();
  }
  if (sent.datagrams - before == run.size()) segment_refusal.store(why, std::memory_order_relaxed);
}

// One by itself takes the shorter way.
bool UdpMulticast::send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept {
  const OutgoingDatagram datagram{to, bytes};
  const std::size_t before = state_->queued();
  if (state_->choose_going({&datagram, 1}, before) == 0) return false;
  if (!state_->send_alone(datagram)) return false;
  if (before > 0) state_->pace.sent(std::max(state_->queued(), before) - before);
  return true;
}

SentBatch UdpMulticast::send_batch(std::span<const OutgoingDatagram> batch) noexcept {
  SentBatch sent;
  while (!batch.empty()) {
    const auto part = batch.first(std::min(batch.size(), kMaxBatch));
    batch = batch.subspan(part.size());
    const std::size_t before = state_->queued();
    const SentBatch now = state_->send_going(state_->choose_going(part, before));
    if (before > 0) state_->pace.sent(std::max(state_->queued(), before) - before);
    sent.datagrams += now.datagrams;
    sent.octets += now.octets;
  }
  return sent;
}

}  // namespace reckon::peer
