// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a UdpMulticast receives: the reading thread's part.
#include <linux/sock_diag.h>
#include <netinet/udp.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "reckon/peer/network/udp_multicast_state.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// One socket gives no more messages in its turn, so that a flooded group does not keep others from
// being read; fewer where each is a run of many datagrams.
constexpr std::size_t kMostInTurn = 16, kMostRunsInTurn = 1;

}  // namespace

// Takes up to `count` messages of one socket into the buffers behind those in use.
void UdpMulticast::State::take(std::size_t slot, std::size_t count) noexcept {
  if (!slots[slot].socket.is_open()) return;
  const std::size_t first = arrived_count;
  for (std::size_t i = first; i < first + count; ++i) {
    vectors[i] = {buffers.get() + i * buffer_size, buffer_size};
    msghdr& header = messages[i].msg_hdr;
    header = {&senders[i], sizeof senders[i], &vectors[i], 1, &controls[i], kControlBytes, 0};
  }
  const int got = recvmmsg(slots[slot].socket.native_handle(), messages.data() + first,
                           static_cast<unsigned>(count), MSG_DONTWAIT, nullptr);
  const nanoseconds now = clock.now();
  if (got <= 0) {
    if (got < 0 && errno != EAGAIN && errno != EINTR) counts.receive_errors.add();
    slots[slot].empty = now;
    return;
  }
  const nanoseconds utc = clock.utc_now();
  arrived_count += static_cast<std::size_t>(got);
  slots[slot].brings_runs = false;
  for (std::size_t i = first; i < arrived_count; ++i) accept(slots[slot], i, now, utc);
  if (static_cast<std::size_t>(got) < count) slots[slot].empty = now;
}

// Notes what is in a buffer, as far as it is for us.
void UdpMulticast::State::accept(Slot& slot, std::size_t buffer, nanoseconds now,
                                 nanoseconds utc) noexcept {
  const mmsghdr& message = messages[buffer];
  Arrived& out = arrived[buffer];
  out = {slot.group, from_sockaddr(senders[buffer]), now, message.msg_len, message.msg_len, 0, 1};
  read_control(slot, message.msg_hdr, utc, out);
  if (out.segment > 0) out.left = (out.length + out.segment - 1) / out.segment;
  if (out.left > 1) slot.brings_runs = true;
  if ((message.msg_hdr.msg_flags & MSG_TRUNC) != 0 || out.segment > options.max_datagram) {
    counts.truncated.add(out.left);
    out.left = 0;
  } else if (out.sender == local) {
    echo.hear(slot.group);
    if (options.deliver_own) return;
    counts.own.add(out.left);
    pass_over(out, start_of(buffer), DatagramFate::own);
  }
}

// Reads when it arrived, as steady time, how it is to be cut, and how many were dropped before it.
// A stamp from before the socket was last seen empty is a clock that was set, not a datagram that
// waited.
void UdpMulticast::State::read_control(Slot& slot, const msghdr& header, nanoseconds utc,
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
    }
  }
  const nanoseconds longest = out.received - std::max(slot.empty, all_empty);
  if (age >= nanoseconds{0} && age <= longest) out.received -= age;
}

// Cuts what has arrived into datagrams, from `delivered` on; returns how many `out` has then.
std::size_t UdpMulticast::State::hand_over(std::span<Datagram> out,
                                           std::size_t delivered) noexcept {
  const std::size_t before = delivered;
  std::size_t octets = 0;
  while (next_arrived < arrived_count && delivered < out.size()) {
    Arrived& run = arrived[next_arrived];
    const std::byte* start = start_of(next_arrived);
    for (; run.left > 0 && delivered < out.size(); --run.left) {
      const std::size_t length = std::min(run.segment, run.length - run.taken);
      out[delivered++] = {run.group, run.sender, {start + run.taken, length}, run.received};
      note(DatagramTap::Loop::read, DatagramFate::arrived, run.group, out[delivered - 1].bytes);
      run.taken += length;
      octets += length;
    }
    if (run.left == 0) ++next_arrived;
  }
  counts.received.add(delivered - before);
  counts.received_bytes.add(octets);
  return delivered;
}

// `drops` as the kernel has counted them since the socket was opened.
void UdpMulticast::State::count_drops(Slot& slot, std::uint32_t drops) noexcept {
  const std::uint32_t more = drops - slot.drops_seen;
  slot.drops_seen = drops;
  counts.kernel_drops.add(more);
  if (options.tap == nullptr || more == 0) return;
  DatagramEvent event;
  event.group = slot.group;
  event.fate = DatagramFate::kernel_drops;
  event.count = more;
  options.tap->push(DatagramTap::Loop::read, event);
}

// What is left of it is not handed up; a tap receives why.
void UdpMulticast::State::pass_over(Arrived& run, const std::byte* start,
                                    DatagramFate fate) noexcept {
  for (; options.tap != nullptr && run.left > 0; --run.left) {
    const std::size_t length = std::min(run.segment, run.length - run.taken);
    const std::span<const std::byte> one(start + run.taken, length);
    note(DatagramTap::Loop::read, DatagramFate::arrived, run.group, one);
    note(DatagramTap::Loop::read, fate, run.group, one);
    run.taken += length;
  }
  run.left = 0;
}

// What a group that was left still had waiting here.
void UdpMulticast::State::forget(const GroupAddress& group) noexcept {
  for (std::size_t i = next_arrived; i < arrived_count; ++i) {
    if (arrived[i].group == group) pass_over(arrived[i], start_of(i), DatagramFate::unread);
  }
}

// The last look at a socket: what the kernel dropped behind the last datagram, and, for a tap, what
// waits in it, which is not read any more.
void UdpMulticast::State::settle(Slot& slot) noexcept {
  if (!slot.socket.is_open()) return;
  if (next_arrived == arrived_count) arrived_count = next_arrived = 0;
  const std::size_t held = arrived_count;  // of other groups, not handed up yet
  for (bool more = options.tap != nullptr && held < arrived.size(); more;) {
    take(static_cast<std::size_t>(&slot - slots.data()), 1);
    more = arrived_count > held;
    forget(slot.group);
    arrived_count = held;
  }
  std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
  socklen_t size = sizeof memory;
  if (getsockopt(slot.socket.native_handle(), SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0)
    count_drops(slot, memory[SK_MEMINFO_DROPS]);
}

// Leaves the group. Where a tap asks for what waits, the membership ends before that is read:
// closing can wait for the kernel's lock of interfaces, and what came meanwhile would be reported
// nowhere.
void UdpMulticast::State::close(Slot& slot) noexcept {
  const nanoseconds asked = clock.now();
  if (options.tap != nullptr) leave_group(slot.socket, socket_options, slot.group);
  const nanoseconds left = clock.now();
  settle(slot);
  std::error_code ignored;  // closing leaves the group and epoll whatever it says
  slot.socket.close(ignored);
  tell_membership(DatagramFate::left, slot.group, asked, left);
}

void UdpMulticast::settle() noexcept {
  for (Slot& slot : state_->slots) state_->settle(slot);
}

bool UdpMulticast::State::has_arrived() const noexcept {
  return std::any_of(arrived.begin() + static_cast<std::ptrdiff_t>(next_arrived),
                     arrived.begin() + static_cast<std::ptrdiff_t>(arrived_count),
                     [](const Arrived& run) { return run.left > 0; });
}

// A turn of one socket; returns how many `out` has then.
std::size_t UdpMulticast::State::take_turn(std::size_t slot, std::span<Datagram> out,
                                           std::size_t delivered, std::size_t most) noexcept {
  const std::size_t turn = slots[slot].brings_runs ? kMostRunsInTurn : kMostInTurn;
  const std::size_t room = options.batch - arrived_count;
  take(slot, std::min({out.size() - delivered, room, turn, most}));
  return hand_over(out, delivered);
}

// What is read before the others: a turn of each that has something, `most` messages in all.
std::size_t UdpMulticast::State::take_first(std::span<Datagram> out, std::size_t delivered,
                                            std::size_t most) noexcept {
  std::array<epoll_event, 8> ready;
  const int count = epoll_wait(first_epoll.get(), ready.data(), static_cast<int>(ready.size()), 0);
  const std::size_t before = arrived_count;
  for (int i = 0; i < count; ++i) {
    const std::size_t left = most - std::min(most, arrived_count - before);
    if (left == 0 || delivered == out.size() || arrived_count == options.batch) break;
    delivered = take_turn(ready[static_cast<std::size_t>(i)].data.u32, out, delivered, left);
  }
  return delivered;
}

std::size_t UdpMulticast::receive(std::span<Datagram> out) noexcept {
  State& s = *state_;
  std::size_t delivered = s.hand_over(out, 0);
  // The buffers of what is handed up stay as they are until the next call.
  if (delivered == 0 && s.next_arrived == s.arrived_count) s.arrived_count = s.next_arrived = 0;
  std::size_t seen = kMaxBatch + 1;
  std::size_t first = s.options.read_first ? (s.options.batch + 1) / 2 : 0;
  while (delivered < out.size() && s.arrived_count < s.options.batch) {
    if (first > 0) {
      const std::size_t before = s.arrived_count;
      delivered = s.take_first(out, delivered, first);
      first -= s.arrived_count - before;
      if (delivered == out.size() || s.arrived_count == s.options.batch) break;
    }
    if (s.next_event == s.event_count) {
      if (s.arrived_count == seen) break;  // nothing came of those that were ready
      seen = s.arrived_count;
      s.poll(nanoseconds{0});
      if (s.first_ready && s.event_count == 0) first = s.options.batch;
      continue;
    }
    const std::uint32_t tag = s.events[s.next_event++].data.u32;
    delivered = s.take_turn(tag, out, delivered, s.options.batch);
  }
  return delivered;
}

}  // namespace reckon::peer
