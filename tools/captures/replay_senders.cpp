// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/replay_senders.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {
namespace {

std::uint32_t address_of(const sockaddr& address) {
  sockaddr_in v4;
  std::memcpy(&v4, &address, sizeof v4);
  return ntohl(v4.sin_addr.s_addr);
}

std::uint32_t address_of(const peer::IpEndpoint& endpoint) {
  std::uint32_t address = 0;
  for (std::size_t i = 0; i < 4; ++i) address = address << 8 | endpoint.octets[i];
  return address;
}

}  // namespace

peer::IpEndpoint parse_destination(const std::string& text) {
  constexpr std::string_view kUdp = "udp://";
  std::string_view address = text;
  if (address.starts_with(kUdp)) address.remove_prefix(kUdp.size());
  const auto endpoint = peer::IpEndpoint::parse(address, peer::GroupPool::kDefaultPort);
  if (!endpoint.has_value() || endpoint->port == 0 || endpoint->is_unspecified())
    throw UsageError(fmt::format(
        "--to {}: neither a destination nor a time; write udp://239.192.1.0:3000, "
        "udp://127.0.0.1:3000 or udp://192.168.1.255:3000, or 2min for the end of the range",
        text));
  return *endpoint;
}

std::vector<LocalNetwork> local_networks() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0)
    throw EnvironmentError(
        fmt::format("the interfaces of this host cannot be listed: {}; name "
                    "the interface to send on with --iface",
                    std::strerror(errno)));
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, freeifaddrs);
  std::vector<LocalNetwork> networks;
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_netmask == nullptr) continue;
    if (entry->ifa_addr->sa_family != AF_INET) continue;
    networks.push_back(
        {entry->ifa_name, address_of(*entry->ifa_addr), address_of(*entry->ifa_netmask)});
  }
  return networks;
}

std::optional<std::string> broadcast_interface(const peer::IpEndpoint& to,
                                               std::span<const LocalNetwork> networks) {
  if (to.is_v6) return std::nullopt;
  const std::uint32_t wanted = address_of(to);
  if (wanted == 0xffffffffU) return std::string();
  for (const LocalNetwork& network : networks) {
    // A network of one or two hosts has no broadcast address.
    if (network.mask >= 0xfffffffeU) continue;
    if (wanted == (network.address | ~network.mask)) return network.interface;
  }
  return std::nullopt;
}

void ReplaySenders::prepare(const peer::IpEndpoint& to) {
  auto& link = links_[to.is_v6 ? 1 : 0];
  if (!link) link = open(to.is_v6);
}

bool ReplaySenders::send(const peer::IpEndpoint& to, std::span<const std::byte> bytes) {
  prepare(to);
  peer::UdpMulticast& link = *links_[to.is_v6 ? 1 : 0];
  const bool is_sent = link.send(to, bytes);
  if (is_sent && bytes.size() > link.max_payload()) ++fragmented_;
  return is_sent;
}

std::size_t ReplaySenders::mtu() const {
  std::size_t least = 0;
  for (const auto& link : links_)
    if (link && (least == 0 || link->mtu() < least)) least = link->mtu();
  return least;
}

std::uint64_t ReplaySenders::too_big() const {
  std::uint64_t count = 0;
  for (const auto& link : links_) count += link ? link->statistics().too_big : 0;
  return count;
}

std::unique_ptr<peer::UdpMulticast> ReplaySenders::open(bool ipv6) const {
  peer::UdpMulticastOptions options;
  options.interface = interface_;
  options.ipv6 = ipv6;
  options.broadcast = broadcast_ && !ipv6;
  options.fragments = true;
  options.max_groups = 1;
  try {
    return std::make_unique<peer::UdpMulticast>(options, clock_);
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
}

}  // namespace reckon::tools
