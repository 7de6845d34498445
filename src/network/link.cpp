// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/link.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <stdexcept>

#include "reckon/peer/network/interface_choice.hpp"

namespace reckon::peer {
namespace {

// Offset of the last four octets of the address, in which the groups of a pool differ.
std::size_t tail_offset(const IpEndpoint& endpoint) { return endpoint.is_v6 ? 12 : 0; }

std::uint32_t tail(const IpEndpoint& endpoint) {
  const std::size_t o = tail_offset(endpoint);
  return (std::uint32_t{endpoint.octets[o]} << 24) | (std::uint32_t{endpoint.octets[o + 1]} << 16) |
         (std::uint32_t{endpoint.octets[o + 2]} << 8) | endpoint.octets[o + 3];
}

IpEndpoint with_tail(IpEndpoint endpoint, std::uint32_t value) {
  const std::size_t o = tail_offset(endpoint);
  for (std::size_t i = 0; i < 4; ++i) {
    endpoint.octets[o + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
  }
  return endpoint;
}

bool parse_address(std::string_view text, IpEndpoint& out) {
  const std::string copy(text);
  out.octets = {};
  out.is_v6 = copy.find(':') != std::string::npos;
  return inet_pton(out.is_v6 ? AF_INET6 : AF_INET, copy.c_str(), out.octets.data()) == 1;
}

bool parse_port(std::string_view text, std::uint16_t& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
}

// Splits "address:port" and "[address]:port"; a bare IPv6 address has colons but no brackets.
void split(std::string_view text, std::string_view& address, std::string_view& port) {
  address = text;
  port = {};
  if (text.starts_with('[')) {
    const std::size_t close = text.find(']');
    if (close == std::string_view::npos) return;
    address = text.substr(1, close - 1);
    port = text.substr(close + 1);
  } else if (std::count(text.begin(), text.end(), ':') == 1) {
    address = text.substr(0, text.find(':'));
    port = text.substr(text.find(':'));
  }
}

/// Remedy for an error of the kernel.
struct Remedy {
  std::errc error;
  std::string_view what_to_do;
};
constexpr std::array kJoinRemedies{
    Remedy{std::errc::no_buffer_space,
           "the kernel allows no further membership: sysctl -w net.ipv4.igmp_max_memberships=512"},
    Remedy{std::errc::too_many_files_open,
           "each group is one socket: raise the limit with ulimit -n 4096"},
    Remedy{std::errc::too_many_files_open_in_system,
           "each group is one socket: raise the limit with sysctl -w fs.file-max=100000"},
    Remedy{std::errc::not_enough_memory,
           "too little socket memory: sysctl -w net.core.optmem_max=131072, or join fewer groups"},
    Remedy{std::errc::no_such_device,
           "the interface has no multicast: choose another with --iface"},
    Remedy{std::errc::network_unreachable,
           "the interface has no multicast: choose another with --iface"},
    Remedy{std::errc::address_in_use,
           "another program uses the port exclusively: stop it or choose another port"},
    Remedy{std::errc::address_not_available,
           "it is not a broadcast address of the interface: see ip addr, or use 255.255.255.255"},
    Remedy{std::errc::value_too_large,
           "the link has no room for another group: raise its max_groups"},
    Remedy{std::errc::invalid_argument, "it is not a multicast group of the link's address family"},
};
constexpr std::array kSendRemedies{
    Remedy{std::errc::operation_not_permitted, "a firewall refuses it: nft list ruleset"},
    Remedy{std::errc::permission_denied,
           "a firewall or a missing privilege refuses it: nft list ruleset"},
    Remedy{std::errc::network_unreachable, "is the interface up? see reckon doctor"},
    Remedy{std::errc::network_down, "is the interface up? see reckon doctor"},
    Remedy{std::errc::no_such_device, "is the interface still there? see reckon doctor"},
    Remedy{std::errc::invalid_argument,
           "does the interface still have its address? see reckon doctor"},
    Remedy{std::errc::no_buffer_space, "the interface is slower than the traffic"},
    Remedy{std::errc::resource_unavailable_try_again, "the interface is slower than the traffic"},
    Remedy{std::errc::message_size, "longer than the MTU: set a smaller payload in the scene"},
};

}  // namespace

bool IpEndpoint::is_multicast() const noexcept {
  return is_v6 ? octets[0] == 0xff : (octets[0] & 0xf0) == 0xe0;
}

bool IpEndpoint::is_broadcast() const noexcept {
  return !is_v6 && std::all_of(octets.begin(), octets.begin() + 4, [](auto o) { return o == 255; });
}

bool IpEndpoint::is_loopback() const noexcept {
  if (!is_v6) return octets[0] == 127;
  return octets[15] == 1 &&
         std::all_of(octets.begin(), octets.end() - 1, [](auto o) { return o == 0; });
}

bool IpEndpoint::is_unspecified() const noexcept {
  return std::all_of(octets.begin(), octets.end(), [](auto o) { return o == 0; });
}

std::optional<IpEndpoint> IpEndpoint::parse(std::string_view text, std::uint16_t default_port) {
  std::string_view address, port;
  split(text, address, port);
  IpEndpoint out;
  out.port = default_port;
  if (!parse_address(address, out)) return std::nullopt;
  if (port.empty()) return out;
  if (port.front() != ':' || !parse_port(port.substr(1), out.port)) return std::nullopt;
  return out;
}

IpEndpoint IpEndpoint::v4(std::uint32_t address, std::uint16_t port) noexcept {
  IpEndpoint out;
  out.port = port;
  return with_tail(out, address);
}

std::string IpEndpoint::address_text() const {
  std::array<char, INET6_ADDRSTRLEN> text{};
  inet_ntop(is_v6 ? AF_INET6 : AF_INET, octets.data(), text.data(), text.size());
  return text.data();
}

std::string IpEndpoint::text() const {
  const std::string address = address_text();
  const std::string host = is_v6 ? std::string("[").append(address).append("]") : address;
  return host + ":" + std::to_string(port);
}

GroupPool GroupPool::ipv4_default() noexcept {
  return {IpEndpoint::v4(0xefc00100, kDefaultPort), kDefaultSize};
}

GroupPool GroupPool::ipv6_default() noexcept {
  IpEndpoint base;
  base.is_v6 = true;
  base.port = kDefaultPort;
  base.octets[0] = 0xff;
  base.octets[1] = 0x15;
  return {with_tail(base, 0x00c00100), kDefaultSize};
}

GroupPool::GroupPool(const GroupAddress& base, std::size_t size) : base_(base), size_(size) {
  if (may_be_broadcast(base) && base.port != 0) return;
  if (!base.is_multicast() || base.port == 0) {
    throw std::invalid_argument("base group " + base.text() +
                                " is not a multicast group with a port; use one of 239.0.0.0/8 or "
                                "ff15::/16, such as 239.192.1.0:3000");
  }
  const std::uint32_t last_of_range = base.is_v6 ? 0xffffffffu : 0xefffffffu;
  if (size == 0 || size > 65535 || last_of_range - tail(base) < size) {
    throw std::invalid_argument("a pool of " + std::to_string(size) + " groups after " +
                                base.text() +
                                " is not possible; take 1 to 65535 groups that end "
                                "inside the multicast range");
  }
}

GroupAddress GroupPool::address(std::size_t index) const noexcept {
  assert(index < size_);
  return with_tail(base_, tail(base_) + 1 + static_cast<std::uint32_t>(index));
}

std::optional<std::size_t> GroupPool::index(const GroupAddress& group) const noexcept {
  if (group.is_v6 != base_.is_v6 || !base_.is_multicast()) return std::nullopt;
  const std::uint32_t offset = tail(group) - tail(base_);
  if (offset == 0 || offset > size_) return std::nullopt;
  if (with_tail(base_, tail(group)) != group) return std::nullopt;
  return offset - 1;
}

SentBatch Link::send_batch(std::span<const OutgoingDatagram> batch) noexcept {
  SentBatch out;
  for (const OutgoingDatagram& datagram : batch) {
    if (!send(datagram.to, datagram.bytes)) continue;
    ++out.datagrams;
    out.octets += datagram.bytes.size();
  }
  return out;
}

std::string_view join_remedy(const std::error_code& error) noexcept {
  for (const Remedy& row : kJoinRemedies) {
    if (error == row.error) return row.what_to_do;
  }
  return {};
}

std::string_view send_remedy(const std::error_code& error) noexcept {
  for (const Remedy& row : kSendRemedies) {
    if (error == row.error) return row.what_to_do;
  }
  return {};
}

std::string advice(const std::error_code& error, const GroupAddress& group) {
  std::string text = "cannot join " + group.text() + ": " + error.message();
  const std::string_view remedy = join_remedy(error);
  return remedy.empty() ? text : text.append("; ").append(remedy);
}

}  // namespace reckon::peer

std::size_t std::hash<reckon::peer::IpEndpoint>::operator()(
    const reckon::peer::IpEndpoint& endpoint) const noexcept {
  std::uint64_t sum = 0xcbf29ce484222325u;  // FNV-1a over all fields
  const auto mix = [&sum](std::uint8_t octet) { sum = (sum ^ octet) * 0x100000001b3u; };
  for (const std::uint8_t octet : endpoint.octets) mix(octet);
  mix(endpoint.is_v6 ? 1 : 0);
  mix(static_cast<std::uint8_t>(endpoint.port >> 8));
  mix(static_cast<std::uint8_t>(endpoint.port & 0xff));
  return static_cast<std::size_t>(sum);
}
