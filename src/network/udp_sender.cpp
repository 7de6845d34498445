// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_sender.hpp"

#include <linux/sockios.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

#include "reckon/peer/network/udp_socket.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr int kFlags = MSG_DONTWAIT | MSG_NOSIGNAL;

// The kernel's approximate charge for a pending datagram besides its octets.
constexpr std::size_t kChargedMore = 768;

// Errors with which a message to be cut is refused, but not its single datagrams: the kernel, the
// device or an IPsec rule cannot cut, or a length is above an MTU that has shrunk.
bool is_refusal_to_cut(int error) {
  return error == EINVAL || error == EMSGSIZE || error == EIO || error == EOPNOTSUPP;
}

}  // namespace

UdpSender::UdpSender(const UdpOutput& output, const Clock& clock, LinkTap& tap, EchoWatch& echo,
                     LinkCounters& counts)
    : socket_(output.socket),
      max_payload_(output.max_payload),
      interface_index_(output.interface_index),
      segment_refusal_(output.segment_refusal),
      clock_(clock),
      tap_(tap),
      echo_(echo),
      counts_(counts) {}

// Octets that are still on the host, as the kernel charges them. Some 0.1 us.
std::size_t UdpSender::queued() const noexcept {
  int octets = 0;
  return ioctl(socket_, SIOCOUTQ, &octets) == 0 ? static_cast<std::size_t>(octets) : 0;
}

void UdpSender::count_sent(const OutgoingDatagram& datagram) noexcept {
  counts_.sent.add();
  counts_.sent_bytes.add(datagram.bytes.size());
  echo_.send(datagram.to);
  tap_.note(DatagramTap::Loop::write, DatagramFate::sent, datagram.to, datagram.bytes);
}

void UdpSender::count_refused(std::span<const OutgoingDatagram> datagrams, int error) noexcept {
  // The reason before the count, because another thread may read in between.
  counts_.last_send_error.set(static_cast<std::uint64_t>(error));
  if (error == EMSGSIZE) counts_.too_big.add(datagrams.size());
  counts_.send_errors.add(datagrams.size());
  for (const OutgoingDatagram& datagram : datagrams)
    tap_.note(DatagramTap::Loop::write, DatagramFate::send_error, datagram.to, datagram.bytes);
}

bool UdpSender::send_alone(const OutgoingDatagram& datagram) noexcept {
  sockaddr_storage address{};
  const socklen_t size =
      to_sockaddr(datagram.to, interface_index_.load(std::memory_order_relaxed), address);
  counts_.send_calls.add();
  const ssize_t sent = ::sendto(socket_, datagram.bytes.data(), datagram.bytes.size(), kFlags,
                                reinterpret_cast<const sockaddr*>(&address), size);
  if (sent < 0) {
    count_refused({&datagram, 1}, errno);
    return false;
  }
  count_sent(datagram);
  return true;
}

// Leaves out datagrams that would wait too long behind pending ones; the rest is in `going_`.
std::size_t UdpSender::choose_going(std::span<const OutgoingDatagram> batch,
                                    std::size_t waiting) noexcept {
  const bool may = pace_.may_send(waiting, waiting > 0 ? clock_.now() : nanoseconds(0));
  std::size_t count = 0, charged = waiting;
  for (const OutgoingDatagram& datagram : batch) {
    // The first joined group carries the peers' protocol, which goes before states.
    const bool fits = waiting == 0 || (may && pace_.is_short(charged));
    if (!fits && !echo_.watches(datagram.to)) {
      counts_.held_back.add();
      tap_.note(DatagramTap::Loop::write, DatagramFate::held_back, datagram.to, datagram.bytes);
      continue;
    }
    charged += datagram.bytes.size() + kChargedMore;
    going_[count++] = datagram;
  }
  return count;
}

SentBatch UdpSender::send_going(std::size_t count) noexcept {
  const bool cuts = segment_refusal() == 0;
  outgoing_.plan(std::span(going_).first(count), cuts ? max_payload_ : 0,
                 interface_index_.load(std::memory_order_relaxed));
  SentBatch sent;
  const std::span<mmsghdr> going_messages = outgoing_.messages();
  for (std::size_t next = 0; next < going_messages.size();) {
    counts_.send_calls.add();
    const int done = sendmmsg(socket_, going_messages.data() + next,
                              static_cast<unsigned>(going_messages.size() - next), kFlags);
    const int error = done > 0 ? 0 : errno;
    for (const std::size_t end = next + static_cast<std::size_t>(std::max(done, 0)); next < end;
         ++next) {
      for (const OutgoingDatagram& datagram : outgoing_.carried(next)) {
        count_sent(datagram);
        ++sent.datagrams;
        sent.octets += datagram.bytes.size();
      }
    }
    if (error == 0) continue;
    if (outgoing_.carried(next).size() > 1 && is_refusal_to_cut(error)) {
      send_uncut(outgoing_.carried(next), error, sent);
    } else {
      count_refused(outgoing_.carried(next), error);
    }
    ++next;
  }
  return sent;
}

// Sends a run that was not cut one by one; if that succeeds, the socket does not try to cut again.
void UdpSender::send_uncut(std::span<const OutgoingDatagram> run, int why,
                           SentBatch& sent) noexcept {
  const std::size_t before = sent.datagrams;
  for (const OutgoingDatagram& datagram : run) {
    if (!send_alone(datagram)) continue;
    ++sent.datagrams;
    sent.octets += datagram.bytes.size();
  }
  if (sent.datagrams - before == run.size()) segment_refusal_.store(why, std::memory_order_relaxed);
}

bool UdpSender::send(const OutgoingDatagram& datagram) noexcept {
  const std::size_t before = queued();
  if (choose_going({&datagram, 1}, before) == 0) return false;
  if (!send_alone(datagram)) return false;
  if (before > 0) pace_.sent(std::max(queued(), before) - before);
  return true;
}

SentBatch UdpSender::send_batch(std::span<const OutgoingDatagram> batch) noexcept {
  SentBatch sent;
  while (!batch.empty()) {
    const auto part = batch.first(std::min(batch.size(), kMaxBatch));
    batch = batch.subspan(part.size());
    const std::size_t before = queued();
    const SentBatch now = send_going(choose_going(part, before));
    if (before > 0) pace_.sent(std::max(queued(), before) - before);
    sent.datagrams += now.datagrams;
    sent.octets += now.octets;
  }
  return sent;
}

}  // namespace reckon::peer
