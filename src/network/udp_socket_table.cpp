// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_socket_table.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <utility>

namespace reckon::peer {
namespace {

using asio::ip::udp;
using std::chrono::nanoseconds;

udp::socket open_unicast_or_throw(asio::io_context& context, const UdpSocketOptions& options,
                                  const NetworkInterface& interface, std::uint16_t port) {
  IpEndpoint local = interface.address(options.ipv6).value();  // chosen because it has one
  local.port = port;
  std::error_code error;
  udp::socket socket = open_sender(context, options, local, error);
  if (!error) return socket;
  throw std::system_error(error, "cannot open the sending socket on " + local.text() +
                                     " (choose another --port or --iface)");
}

}  // namespace

UdpSocketTable::UdpSocketTable(const Surroundings& link, const NetworkInterface& interface)
    : link_(link), options_{interface.index,        link.options.ipv6,
                            link.options.ttl,       link.options.receive_buffer,
                            link.options.broadcast, link.options.fragments,
                            link.options.offload} {
  const UdpMulticastOptions& asked = link.options;
  broadcasts_ = interface.broadcasts;
  slots_.reserve(asked.max_groups + 1);
  missing_.reserve(asked.max_groups);
  slots_.push_back({open_unicast_or_throw(context_, options_, interface, asked.unicast_port),
                    {},
                    0,
                    link.clock.now()});
  take_local_endpoint();
  options_.coalesce = asked.offload && peer::coalesces(slots_[0].socket);
  if (!watch(0)) throw std::system_error(errno, std::generic_category(), "epoll_ctl");
  if (asked.framed) {  // the destination of all datagrams of a list
    link.tap.note_membership(DatagramFate::joined, slots_[0].group, slots_[0].empty,
                             slots_[0].empty);
  }
}

void UdpSocketTable::take_local_endpoint() {
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  getsockname(slots_[0].socket.native_handle(), reinterpret_cast<sockaddr*>(&bound), &size);
  slots_[0].group = from_sockaddr(bound);
  link_.local.set(slots_[0].group);
}

int UdpSocketTable::segment_error() noexcept { return peer::segment_error(slots_[0].socket); }

std::size_t UdpSocketTable::receive_buffer() { return receive_buffer_of(slots_[0].socket); }

std::size_t UdpSocketTable::mtu(const GroupAddress& group) {
  return path_mtu(context_, options_, group);
}

bool UdpSocketTable::watch(std::size_t number) noexcept {
  return link_.ready.add(slots_[number].socket.native_handle(), static_cast<std::uint32_t>(number),
                         slots_[number].first);
}

bool UdpSocketTable::reads_first(const GroupAddress& group) const noexcept {
  const std::optional<GroupPool>& pool = link_.options.read_first;
  return pool && pool->index(group).has_value();
}

UdpSlot* UdpSocketTable::find(const GroupAddress& group) noexcept {
  for (std::size_t i = 1; i < slots_.size(); ++i) {
    if (slots_[i].socket.is_open() && slots_[i].group == group) return &slots_[i];
  }
  return nullptr;
}

// Keeps an open socket in the slot of a former group, else in a new one.
std::error_code UdpSocketTable::adopt(udp::socket socket, const GroupAddress& group) {
  auto slot = std::find_if(slots_.begin() + 1, slots_.end(),
                           [](const UdpSlot& candidate) { return !candidate.socket.is_open(); });
  const nanoseconds now = link_.clock.now();
  if (slot != slots_.end()) {
    *slot = UdpSlot{std::move(socket), group, 0, now, false, reads_first(group)};
  } else if (slots_.size() < slots_.capacity()) {
    slots_.push_back({std::move(socket), group, 0, now, false, reads_first(group)});
    slot = slots_.end() - 1;
  } else {
    return std::make_error_code(std::errc::value_too_large);
  }
  if (watch(static_cast<std::size_t>(slot - slots_.begin()))) return {};
  const std::error_code error(errno, std::generic_category());
  slot->socket.close();
  return error;
}

// The broadcast addresses of everybody and of the subnet count as one group: users of one form also
// expect datagrams to the other.
std::vector<IpEndpoint> UdpSocketTable::addresses_of(const GroupAddress& group) const {
  std::vector<IpEndpoint> out{group};
  if (!may_be_broadcast(group)) return out;
  out.push_back(IpEndpoint::v4(0xffffffffu, group.port));
  if (group.is_broadcast()) {
    out.pop_back();
    for (IpEndpoint address : broadcasts_) {
      address.port = group.port;
      out.push_back(address);
    }
  }
  return out;
}

std::error_code UdpSocketTable::open(const GroupAddress& group) noexcept {
  const nanoseconds asked = link_.clock.now();
  std::error_code error;
  try {
    for (const IpEndpoint& address : addresses_of(group)) {
      std::error_code refused;
      udp::socket socket = open_group(context_, options_, address, refused);
      if (!refused) refused = adopt(std::move(socket), group);
      if (address == group) error = refused;  // the other form is optional
      if (error) break;
    }
  } catch (const std::bad_alloc&) {
    error = std::make_error_code(std::errc::not_enough_memory);
  } catch (const std::system_error& failure) {
    error = failure.code();
  }
  LinkCounters& counts = link_.counts;
  if (error) counts.last_join_error.set(static_cast<std::uint64_t>(error.value()));
  (error ? counts.join_errors : counts.joins).add();
  if (!error) {
    link_.tap.note_membership(DatagramFate::joined, group, asked, link_.clock.now());
  }
  return error;
}

// Leaves the group. If a tap needs the pending datagrams, the membership ends before they are read.
// Closing can wait for the kernel's lock of interfaces, and datagrams that arrive during this wait
// would not be reported.
void UdpSocketTable::close(UdpSlot& slot) noexcept {
  const nanoseconds asked = link_.clock.now();
  if (link_.tap.is_on()) leave_group(slot.socket, options_, slot.group);
  const nanoseconds left = link_.clock.now();
  link_.receiver.settle(slot);
  std::error_code ignored;  // closing leaves the group and epoll in any case
  slot.socket.close(ignored);
  link_.tap.note_membership(DatagramFate::left, slot.group, asked, left);
}

std::error_code UdpSocketTable::join(const GroupAddress& group) noexcept {
  if (find(group) != nullptr) return {};
  const std::error_code error = open(group);
  if (!error) {
    std::erase(missing_, group);
    link_.echo.joined(group);
  }
  return error;
}

void UdpSocketTable::leave(const GroupAddress& group) noexcept {
  std::erase(missing_, group);
  link_.echo.left(group);
  link_.receiver.forget(group);
  UdpSlot* slot = find(group);
  if (slot == nullptr) return;
  for (; slot != nullptr; slot = find(group)) close(*slot);
  link_.counts.leaves.add();
}

void UdpSocketTable::rejoin() {
  link_.counts.recoveries.add();
  for (std::size_t i = 1; i < slots_.size(); ++i) {
    if (!slots_[i].socket.is_open()) continue;
    close(slots_[i]);
    if (std::find(missing_.begin(), missing_.end(), slots_[i].group) == missing_.end())
      missing_.push_back(slots_[i].group);
  }
  link_.ready.clear();
  join_missing();
  link_.echo.restart();
}

void UdpSocketTable::join_missing() {
  std::erase_if(missing_, [this](const GroupAddress& group) { return !open(group); });
}

std::size_t UdpSocketTable::joined() const noexcept {
  const auto count = std::count_if(slots_.begin() + 1, slots_.end(),
                                   [](const UdpSlot& slot) { return slot.socket.is_open(); });
  return static_cast<std::size_t>(count);
}

std::error_code UdpSocketTable::renew_outgoing_interface() {
  return set_outgoing_interface(slots_[0].socket, options_);
}

std::error_code UdpSocketTable::reopen_unicast(const IpEndpoint& endpoint) {
  IpEndpoint bound = endpoint;
  std::error_code error;
  udp::socket socket = open_sender(context_, options_, bound, error);
  if (error == std::errc::address_in_use) {
    bound.port = 0;
    socket = open_sender(context_, options_, bound, error);
  }
  if (error) return error;
  if (dup2(socket.native_handle(), slots_[0].socket.native_handle()) < 0 || !watch(0)) {
    return {errno, std::generic_category()};
  }
  slots_[0].drops_seen = 0;
  take_local_endpoint();
  return {};
}

}  // namespace reckon::peer
