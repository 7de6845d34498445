// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Resolves the names of a list to addresses.
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "reckon/peer/network/udp_socket.hpp"
#include "reckon/peer/network/unicast_peers.hpp"

namespace reckon::peer {

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
                               "' is not the address of a single host; groups go into 'group'");
    }
    if (std::find(found.begin(), found.end(), endpoint) == found.end()) found.push_back(endpoint);
  }
  return found;
}

}  // namespace reckon::peer
