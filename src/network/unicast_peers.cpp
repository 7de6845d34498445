// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/unicast_peers.hpp"

#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include "reckon/peer/network/udp_socket.hpp"

namespace reckon::peer {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

[[noreturn]] void refuse_peer(std::string_view item, std::string_view why) {
  throw std::invalid_argument("'" + std::string(item) + "' " + std::string(why) +
                              "; write addresses or names, commas between, each with a port where "
                              "it is another: \"10.0.0.7, host-b:3001, [2001:db8::7]:3001\"");
}

std::uint16_t port_of(std::string_view item, std::string_view text) {
  unsigned port = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), port);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || port < 1 || port > 65535)
    refuse_peer(item, "has a port that is not from 1 to 65535");
  return static_cast<std::uint16_t>(port);
}

NamedPeer parse_peer(std::string_view item) {
  if (item.empty()) refuse_peer(item, "names nobody");
  if (item.front() == '[') {
    const auto end = item.find(']');
    const bool has_port = end != std::string_view::npos && item.substr(end + 1).starts_with(':');
    if (end == std::string_view::npos || (!has_port && end + 1 != item.size()))
      refuse_peer(item, "is no address in brackets");
    return {std::string(item.substr(1, end - 1)),
            has_port ? port_of(item, item.substr(end + 2)) : std::uint16_t{0}};
  }
  const auto colon = item.find(':');
  const bool many = colon != item.rfind(':');  // IPv6 without brackets
  if (colon == std::string_view::npos || many) return {std::string(item), 0};
  if (colon == 0) refuse_peer(item, "names nobody");
  return {std::string(item.substr(0, colon)), port_of(item, item.substr(colon + 1))};
}

}  // namespace

std::vector<NamedPeer> parse_peers(std::string_view list) {
  std::vector<NamedPeer> peers;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    peers.push_back(parse_peer(trimmed(list.substr(at, end - at))));
    at = end + 1;
  }
  if (peers.size() > kMostUnicastPeers)
    refuse_peer(peers.back().host, "is one of more than 256: a relay or multicast serves so many");
  return peers;
}

std::vector<IpEndpoint> resolve_peers(const std::vector<NamedPeer>& peers, std::uint16_t port,
                                      bool ipv6) {
  std::vector<IpEndpoint> found;
  addrinfo wanted{};
  wanted.ai_family = ipv6 ? AF_INET6 : AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  for (const NamedPeer& peer : peers) {
    addrinfo* answer = nullptr;
    const int error = getaddrinfo(peer.host.c_str(), nullptr, &wanted, &answer);
    if (error != 0 || answer == nullptr) {
      throw std::runtime_error("peers: '" + peer.host + "' has no " + (ipv6 ? "IPv6" : "IPv4") +
                               " address (" + gai_strerror(error) +
                               "); the family is that of 'group'. Try getent ahosts " + peer.host);
    }
    sockaddr_storage address{};
    std::memcpy(&address, answer->ai_addr, answer->ai_addrlen);
    freeaddrinfo(answer);
    IpEndpoint endpoint = from_sockaddr(address);
    endpoint.port = peer.port != 0 ? peer.port : port;
    if (endpoint.is_multicast() || endpoint.is_broadcast() || endpoint.is_unspecified()) {
      throw std::runtime_error("peers: '" + peer.host +
                               "' is the address of no single host; 'group' takes groups");
    }
    if (std::find(found.begin(), found.end(), endpoint) == found.end()) found.push_back(endpoint);
  }
  return found;
}

}  // namespace reckon::peer
