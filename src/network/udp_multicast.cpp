// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_multicast.hpp"

#include <linux/sockios.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <new>
#include <stdexcept>

#include "reckon/peer/network/host_limits.hpp"
#include "reckon/peer/network/udp_multicast_state.hpp"

namespace reckon::peer {
namespace {

using asio::ip::udp;
using std::chrono::nanoseconds;

constexpr std::size_t kMaxUdpPayload = 65507;
// One socket gives no more in its turn, so that a flooded group does not keep others from being
// read.
constexpr std::size_t kMostInTurn = 16;
constexpr std::uint32_t kWakeTag = 0xffffffffu, kHostTag = 0xfffffffeu;

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

UdpMulticast::State::State(const UdpMulticastOptions& asked, const Clock& steady)
    : options(asked),
      clock(steady),
      choice(choose_interface(asked.interface, asked.ipv6)),
      socket_options{choice.interface.index, asked.ipv6, asked.ttl, asked.receive_buffer,
                     asked.broadcast},
      interface_index(choice.interface.index),
      buffers(asked.batch * asked.max_datagram) {
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
  if (!watch(wake.get(), kWakeTag) || !watch(0)) {
    throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  }
  told_by_kernel = host.descriptor() >= 0 && watch(host.descriptor(), kHostTag);
  warn(asked);
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
  if (!choice.interface.multicast && !choice.interface.loopback) {
    warnings.push_back("interface " + choice.interface.name +
                       " says it has no multicast; choose another with --iface, or ip link set " +
                       choice.interface.name + " multicast on");
  }
}

bool UdpMulticast::State::watch(int descriptor, std::uint32_t tag) noexcept {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u32 = tag;
  return epoll_ctl(epoll.get(), EPOLL_CTL_ADD, descriptor, &event) == 0;
}

bool UdpMulticast::State::watch(std::size_t slot) noexcept {
  return watch(slots[slot].socket.native_handle(), static_cast<std::uint32_t>(slot));
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
  // The wake-up stays unread here: wait() takes it, receive() leaves it to the next wait().
  const auto is_no_socket = [this](const epoll_event& event) {
    if (event.data.u32 == kHostTag) host_changed = host.take_changes() || host_changed;
    return event.data.u32 == kWakeTag || event.data.u32 == kHostTag;
  };
  const auto end =
      std::remove_if(events.begin(), events.begin() + std::max(ready, 0), is_no_socket);
  event_count = static_cast<std::size_t>(end - events.begin());
  if (ready >= 0 && event_count == 0) all_empty = begun;
}

bool UdpMulticast::State::drain_wake() noexcept {
  std::uint64_t times = 0;
  const bool was = ::read(wake.get(), &times, sizeof times) == sizeof times || woken;
  woken = false;
  return was;
}

// Takes up to `count` datagrams of one socket into the buffers from `first` on; returns how many
// the kernel gave. Those for us are appended to `out` at `delivered`.
std::size_t UdpMulticast::State::take(std::size_t slot, std::size_t first, std::size_t count,
                                      std::span<Datagram> out, std::size_t& delivered) noexcept {
  if (!slots[slot].socket.is_open()) return 0;
  for (std::size_t i = first; i < first + count; ++i) {
    vectors[i] = {buffers.data() + i * options.max_datagram, options.max_datagram};
    msghdr& header = messages[i].msg_hdr;
    header = {&senders[i], sizeof senders[i], &vectors[i], 1, &controls[i], kControlBytes, 0};
  }
  const int got = recvmmsg(slots[slot].socket.native_handle(), messages.data() + first,
                           static_cast<unsigned>(count), MSG_DONTWAIT, nullptr);
  const nanoseconds now = clock.now();
  if (got <= 0) {
    if (got < 0 && errno != EAGAIN && errno != EINTR) counts.receive_errors.add();
    slots[slot].empty = now;
    return 0;
  }
  const nanoseconds utc = clock.utc_now();
  for (std::size_t i = first; i < first + static_cast<std::size_t>(got); ++i) {
    if (accept(slots[slot], i, now, utc, out[delivered])) ++delivered;
  }
  if (static_cast<std::size_t>(got) < count) slots[slot].empty = now;
  return static_cast<std::size_t>(got);
}

bool UdpMulticast::State::accept(Slot& slot, std::size_t buffer, nanoseconds now, nanoseconds utc,
                                 Datagram& out) noexcept {
  const mmsghdr& message = messages[buffer];
  const nanoseconds received = read_control(slot, message.msg_hdr, now, utc);
  if ((message.msg_hdr.msg_flags & MSG_TRUNC) != 0) {
    counts.truncated.add();
    return false;
  }
  const IpEndpoint sender = from_sockaddr(senders[buffer]);
  if (sender == local) {
    echo.hear(slot.group);
    if (!options.deliver_own) {
      counts.own.add();
      return false;
    }
  }
  counts.received.add();
  counts.received_bytes.add(message.msg_len);
  out = {slot.group,
         sender,
         {buffers.data() + buffer * options.max_datagram, message.msg_len},
         received};
  return true;
}

// Reads when the datagram arrived, as steady time, and how many were dropped before it. A stamp
// from before the socket was last seen empty is a clock that was set, not a datagram that waited.
nanoseconds UdpMulticast::State::read_control(Slot& slot, const msghdr& header, nanoseconds now,
                                              nanoseconds utc) noexcept {
  nanoseconds age{0};
  msghdr* mutable_header = const_cast<msghdr*>(&header);  // CMSG_NXTHDR takes no const
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(mutable_header, c)) {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SO_TIMESTAMPNS) {
      timespec stamp;
      std::memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
      age = utc - std::chrono::seconds(stamp.tv_sec) - nanoseconds(stamp.tv_nsec);
    } else if (c->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t drops = 0;
      std::memcpy(&drops, CMSG_DATA(c), sizeof drops);
      counts.kernel_drops.add(drops - slot.drops_seen);
      slot.drops_seen = drops;
    }
  }
  const nanoseconds longest = now - std::max(slot.empty, all_empty);
  return age >= nanoseconds{0} && age <= longest ? now - age : now;
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
    *slot = Slot{std::move(socket), group, 0, clock.now()};
  } else if (slots.size() < slots.capacity()) {
    slots.push_back({std::move(socket), group, 0, clock.now()});
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

// Octets that have not left the host, as the kernel charges them. Some 0.1 us.
std::size_t UdpMulticast::State::queued() noexcept {
  int octets = 0;
  return ioctl(slots[0].socket.native_handle(), SIOCOUTQ, &octets) == 0
             ? static_cast<std::size_t>(octets)
             : 0;
}

// One sendto a datagram: sendmmsg changed the cost of a datagram by -1 to +12 % where it was
// measured, and bundling has already made few of many.
bool UdpMulticast::send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept {
  LinkCounters& counts = state_->counts;
  const std::size_t before = state_->queued();
  // The first group that was joined is the peers' own business: it goes before states.
  const bool may_wait = before > 0 && state_->echo.watches(to);
  if (!state_->pace.may_send(before, before > 0 ? state_->clock.now() : nanoseconds(0)) &&
      !may_wait) {
    counts.held_back.add();
    return false;
  }
  sockaddr_storage address{};
  const socklen_t size =
      to_sockaddr(to, state_->interface_index.load(std::memory_order_relaxed), address);
  const ssize_t sent =
      ::sendto(state_->slots[0].socket.native_handle(), bytes.data(), bytes.size(),
               MSG_DONTWAIT | MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address), size);
  if (sent < 0) {
    // Why before that: another thread may look in between.
    counts.last_send_error.set(static_cast<std::uint64_t>(errno));
    if (errno == EMSGSIZE) counts.too_big.add();
    counts.send_errors.add();
    return false;
  }
  counts.sent.add();
  counts.sent_bytes.add(bytes.size());
  if (before > 0) state_->pace.sent(std::max(state_->queued(), before) - before);
  state_->echo.send(to);
  return true;
}

std::size_t UdpMulticast::receive(std::span<Datagram> out) noexcept {
  State& s = *state_;
  const std::size_t wanted = std::min(out.size(), s.options.batch);
  std::size_t delivered = 0, used = 0, seen = kMaxBatch + 1;
  while (delivered < wanted && used < s.options.batch) {
    if (s.next_event == s.event_count) {
      if (used == seen) break;  // nothing came of those that were ready
      seen = used;
      s.poll(nanoseconds{0});
      continue;
    }
    const std::uint32_t tag = s.events[s.next_event++].data.u32;
    const std::size_t count = std::min({wanted - delivered, s.options.batch - used, kMostInTurn});
    used += s.take(tag, used, count, out, delivered);
  }
  return delivered;
}

std::error_code UdpMulticast::State::open(const GroupAddress& group) noexcept {
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
  Slot* slot = state_->find(group);
  if (slot == nullptr) return;
  std::error_code ignored;  // closing leaves the group and epoll whatever it says
  slot->socket.close(ignored);
  state_->counts.leaves.add();
}

bool UdpMulticast::wait(nanoseconds timeout) noexcept {
  State& s = *state_;
  s.recover();
  if (s.next_event == s.event_count) s.poll(timeout);
  const bool woken = s.drain_wake();
  return woken || s.next_event < s.event_count;
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

bool UdpMulticast::take_event(LinkEvent& event) noexcept { return state_->told.pop(event); }

std::size_t UdpMulticast::max_payload() const noexcept {
  const std::size_t header = header_bytes(state_->options.ipv6);
  return state_->mtu > header ? std::min(state_->mtu - header, kMaxUdpPayload) : 0;
}

LinkStatistics UdpMulticast::statistics() const noexcept { return state_->counts.values(); }

const InterfaceChoice& UdpMulticast::choice() const noexcept { return state_->choice; }
std::size_t UdpMulticast::mtu() const noexcept { return state_->mtu; }
std::size_t UdpMulticast::receive_buffer() const noexcept { return state_->receive_buffer; }
const std::vector<std::string>& UdpMulticast::warnings() const noexcept { return state_->warnings; }

}  // namespace reckon::peer
