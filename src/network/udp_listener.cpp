// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_listener.hpp"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "reckon/peer/network/host_limits.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

UdpMulticastOptions receiving(const UdpListenerOptions& asked) {
  if (asked.places.empty()) throw std::invalid_argument("no group was given");
  UdpMulticastOptions out;
  out.ipv6 = asked.places.front().is_v6;
  out.receive_buffer = std::size_t{4} << 20;  // a listener's screen may block it for long
  out.max_datagram = 65535;
  return out;
}

// IPv6 groups of one link need the interface in their address.
bool is_of_one_link(const IpEndpoint& place) {
  return place.is_v6 && place.is_multicast() && (place.octets[1] & 0x0f) <= 2;
}

IpEndpoint at_port(IpEndpoint address, std::uint16_t port) {
  address.port = port;
  return address;
}

bool has_broadcast(const NetworkInterface& interface, const IpEndpoint& place) {
  const auto& all = interface.broadcasts;
  return std::find(all.begin(), all.end(), at_port(place, 0)) != all.end();
}

bool is_same(const NetworkInterface& a, const NetworkInterface& b) {
  return a.index == b.index && a.name == b.name && a.addresses == b.addresses;
}

// The interfaces of `some` that are not in `others`.
std::vector<NetworkInterface> without(std::span<const NetworkInterface> some,
                                      std::span<const NetworkInterface> others) {
  std::vector<NetworkInterface> out;
  for (const NetworkInterface& one : some) {
    const auto same = [&](const NetworkInterface& other) { return is_same(one, other); };
    if (std::none_of(others.begin(), others.end(), same)) out.push_back(one);
  }
  return out;
}

// A sentence about an address for which no socket could be opened.
std::string refusal(const std::error_code& error, const IpEndpoint& place, bool is_broadcast) {
  if (place.is_multicast()) return advice(error, place);
  std::string text = "cannot listen to " + place.text() + ": ";
  if (error == std::errc::address_not_available)
    return text +
           "it is not a group, an address or a broadcast address of this host; see ip addr, or use "
           "0.0.0.0 for all addresses";
  if (error == std::errc::address_in_use && !is_broadcast)
    return text +
           "another program of this host uses it, and only one program receives its datagrams: "
           "stop that program, or use iface:NAME (needs CAP_NET_RAW)";
  text += error.message();
  const std::string_view remedy = join_remedy(error);
  return remedy.empty() ? text : text.append("; ").append(remedy);
}

}  // namespace

UdpListener::UdpListener(const UdpListenerOptions& options, const Clock& clock)
    : asked_(options),
      clock_(clock),
      options_(receiving(options)),
      ready_(clock),
      receiver_(options_, clock, ready_, nobody_, no_tap_, echo_, counts_) {
  raise_open_file_limit();
  if (std::any_of(asked_.places.begin(), asked_.places.end(), is_of_one_link) ||
      !asked_.interface.empty()) {
    const NetworkInterface named = choose_interface(asked_.interface, options_.ipv6).interface;
    if (asked_.interface.empty()) asked_.interface = named.name;
    interface_ = named.name;
  }
  receiver_.reserve(options_.offload);
  listen();
  asked_.skips_failures = true;  // all later failures are warnings
}

std::vector<NetworkInterface> UdpListener::choose() const {
  std::vector<NetworkInterface> all = list_interfaces();
  if (interface_.empty()) {
    std::erase_if(all,
                  [&](const NetworkInterface& one) { return !rate(one, options_.ipv6).usable; });
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a.index < b.index; });
    return all;
  }
  if (used_.empty() && !asked_.skips_failures)  // at the start, a missing cable is no error
    return {choose_interface(all, asked_.interface, options_.ipv6).interface};
  NetworkInterface used;
  used.name = interface_;
  const InterfaceStanding found = find_again(all, asked_.interface, used, options_.ipv6);
  if (!found.interface) return {};
  return {*found.interface};
}

std::vector<UdpListener::Ear> UdpListener::ears_of(
    const IpEndpoint& place, std::span<const NetworkInterface> interfaces) const {
  const unsigned only = interface_.empty() || interfaces.empty() ? 0 : interfaces.front().index;
  const IpEndpoint everybody = IpEndpoint::v4(0xffffffffu, place.port);
  std::vector<Ear> out;
  if (place.is_multicast()) return {{place, only}};
  const bool all = place.is_unspecified();
  if (place.is_broadcast() || (all && !place.is_v6)) out.push_back({everybody, only, true});
  for (const NetworkInterface& interface : interfaces) {
    if (place.is_broadcast() || (all && !place.is_v6)) {
      for (const IpEndpoint& address : interface.broadcasts)
        out.push_back({at_port(address, place.port), only, true});
    } else if (has_broadcast(interface, place)) {
      return {{place, only, true}, {everybody, interface.index, true}};
    }
    for (const IpEndpoint& address : interface.addresses) {
      if (address.is_v6 != place.is_v6 || !(all || address == at_port(place, 0))) continue;
      const bool needs_scope = address.is_v6 && is_link_local(address);
      out.push_back({at_port(address, place.port), needs_scope ? interface.index : only});
    }
  }
  if (out.empty() && !all) out.push_back({place, only});  // the kernel decides
  return out;
}

UdpSocketOptions UdpListener::socket_options(const Ear& ear) const {
  UdpSocketOptions out;
  out.interface_index = ear.interface;
  out.ipv6 = options_.ipv6;
  out.receive_buffer = options_.receive_buffer;
  out.broadcast = ear.is_broadcast;
  out.coalesce = options_.offload;
  return out;
}

void UdpListener::warn(std::string sentence) {
  if (std::find(warnings_.begin(), warnings_.end(), sentence) == warnings_.end())
    warnings_.push_back(std::move(sentence));
}

// Fails if the group could not be joined on any of them.
std::error_code UdpListener::join(UdpSlot& slot, std::span<const NetworkInterface> added) {
  std::error_code last;
  bool any = added.empty();
  for (const NetworkInterface& interface : added) {
    UdpSocketOptions options = socket_options({slot.group, interface.index});
    const std::error_code error = join_group(slot.socket, options, slot.group);
    if (!error) {
      any = true;
      continue;
    }
    last = error;
    const std::string_view remedy = join_remedy(error);
    warn("not all groups are received on " + interface.name + ": " + error.message() +
         (remedy.empty() ? "" : "; ") + std::string(remedy));
  }
  return any ? std::error_code() : last;
}

void UdpListener::leave(std::span<const NetworkInterface> gone) {
  for (UdpSlot& slot : slots_) {
    if (!slot.socket.is_open() || !slot.group.is_multicast()) continue;
    for (const NetworkInterface& interface : gone)
      leave_group(slot.socket, socket_options({slot.group, interface.index}), slot.group);
  }
}

std::error_code UdpListener::open(const Ear& ear) {
  std::error_code error;
  asio::ip::udp::socket socket = open_listener(context_, socket_options(ear), ear.address, error);
  if (error) return error;
  const auto is_free = [](const UdpSlot& slot) { return !slot.socket.is_open(); };
  auto slot = std::find_if(slots_.begin(), slots_.end(), is_free);
  if (slot == slots_.end()) {
    slots_.push_back({std::move(socket), ear.address, 0, clock_.now()});
    ears_.push_back(ear);
    slot = slots_.end() - 1;
  } else {
    *slot = UdpSlot{std::move(socket), ear.address, 0, clock_.now()};
  }
  const auto number = static_cast<std::size_t>(slot - slots_.begin());
  ears_[number] = ear;
  if (ear.address.is_multicast()) error = join(*slot, used_);
  if (!error &&
      !ready_.add(slot->socket.native_handle(), static_cast<std::uint32_t>(number), false))
    error.assign(errno, std::generic_category());
  if (!error) return {};
  slot->socket.close();
  return error;
}

// Opens and closes sockets and memberships to match the present interfaces.
void UdpListener::listen() {
  const std::vector<NetworkInterface> before = std::exchange(used_, choose());
  if (used_.empty() && !asked_.skips_failures)  // throws with the available ones
    static_cast<void>(choose_interface(asked_.interface, options_.ipv6));
  std::vector<IpEndpoint> own;
  for (const NetworkInterface& interface : used_)
    own.insert(own.end(), interface.addresses.begin(), interface.addresses.end());
  filter_.set_own_addresses(std::move(own));
  leave(without(before, used_));
  const std::vector<NetworkInterface> added = without(used_, before);

  std::vector<Ear> wanted;
  for (const IpEndpoint& place : asked_.places) {
    const std::vector<Ear> ears = ears_of(place, used_);
    wanted.insert(wanted.end(), ears.begin(), ears.end());
  }
  close_all_but(wanted);
  for (const IpEndpoint& place : asked_.places) listen_to(place, added);
}

void UdpListener::close_all_but(std::span<const Ear> wanted) {
  ready_.clear();
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (std::find(wanted.begin(), wanted.end(), ears_[i]) == wanted.end()) slots_[i].socket.close();
  }
}

void UdpListener::listen_to(const IpEndpoint& place, std::span<const NetworkInterface> added) {
  std::string problem;
  bool any = false;
  for (const Ear& ear : ears_of(place, used_)) {
    UdpSlot* slot = find(ear);
    if (slot != nullptr && ear.address.is_multicast()) static_cast<void>(join(*slot, added));
    const std::error_code error = slot != nullptr ? std::error_code() : open(ear);
    any = any || !error;
    if (!error) continue;
    problem = refusal(error, ear.address, ear.is_broadcast);
    if (asked_.skips_failures || place != ear.address) warn(problem);
  }
  if (!any && !problem.empty() && !asked_.skips_failures) throw std::runtime_error(problem);
}

UdpSlot* UdpListener::find(const Ear& ear) noexcept {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (slots_[i].socket.is_open() && ears_[i] == ear) return &slots_[i];
  }
  return nullptr;
}

void UdpListener::wait(nanoseconds timeout) {
  if (ready_.host_changed()) {
    ready_.clear_host_change();
    try {
      listen();
    } catch (const std::exception& failure) {
      warn(std::string("the interfaces of this host cannot be listed: ") + failure.what());
    }
  }
  if (receiver_.has_arrived()) return;
  if (!ready_.has_next()) ready_.poll(timeout);
  static_cast<void>(ready_.take_wake());
}

std::size_t UdpListener::receive(std::span<Datagram> out) {
  std::size_t count = receiver_.hand_over(out, 0);
  // The buffers of returned datagrams stay valid until the next call.
  if (count == 0) receiver_.recycle();
  if (count == 0 && !ready_.has_next()) ready_.poll(nanoseconds{0});
  while (count < out.size() && !receiver_.is_full() && ready_.has_next())
    count = receiver_.take_turn(slots_[ready_.next()], out, count, options_.batch);
  if (used_.size() < 2) return count;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (filter_.is_copy(out[i], receiver_.interface_of(out[i])))
      ++copies_;
    else
      out[kept++] = out[i];
  }
  return kept;
}

}  // namespace reckon::peer
