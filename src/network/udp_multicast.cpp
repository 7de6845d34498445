// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_multicast.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <new>
#include <stdexcept>

#include "reckon/peer/network/host_limits.hpp"
#include "reckon/peer/network/udp_multicast_state.hpp"

namespace reckon::peer {
namespace {

using asio::ip::udp;
using std::chrono::nanoseconds;

constexpr std::size_t kMaxUdpPayload = 65507;
// A run of datagrams that the kernel hands over as one is no longer than one IP packet.
constexpr std::size_t kMostCoalesced = 65536;
constexpr std::uint32_t kWakeTag = 0xffffffffu, kHostTag = 0xfffffffeu, kFirstTag = 0xfffffffdu;

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

udp::socket open_sender_or_throw(asio::io_context& context, const UdpSocketOptions& options,
                                 const InterfaceChoice& choice, std::uint16_t port) {
  IpEndpoint local = choice.interface.address(options.ipv6).value();  // chosen for having one
  local.port = port;
  std::error_code error;
  udp::socket socket = open_sender(context, options, local, error);
  if (!error) return socket;
  throw std::system_error(error, "cannot open the sending socket on " + local.text() +
                                     " (take another --port or --iface)");
}

}  // namespace

std::size_t receive_room(double datagrams_per_second, nanoseconds stall,
                         std::size_t payload) noexcept {
  // The least room, what there is beside the payload (Ethernet to skb_shared_info), and an sk_buff.
  constexpr std::size_t kLeast = 576, kHeaders = 400, kDescriptor = 256;
  const std::size_t charged = std::max(std::bit_ceil(payload + kHeaders), kLeast) + kDescriptor;
  const double waiting = datagrams_per_second * std::chrono::duration<double>(stall).count();
  return static_cast<std::size_t>(std::ceil(waiting)) * charged / 2;
}

UdpMulticast::State::State(const UdpMulticastOptions& asked, const Clock& steady)
    : options(asked),
      clock(steady),
      choice(choose_interface(asked.interface, asked.ipv6)),
      socket_options{choice.interface.index, asked.ipv6,      asked.ttl,
                     asked.receive_buffer,   asked.broadcast, asked.offload},
      interface_index(choice.interface.index) {
  slots.reserve(asked.max_groups + 1);
  unjoined.reserve(asked.max_groups);
  slots.push_back({open_sender_or_throw(context, socket_options, choice, asked.unicast_port),
                   {},
                   0,
                   steady.now()});
  take_local_endpoint();
  receive_buffer = receive_buffer_of(slots[0].socket);
  const GroupPool pool = asked.ipv6 ? GroupPool::ipv6_default() : GroupPool::ipv4_default();
  mtu = path_mtu(context, socket_options, pool.base());
  if (mtu == 0) mtu = choice.interface.mtu;
  measure_payload();
  socket_options.coalesce = asked.offload && coalesces(slots[0].socket);
  if (!asked.offload) segment_refusal = EOPNOTSUPP;
  if (asked.offload) segment_refusal = segment_error(slots[0].socket);
  segment_told = segment_refusal != 0;
  buffer_size = socket_options.coalesce ? kMostCoalesced : asked.max_datagram;
  // One more, where a tap receives what waited in a group that is left while all are in use.
  const std::size_t most = asked.batch + (asked.tap == nullptr ? 0 : 1);
  buffers = std::make_unique_for_overwrite<std::byte[]>(most * buffer_size);
  if (!watch(epoll, wake.get(), kWakeTag) || !watch(epoll, first_epoll.get(), kFirstTag) ||
      !watch(0)) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
  told_by_kernel = host.descriptor() >= 0 && watch(epoll, host.descriptor(), kHostTag);
  warn(asked);
  if (asked.framed) {  // where all of a list come to
    tell_membership(DatagramFate::joined, slots[0].group, slots[0].empty, slots[0].empty);
  }
}

void UdpMulticast::State::take_local_endpoint() {
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  getsockname(slots[0].socket.native_handle(), reinterpret_cast<sockaddr*>(&bound), &size);
  const std::lock_guard lock(naming);
  local = slots[0].group = from_sockaddr(bound);
}

void UdpMulticast::State::warn(const UdpMulticastOptions& asked) {
  if (receive_buffer < asked.receive_buffer) {
    warnings.push_back("receive buffer: asked for " + std::to_string(asked.receive_buffer) +
                       " octets, the kernel gave " + std::to_string(receive_buffer) +
                       "; sysctl -w net.core.rmem_max=" + std::to_string(asked.receive_buffer));
  }
  if (asked.offload && (segment_refusal != 0 || !socket_options.coalesce)) {
    warnings.push_back(std::string("this kernel does not ") +
                       (segment_refusal != 0
                            ? "cut runs of datagrams (UDP_SEGMENT, since Linux 4.18)"
                            : "hand over runs of datagrams as one (UDP_GRO, since Linux 5.0)") +
                       ": each takes a way of its own, at some 2 to 9 times the cost");
  }
  if (!choice.interface.multicast && !choice.interface.loopback) {
    warnings.push_back("interface " + choice.interface.name +
                       " says it has no multicast; choose another with --iface, or ip link set " +
                       choice.interface.name + " multicast on");
  }
}

void UdpMulticast::State::measure_payload() noexcept {
  const std::size_t header = header_bytes(options.ipv6);
  max_payload = mtu > header ? std::min(mtu - header, kMaxUdpPayload) : 0;
}

bool UdpMulticast::State::watch(const Descriptor& where, int descriptor,
                                std::uint32_t tag) noexcept {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u32 = tag;
  return epoll_ctl(where.get(), EPOLL_CTL_ADD, descriptor, &event) == 0;
}

bool UdpMulticast::State::watch(std::size_t slot) noexcept {
  return watch(slots[slot].first ? first_epoll : epoll, slots[slot].socket.native_handle(),
               static_cast<std::uint32_t>(slot));
}

// Looks which sockets are readable. An interruption by a signal counts as woken, so that the caller
// sees what the signal handler wrote.
void UdpMulticast::State::poll(nanoseconds timeout) noexcept {
  const nanoseconds bounded = std::max(timeout, nanoseconds{0});
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(bounded);
  const timespec limit{seconds.count(), (bounded - seconds).count()};
  const nanoseconds begun = clock.now();
  const int ready =
      epoll_pwait2(epoll.get(), events.data(), static_cast<int>(events.size()), &limit, nullptr);
  if (ready < 0) woken = true;
  next_event = 0;
  first_ready = false;
  // The wake-up stays unread here: wait() takes it, receive() leaves it to the next wait().
  const auto is_no_socket = [this](const epoll_event& event) {
    if (event.data.u32 == kHostTag) host_changed = host.take_changes() || host_changed;
    if (event.data.u32 == kFirstTag) first_ready = true;
    return event.data.u32 >= kFirstTag;
  };
  const auto end =
      std::remove_if(events.begin(), events.begin() + std::max(ready, 0), is_no_socket);
  event_count = static_cast<std::size_t>(end - events.begin());
  if (ready >= 0 && event_count == 0 && !first_ready) all_empty = begun;
}

bool UdpMulticast::State::drain_wake() noexcept {
  std::uint64_t times = 0;
  const bool was = ::read(wake.get(), &times, sizeof times) == sizeof times || woken;
  woken = false;
  return was;
}

Slot* UdpMulticast::State::find(const GroupAddress& group) noexcept {
  for (std::size_t i = 1; i < slots.size(); ++i) {
    if (slots[i].socket.is_open() && slots[i].group == group) return &slots[i];
  }
  return nullptr;
}

// Keeps an open socket in the slot of a group that was left, else in a new one.
std::error_code UdpMulticast::State::adopt(udp::socket socket, const GroupAddress& group) {
  auto slot = std::find_if(slots.begin() + 1, slots.end(),
                           [](const Slot& candidate) { return !candidate.socket.is_open(); });
  if (slot != slots.end()) {
    *slot = Slot{std::move(socket), group, 0, clock.now(), false, reads_first(group)};
  } else if (slots.size() < slots.capacity()) {
    slots.push_back({std::move(socket), group, 0, clock.now(), false, reads_first(group)});
    slot = slots.end() - 1;
  } else {
    return std::make_error_code(std::errc::value_too_large);
  }
  if (watch(static_cast<std::size_t>(slot - slots.begin()))) return {};
  const std::error_code error(errno, std::generic_category());
  slot->socket.close();
  return error;
}

UdpMulticast::UdpMulticast(const UdpMulticastOptions& options, const Clock& clock) {
  check(options);
  raise_open_file_limit();
  state_ = std::make_unique<State>(options, clock);
}

UdpMulticast::~UdpMulticast() = default;

void UdpMulticast::State::tell_membership(DatagramFate change, const GroupAddress& group,
                                          nanoseconds asked, nanoseconds done) noexcept {
  if (options.tap == nullptr) return;
  DatagramEvent event;
  event.group = group;
  event.fate = change;
  event.asked = asked;
  event.time = done;
  options.tap->push(DatagramTap::Loop::read, event);
}

std::error_code UdpMulticast::State::open(const GroupAddress& group) noexcept {
  const nanoseconds asked = clock.now();
  std::error_code error;
  try {
    udp::socket socket = open_group(context, socket_options, group, error);
    if (!error) error = adopt(std::move(socket), group);
  } catch (const std::bad_alloc&) {
    error = std::make_error_code(std::errc::not_enough_memory);
  } catch (const std::system_error& failure) {
    error = failure.code();
  }
  if (error) counts.last_join_error.set(static_cast<std::uint64_t>(error.value()));
  (error ? counts.join_errors : counts.joins).add();
  if (!error) tell_membership(DatagramFate::joined, group, asked, clock.now());
  return error;
}

std::error_code UdpMulticast::join(const GroupAddress& group) noexcept {
  State& s = *state_;
  if (s.find(group) != nullptr) return {};
  const std::error_code error = s.open(group);
  if (!error) {
    std::erase(s.unjoined, group);
    s.echo.joined(group);
  }
  return error;
}

void UdpMulticast::leave(const GroupAddress& group) noexcept {
  std::erase(state_->unjoined, group);
  state_->echo.left(group);
  state_->forget(group);
  Slot* slot = state_->find(group);
  if (slot == nullptr) return;
  state_->close(*slot);
  state_->counts.leaves.add();
}

bool UdpMulticast::wait(nanoseconds timeout) noexcept {
  State& s = *state_;
  s.recover();
  const bool waits_here = s.has_arrived();
  if (s.next_event == s.event_count) s.poll(waits_here ? nanoseconds{0} : timeout);
  const bool woken = s.drain_wake();
  return woken || waits_here || s.first_ready || s.next_event < s.event_count;
}

void UdpMulticast::wake() noexcept {
  const std::uint64_t one = 1;
  // It can only fail when the count is full, and then the reader is being woken already.
  [[maybe_unused]] const ssize_t written = ::write(state_->wake.get(), &one, sizeof one);
}

IpEndpoint UdpMulticast::local_endpoint() const noexcept {
  const std::lock_guard lock(state_->naming);
  return state_->local;
}

bool UdpMulticast::take_event(LinkEvent& event) noexcept { return state_->link_events.pop(event); }

std::size_t UdpMulticast::max_payload() const noexcept { return state_->max_payload; }

LinkStatistics UdpMulticast::statistics() const noexcept { return state_->counts.values(); }

const InterfaceChoice& UdpMulticast::choice() const noexcept { return state_->choice; }
std::size_t UdpMulticast::mtu() const noexcept { return state_->mtu; }
std::size_t UdpMulticast::receive_buffer() const noexcept { return state_->receive_buffer; }
UdpOffload UdpMulticast::offload() const noexcept {
  return {state_->segment_refusal == 0, state_->socket_options.coalesce,
          state_->options.offload ? state_->segment_refusal.load() : 0};
}
const std::vector<std::string>& UdpMulticast::warnings() const noexcept { return state_->warnings; }

}  // namespace reckon::peer
