// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_receiver.hpp"

#include <linux/sock_diag.h>
#include <netinet/udp.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "reckon/peer/network/udp_socket.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// A run of datagrams that the kernel hands over as one is no longer than one IP packet.
constexpr std::size_t kMostCoalesced = 65536;

// Most messages of one socket in its turn, so that a flooded group does not keep others from being
// read; fewer if each is a run of many datagrams.
constexpr std::size_t kMostInTurn = 16, kMostRunsInTurn = 1;

}  // namespace

UdpReceiver::UdpReceiver(const UdpMulticastOptions& options, const Clock& clock,
                         const UdpReadiness& ready, const LocalEndpoint& local, LinkTap& tap,
                         EchoWatch& echo, LinkCounters& counts)
    : batch_(options.batch),
      max_datagram_(options.max_datagram),
      deliver_own_(options.deliver_own),
      clock_(clock),
      ready_(ready),
      local_(local),
      tap_(tap),
      echo_(echo),
      counts_(counts) {}

void UdpReceiver::reserve(bool coalesces) {
  buffer_size_ = coalesces ? kMostCoalesced : max_datagram_;
  // One more, because a tap may have to receive the content of a group that is left while all are
  // in use.
  const std::size_t most = batch_ + (tap_.is_on() ? 1 : 0);
  buffers_ = std::make_unique_for_overwrite<std::byte[]>(most * buffer_size_);
}

// Takes up to `count` messages of one socket into the free buffers.
void UdpReceiver::take(UdpSlot& slot, std::size_t count) noexcept {
  emptied_ = true;
  if (!slot.socket.is_open()) return;
  const std::size_t first = arrived_count_;
  for (std::size_t i = first; i < first + count; ++i) {
    vectors_[i] = {buffers_.get() + i * buffer_size_, buffer_size_};
    msghdr& header = messages_[i].msg_hdr;
    header = {&senders_[i], sizeof senders_[i], &vectors_[i], 1, &controls_[i], kControlBytes, 0};
  }
  const int got = recvmmsg(slot.socket.native_handle(), messages_.data() + first,
                           static_cast<unsigned>(count), MSG_DONTWAIT, nullptr);
  emptied_ = got < static_cast<int>(count);
  const nanoseconds now = clock_.now();
  if (got <= 0) {
    if (got < 0 && errno != EAGAIN && errno != EINTR) counts_.receive_errors.add();
    slot.empty = now;
    return;
  }
  const nanoseconds utc = clock_.utc_now();
  arrived_count_ += static_cast<std::size_t>(got);
  slot.brings_runs = false;
  for (std::size_t i = first; i < arrived_count_; ++i) accept(slot, i, now, utc);
  if (emptied_) slot.empty = now;
}

// Records the content of a buffer, if it is for us.
void UdpReceiver::accept(UdpSlot& slot, std::size_t buffer, nanoseconds now,
                         nanoseconds utc) noexcept {
  const mmsghdr& message = messages_[buffer];
  Arrived& out = arrived_[buffer];
  out = {slot.group, from_sockaddr(senders_[buffer]), now, message.msg_len, message.msg_len, 0, 1};
  read_control(slot, message.msg_hdr, utc, out);
  if (out.segment > 0) out.left = (out.length + out.segment - 1) / out.segment;
  if (out.left > 1) slot.brings_runs = true;
  if ((message.msg_hdr.msg_flags & MSG_TRUNC) != 0 || out.segment > max_datagram_) {
    counts_.truncated.add(out.left);
    out.left = 0;
  } else if (out.sender == local_.value()) {
    echo_.receive(slot.group);
    if (deliver_own_) return;
    counts_.own.add(out.left);
    pass_over(out, start_of(buffer), DatagramFate::own);
  }
}

// Reads the arrival time as steady time, the length of the segments, the interface, and the number
// of drops before it. A stamp from before the socket was last seen empty comes from a clock that
// was set, not from a datagram that waited.
void UdpReceiver::read_control(UdpSlot& slot, const msghdr& header, nanoseconds utc,
                               Arrived& out) noexcept {
  nanoseconds age{0};
  msghdr* mutable_header = const_cast<msghdr*>(&header);  // CMSG_NXTHDR takes no const
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(mutable_header, c)) {
    if (c->cmsg_level == SOL_UDP && c->cmsg_type == UDP_GRO) {
      int segment = 0;
      std::memcpy(&segment, CMSG_DATA(c), sizeof segment);
      if (segment > 0) out.segment = std::min(static_cast<std::size_t>(segment), out.length);
    } else if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SO_TIMESTAMPNS) {
      timespec stamp;
      std::memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
      age = utc - std::chrono::seconds(stamp.tv_sec) - nanoseconds(stamp.tv_nsec);
    } else if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t drops = 0;
      std::memcpy(&drops, CMSG_DATA(c), sizeof drops);
      count_drops(slot, drops);
    } else if (c->cmsg_level == IPPROTO_IP && c->cmsg_type == IP_PKTINFO) {
      in_pktinfo arrival;
      std::memcpy(&arrival, CMSG_DATA(c), sizeof arrival);
      out.interface = static_cast<unsigned>(arrival.ipi_ifindex);
    } else if (c->cmsg_level == IPPROTO_IPV6 && c->cmsg_type == IPV6_PKTINFO) {
      in6_pktinfo arrival;
      std::memcpy(&arrival, CMSG_DATA(c), sizeof arrival);
      out.interface = arrival.ipi6_ifindex;
    }
  }
  const nanoseconds longest = out.received - std::max(slot.empty, ready_.all_empty());
  if (age >= nanoseconds{0} && age <= longest) out.received -= age;
}

// Cuts arrived messages into datagrams.
std::size_t UdpReceiver::hand_over(std::span<Datagram> out, std::size_t delivered) noexcept {
  const std::size_t before = delivered;
  std::size_t octets = 0;
  while (next_arrived_ < arrived_count_ && delivered < out.size()) {
    Arrived& run = arrived_[next_arrived_];
    const std::byte* start = start_of(next_arrived_);
    for (; run.left > 0 && delivered < out.size(); --run.left) {
      const std::size_t length = std::min(run.segment, run.length - run.taken);
      out[delivered++] = {run.group, run.sender, {start + run.taken, length}, run.received};
      tap_.note(DatagramTap::Loop::read, DatagramFate::arrived, run.group,
                out[delivered - 1].bytes);
      run.taken += length;
      octets += length;
    }
    if (run.left == 0) ++next_arrived_;
  }
  counts_.received.add(delivered - before);
  counts_.received_bytes.add(octets);
  return delivered;
}

// @param drops as counted by the kernel since the socket was opened.
void UdpReceiver::count_drops(UdpSlot& slot, std::uint32_t drops) noexcept {
  const std::uint32_t more = drops - slot.drops_seen;
  slot.drops_seen = drops;
  counts_.kernel_drops.add(more);
  tap_.note_drops(slot.group, more);
}

// Discards the rest of a run; a tap receives the reason.
void UdpReceiver::pass_over(Arrived& run, const std::byte* start, DatagramFate fate) noexcept {
  for (; tap_.is_on() && run.left > 0; --run.left) {
    const std::size_t length = std::min(run.segment, run.length - run.taken);
    const std::span<const std::byte> one(start + run.taken, length);
    tap_.note(DatagramTap::Loop::read, DatagramFate::arrived, run.group, one);
    tap_.note(DatagramTap::Loop::read, fate, run.group, one);
    run.taken += length;
  }
  run.left = 0;
}

void UdpReceiver::forget(const GroupAddress& group) noexcept {
  for (std::size_t i = next_arrived_; i < arrived_count_; ++i) {
    if (arrived_[i].group == group) pass_over(arrived_[i], start_of(i), DatagramFate::unread);
  }
}

unsigned UdpReceiver::interface_of(const Datagram& datagram) const noexcept {
  const auto place = static_cast<std::size_t>(datagram.bytes.data() - buffers_.get());
  return arrived_[place / buffer_size_].interface;
}

void UdpReceiver::settle(UdpSlot& slot) noexcept {
  if (!slot.socket.is_open()) return;
  recycle();
  const std::size_t held = arrived_count_;  // of other groups, not returned yet
  for (bool more = tap_.is_on() && held < arrived_.size(); more;) {
    take(slot, 1);
    more = arrived_count_ > held;
    forget(slot.group);
    arrived_count_ = held;
  }
  std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
  socklen_t size = sizeof memory;
  if (getsockopt(slot.socket.native_handle(), SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0)
    count_drops(slot, memory[SK_MEMINFO_DROPS]);
}

bool UdpReceiver::has_arrived() const noexcept {
  return std::any_of(arrived_.begin() + static_cast<std::ptrdiff_t>(next_arrived_),
                     arrived_.begin() + static_cast<std::ptrdiff_t>(arrived_count_),
                     [](const Arrived& run) { return run.left > 0; });
}

std::size_t UdpReceiver::take_turn(UdpSlot& slot, std::span<Datagram> out, std::size_t delivered,
                                   std::size_t most) noexcept {
  const std::size_t turn = slot.brings_runs ? kMostRunsInTurn : kMostInTurn;
  const std::size_t room = batch_ - arrived_count_;
  take(slot, std::min({out.size() - delivered, room, turn, most}));
  return hand_over(out, delivered);
}

}  // namespace reckon::peer
