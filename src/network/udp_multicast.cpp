// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_multicast.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "reckon/peer/network/host_limits.hpp"
#include "reckon/peer/network/udp_readiness.hpp"
#include "reckon/peer/network/udp_receiver.hpp"
#include "reckon/peer/network/udp_recovery.hpp"
#include "reckon/peer/network/udp_sender.hpp"
#include "reckon/peer/network/udp_socket_table.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kMaxUdpPayload = 65507;

std::size_t header_bytes(bool ipv6) { return ipv6 ? 40 + 8 : 20 + 8; }

void check(const UdpMulticastOptions& options) {
  const auto refuse = [](const std::string& text) { throw std::invalid_argument(text); };
  if (options.batch < 1 || options.batch > kMaxBatch) {
    refuse("batch = " + std::to_string(options.batch) + " is not from 1 to 64");
  }
  if (options.ttl < 0 || options.ttl > 255) {
    refuse("ttl = " + std::to_string(options.ttl) + " is not from 0 to 255");
  }
  if (options.max_datagram < 1 || options.max_datagram > 65535) {
    refuse("max_datagram = " + std::to_string(options.max_datagram) + " is not from 1 to 65535");
  }
  if (options.receive_buffer > std::size_t{1} << 30) {
    refuse("receive_buffer = " + std::to_string(options.receive_buffer) + " is above 1 GiB");
  }
}

// IP_MTU from the kernel, else the value of the interface.
std::size_t measure_mtu(UdpSocketTable& table, const InterfaceChoice& choice, bool ipv6) {
  const GroupPool pool = ipv6 ? GroupPool::ipv6_default() : GroupPool::ipv4_default();
  const std::size_t mtu = table.mtu(pool.base());
  return mtu == 0 ? choice.interface.mtu : mtu;
}

// The largest payload that fits the MTU unfragmented.
std::size_t payload_of(std::size_t mtu, bool ipv6) {
  const std::size_t header = header_bytes(ipv6);
  return mtu > header ? std::min(mtu - header, kMaxUdpPayload) : 0;
}

}  // namespace

std::size_t receive_room(double datagrams_per_second, nanoseconds stall,
                         std::size_t payload) noexcept {
  // The least size, the overhead besides the payload (Ethernet to skb_shared_info), and an sk_buff.
  constexpr std::size_t kLeast = 576, kHeaders = 400, kDescriptor = 256;
  const std::size_t charged = std::max(std::bit_ceil(payload + kHeaders), kLeast) + kDescriptor;
  const double waiting = datagrams_per_second * std::chrono::duration<double>(stall).count();
  return static_cast<std::size_t>(std::ceil(waiting)) * charged / 2;
}

// All but the sender belongs to the reading thread.
struct UdpMulticast::Sockets {
  Sockets(const UdpMulticastOptions& asked, const Clock& clock);

  void warn();
  void poll(nanoseconds timeout) noexcept;
  std::size_t take_turn(UdpSlot& slot, std::span<Datagram> out, std::size_t delivered,
                        std::size_t most) noexcept;
  std::size_t receive_first(std::span<Datagram> out, std::size_t delivered,
                            std::size_t most) noexcept;

  const UdpMulticastOptions options;
  const InterfaceChoice choice;
  LinkCounters counts;
  LocalEndpoint local;
  EchoWatch echo;
  LinkTap tap;
  UdpReadiness ready;
  UdpReceiver receiver;
  UdpSocketTable table;
  const std::size_t mtu, receive_buffer;  // [octets]
  UdpSender sender;
  UdpRecovery recovery;
  std::vector<std::string> warnings;
  bool left = false;  // of what the last poll found, some may be unread
};

UdpMulticast::Sockets::Sockets(const UdpMulticastOptions& asked, const Clock& clock)
    : options(asked),
      choice(choose_interface(asked.interface, asked.ipv6)),
      tap(asked.tap, asked.framed),
      ready(clock),
      receiver(options, clock, ready, local, tap, echo, counts),
      table({options, clock, ready, receiver, local, tap, echo, counts}, choice.interface),
      mtu(measure_mtu(table, choice, asked.ipv6)),
      receive_buffer(table.receive_buffer()),
      sender({table[0].socket.native_handle(), choice.interface.index, payload_of(mtu, asked.ipv6),
              asked.offload ? table.segment_error() : EOPNOTSUPP},
             clock, tap, echo, counts),
      recovery({options, clock, ready, table, sender, local, echo, counts}, choice.interface) {
  receiver.reserve(table.coalesces());
  warn();
}

void UdpMulticast::Sockets::warn() {
  if (receive_buffer < options.receive_buffer) {
    warnings.push_back("receive buffer: asked for " + std::to_string(options.receive_buffer) +
                       " octets, the kernel gave " + std::to_string(receive_buffer) +
                       "; sysctl -w net.core.rmem_max=" + std::to_string(options.receive_buffer));
  }
  if (options.offload && (sender.segment_refusal() != 0 || !table.coalesces())) {
    warnings.push_back(std::string("this kernel does not ") +
                       (sender.segment_refusal() != 0
                            ? "segment datagrams (UDP_SEGMENT, since Linux 4.18)"
                            : "coalesce datagrams (UDP_GRO, since Linux 5.0)") +
                       ": each is processed separately, at 2 to 9 times the cost");
  }
  if (!choice.interface.multicast && !choice.interface.loopback) {
    warnings.push_back("interface " + choice.interface.name +
                       " has no multicast; choose another with --iface, or ip link set " +
                       choice.interface.name + " multicast on");
  }
}

void UdpMulticast::Sockets::poll(nanoseconds timeout) noexcept {
  ready.poll(timeout);
  left = ready.is_crowded();
}

std::size_t UdpMulticast::Sockets::take_turn(UdpSlot& slot, std::span<Datagram> out,
                                             std::size_t delivered, std::size_t most) noexcept {
  delivered = receiver.take_turn(slot, out, delivered, most);
  left = left || !receiver.has_emptied();
  return delivered;
}

// Reads the prioritised groups: one turn of each that has datagrams, at most `most` messages in
// all.
std::size_t UdpMulticast::Sockets::receive_first(std::span<Datagram> out, std::size_t delivered,
                                                 std::size_t most) noexcept {
  std::array<std::uint32_t, UdpReadiness::kMostFirst> numbers;
  const std::size_t count = ready.find_first(numbers);
  const std::size_t before = receiver.messages();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t room = most - std::min(most, receiver.messages() - before);
    left = left || room == 0;
    if (room == 0 || delivered == out.size() || receiver.is_full()) break;
    delivered = take_turn(table[numbers[i]], out, delivered, room);
  }
  return delivered;
}

UdpMulticast::UdpMulticast(const UdpMulticastOptions& options, const Clock& clock) {
  check(options);
  raise_open_file_limit();
  sockets_ = std::make_unique<Sockets>(options, clock);
}

UdpMulticast::~UdpMulticast() = default;

bool UdpMulticast::send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept {
  return sockets_->sender.send({to, bytes});
}

SentBatch UdpMulticast::send_batch(std::span<const OutgoingDatagram> batch) noexcept {
  return sockets_->sender.send_batch(batch);
}

std::size_t UdpMulticast::receive(std::span<Datagram> out) noexcept {
  Sockets& s = *sockets_;
  UdpReceiver& receiver = s.receiver;
  std::size_t delivered = receiver.hand_over(out, 0);
  // The buffers of returned datagrams stay valid until the next call.
  if (delivered == 0) receiver.recycle();
  bool polled = s.ready.has_next() || s.left;
  std::size_t first = s.options.read_first ? (s.options.batch + 1) / 2 : 0;
  while (delivered < out.size() && !receiver.is_full()) {
    if (first > 0) {
      const std::size_t before = receiver.messages();
      delivered = s.receive_first(out, delivered, first);
      first -= receiver.messages() - before;
      if (delivered == out.size() || receiver.is_full()) break;
    }
    if (!s.ready.has_next()) {
      if (polled && !s.left) break;  // the ready sockets were read empty
      polled = true;
      s.poll(nanoseconds{0});
      if (s.ready.is_first_ready() && !s.ready.has_next()) first = s.options.batch;
      continue;
    }
    delivered = s.take_turn(s.table[s.ready.next()], out, delivered, s.options.batch);
  }
  return delivered;
}

std::error_code UdpMulticast::join(const GroupAddress& group) noexcept {
  return sockets_->table.join(group);
}

void UdpMulticast::leave(const GroupAddress& group) noexcept { sockets_->table.leave(group); }

bool UdpMulticast::wait(nanoseconds timeout) noexcept {
  Sockets& s = *sockets_;
  s.recovery.recover();
  const bool waits_here = s.receiver.has_arrived();
  if (!s.ready.has_next()) s.poll(waits_here ? nanoseconds{0} : timeout);
  const bool woken = s.ready.take_wake();
  return woken || waits_here || s.ready.is_first_ready() || s.ready.has_next();
}

void UdpMulticast::wake() noexcept { sockets_->ready.wake(); }

void UdpMulticast::settle() noexcept {
  for (UdpSlot& slot : sockets_->table.slots()) sockets_->receiver.settle(slot);
}

IpEndpoint UdpMulticast::local_endpoint() const noexcept { return sockets_->local.copy(); }

bool UdpMulticast::take_event(LinkEvent& event) noexcept {
  return sockets_->recovery.take_event(event);
}

std::size_t UdpMulticast::max_payload() const noexcept { return sockets_->sender.max_payload(); }

LinkStatistics UdpMulticast::statistics() const noexcept { return sockets_->counts.values(); }

const InterfaceChoice& UdpMulticast::choice() const noexcept { return sockets_->choice; }
std::size_t UdpMulticast::mtu() const noexcept { return sockets_->mtu; }
std::size_t UdpMulticast::receive_buffer() const noexcept { return sockets_->receive_buffer; }
UdpOffload UdpMulticast::offload() const noexcept {
  const int refusal = sockets_->sender.segment_refusal();
  return {refusal == 0, sockets_->table.coalesces(), sockets_->options.offload ? refusal : 0};
}
const std::vector<std::string>& UdpMulticast::warnings() const noexcept {
  return sockets_->warnings;
}

}  // namespace reckon::peer
