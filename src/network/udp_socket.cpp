// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_socket.hpp"

#include <linux/in6.h>
#include <netinet/in.h>
#include <netinet/udp.h>

#include <asio/ip/address.hpp>
#include <asio/ip/multicast.hpp>
#include <asio/ip/v6_only.hpp>
#include <asio/socket_base.hpp>
#include <cerrno>
#include <cstring>

namespace reckon::peer {
namespace {

using asio::ip::udp;

// Asio has no name for these options.
void set_option(udp::socket& socket, int level, int name, const auto& value,
                std::error_code& error) {
  if (error) return;
  if (setsockopt(socket.native_handle(), level, name, &value, sizeof value) != 0) {
    error.assign(errno, asio::error::get_system_category());
  }
}

udp protocol(bool ipv6) { return ipv6 ? udp::v6() : udp::v4(); }

udp::endpoint to_asio(const IpEndpoint& endpoint, unsigned interface_index) {
  sockaddr_storage address{};
  const socklen_t size = to_sockaddr(endpoint, interface_index, address);
  udp::endpoint out;
  std::memcpy(out.data(), &address, size);
  out.resize(size);
  return out;
}

// RCVBUFFORCE exceeds rmem_max if permitted; else RCVBUF silently takes at most rmem_max.
void set_receive_buffer(udp::socket& socket, std::size_t octets, std::error_code& error) {
  if (error) return;
  const int asked = static_cast<int>(octets);
  std::error_code refused;
  set_option(socket, SOL_SOCKET, SO_RCVBUFFORCE, asked, refused);
  if (refused) set_option(socket, SOL_SOCKET, SO_RCVBUF, asked, error);
}

// Options of both kinds of sockets: buffer size, arrival times, a count of drops, no foreign
// groups.
void set_receive_options(udp::socket& socket, const UdpSocketOptions& options,
                         std::error_code& error) {
  set_receive_buffer(socket, options.receive_buffer, error);
  set_option(socket, SOL_SOCKET, SO_TIMESTAMPNS, 1, error);
  set_option(socket, SOL_SOCKET, SO_RXQ_OVFL, 1, error);
  std::error_code single;  // older kernels hand over datagrams one by one
  if (options.coalesce) set_option(socket, SOL_UDP, UDP_GRO, 1, single);
  if (options.ipv6) {
    if (!error) socket.set_option(asio::ip::v6_only(true), error);
    set_option(socket, IPPROTO_IPV6, IPV6_MULTICAST_ALL, 0, error);
  } else {
    set_option(socket, IPPROTO_IP, IP_MULTICAST_ALL, 0, error);
  }
}

void set_outgoing_interface(udp::socket& socket, const UdpSocketOptions& options,
                            std::error_code& error) {
  if (options.ipv6) {
    if (!error) {
      socket.set_option(asio::ip::multicast::outbound_interface(options.interface_index), error);
    }
    return;
  }
  // Asio would name the IPv4 interface by address; the index is exact.
  ip_mreqn request{};
  request.imr_ifindex = static_cast<int>(options.interface_index);
  set_option(socket, IPPROTO_IP, IP_MULTICAST_IF, request, error);
}

// Whether the kernel fragments datagrams above the MTU or refuses them.
void set_fragments(udp::socket& socket, const UdpSocketOptions& options, std::error_code& error) {
  if (options.ipv6) {
    const int rule = options.fragments ? IPV6_PMTUDISC_DONT : IPV6_PMTUDISC_DO;
    set_option(socket, IPPROTO_IPV6, IPV6_MTU_DISCOVER, rule, error);
  } else {
    const int rule = options.fragments ? IP_PMTUDISC_DONT : IP_PMTUDISC_DO;
    set_option(socket, IPPROTO_IP, IP_MTU_DISCOVER, rule, error);
  }
}

// @param name_v4, name_v6: the options for joining a group, or for leaving it.
void change_membership(udp::socket& socket, const UdpSocketOptions& options,
                       const GroupAddress& group, int name_v4, int name_v6,
                       std::error_code& error) {
  if (options.ipv6) {
    ipv6_mreq request{};
    std::memcpy(&request.ipv6mr_multiaddr, group.octets.data(), sizeof request.ipv6mr_multiaddr);
    request.ipv6mr_interface = options.interface_index;
    return set_option(socket, IPPROTO_IPV6, name_v6, request, error);
  }
  ip_mreqn request{};
  std::memcpy(&request.imr_multiaddr, group.octets.data(), sizeof request.imr_multiaddr);
  request.imr_ifindex = static_cast<int>(options.interface_index);
  set_option(socket, IPPROTO_IP, name_v4, request, error);
}

}  // namespace

socklen_t to_sockaddr(const IpEndpoint& endpoint, unsigned interface_index,
                      sockaddr_storage& out) noexcept {
  if (!endpoint.is_v6) {
    sockaddr_in v4{};
    v4.sin_family = AF_INET;
    v4.sin_port = htons(endpoint.port);
    std::memcpy(&v4.sin_addr, endpoint.octets.data(), sizeof v4.sin_addr);
    std::memcpy(&out, &v4, sizeof v4);
    return sizeof v4;
  }
  sockaddr_in6 v6{};
  v6.sin6_family = AF_INET6;
  v6.sin6_port = htons(endpoint.port);
  std::memcpy(&v6.sin6_addr, endpoint.octets.data(), sizeof v6.sin6_addr);
  const bool link_local_unicast = endpoint.octets[0] == 0xfe && (endpoint.octets[1] & 0xc0) == 0x80;
  const bool link_local_group = endpoint.octets[0] == 0xff && (endpoint.octets[1] & 0x0f) <= 2;
  if (link_local_unicast || link_local_group) v6.sin6_scope_id = interface_index;
  std::memcpy(&out, &v6, sizeof v6);
  return sizeof v6;
}

IpEndpoint from_sockaddr(const sockaddr_storage& address) noexcept {
  IpEndpoint out;
  if (address.ss_family == AF_INET) {
    sockaddr_in v4;
    std::memcpy(&v4, &address, sizeof v4);
    out.port = ntohs(v4.sin_port);
    std::memcpy(out.octets.data(), &v4.sin_addr, sizeof v4.sin_addr);
  } else if (address.ss_family == AF_INET6) {
    sockaddr_in6 v6;
    std::memcpy(&v6, &address, sizeof v6);
    out.is_v6 = true;
    out.port = ntohs(v6.sin6_port);
    std::memcpy(out.octets.data(), &v6.sin6_addr, sizeof v6.sin6_addr);
  }
  return out;
}

std::error_code generic(const std::error_code& error) noexcept {
  return error ? std::error_code(error.value(), std::generic_category()) : std::error_code{};
}

udp::socket open_sender(asio::io_context& context, const UdpSocketOptions& options,
                        const IpEndpoint& local, std::error_code& error) {
  udp::socket socket(context);
  socket.open(protocol(options.ipv6), error);
  set_receive_options(socket, options, error);
  set_outgoing_interface(socket, options, error);
  set_fragments(socket, options, error);
  if (!error) socket.set_option(asio::ip::multicast::hops(options.ttl), error);
  if (!error) socket.set_option(asio::ip::multicast::enable_loopback(true), error);
  if (options.broadcast) set_option(socket, SOL_SOCKET, SO_BROADCAST, 1, error);
  if (!error) socket.bind(to_asio(local, options.interface_index), error);
  error = generic(error);
  return socket;
}

std::error_code set_outgoing_interface(udp::socket& socket, const UdpSocketOptions& options) {
  std::error_code error;
  set_outgoing_interface(socket, options, error);
  return generic(error);
}

udp::socket open_group(asio::io_context& context, const UdpSocketOptions& options,
                       const GroupAddress& group, std::error_code& error) {
  udp::socket socket(context);
  const bool everybody = options.broadcast && !group.is_v6 && !group.is_multicast();
  if (!(group.is_multicast() || everybody) || group.is_v6 != options.ipv6) {
    error = std::make_error_code(std::errc::invalid_argument);
    return socket;
  }
  socket.open(protocol(options.ipv6), error);
  set_receive_options(socket, options, error);
  if (!error) socket.set_option(asio::socket_base::reuse_address(true), error);
  if (options.ipv6 || everybody) {
    // IPv6 matches memberships only by address, and a broadcast needs none; the binding excludes
    // other interfaces.
    const int index = static_cast<int>(options.interface_index);
    set_option(socket, SOL_SOCKET, SO_BINDTOIFINDEX, index, error);
  }
  if (!error) socket.bind(to_asio(group, options.interface_index), error);
  if (!everybody)
    change_membership(socket, options, group, IP_ADD_MEMBERSHIP, IPV6_JOIN_GROUP, error);
  error = generic(error);
  return socket;
}

udp::socket open_listener(asio::io_context& context, const UdpSocketOptions& options,
                          const IpEndpoint& place, std::error_code& error) {
  udp::socket socket(context);
  const bool shares = place.is_multicast() || options.broadcast;
  socket.open(protocol(options.ipv6), error);
  set_receive_options(socket, options, error);
  if (options.ipv6)
    set_option(socket, IPPROTO_IPV6, IPV6_RECVPKTINFO, 1, error);
  else
    set_option(socket, IPPROTO_IP, IP_PKTINFO, 1, error);
  if (!error && shares) socket.set_option(asio::socket_base::reuse_address(true), error);
  // For IPv4 groups, memberships already exclude other interfaces; other sockets have no
  // memberships.
  if (options.interface_index != 0 && (options.ipv6 || !place.is_multicast())) {
    const int index = static_cast<int>(options.interface_index);
    set_option(socket, SOL_SOCKET, SO_BINDTOIFINDEX, index, error);
  }
  if (!error) socket.bind(to_asio(place, options.interface_index), error);
  // Later programs may bind the same address, and then get its datagrams.
  if (!error && !shares) socket.set_option(asio::socket_base::reuse_address(true), error);
  error = generic(error);
  return socket;
}

std::error_code join_group(udp::socket& socket, const UdpSocketOptions& options,
                           const GroupAddress& group) noexcept {
  std::error_code error;
  change_membership(socket, options, group, IP_ADD_MEMBERSHIP, IPV6_JOIN_GROUP, error);
  return generic(error);
}

void leave_group(udp::socket& socket, const UdpSocketOptions& options,
                 const GroupAddress& group) noexcept {
  std::error_code ignored;  // a broadcast address has no membership
  change_membership(socket, options, group, IP_DROP_MEMBERSHIP, IPV6_LEAVE_GROUP, ignored);
}

std::size_t path_mtu(asio::io_context& context, const UdpSocketOptions& options,
                     const GroupAddress& group) {
  std::error_code error;
  udp::socket socket(context);
  socket.open(protocol(options.ipv6), error);
  set_outgoing_interface(socket, options, error);
  if (!error) socket.connect(to_asio(group, options.interface_index), error);
  int mtu = 0;
  socklen_t size = sizeof mtu;
  const int level = options.ipv6 ? IPPROTO_IPV6 : IPPROTO_IP;
  const int name = options.ipv6 ? IPV6_MTU : IP_MTU;
  if (error || getsockopt(socket.native_handle(), level, name, &mtu, &size) != 0) return 0;
  return static_cast<std::size_t>(mtu);
}

bool coalesces(udp::socket& socket) noexcept {
  int on = 0;
  socklen_t size = sizeof on;
  return getsockopt(socket.native_handle(), SOL_UDP, UDP_GRO, &on, &size) == 0 && on != 0;
}

int segment_error(udp::socket& socket) noexcept {
  int length = 0;
  socklen_t size = sizeof length;
  return getsockopt(socket.native_handle(), SOL_UDP, UDP_SEGMENT, &length, &size) == 0 ? 0 : errno;
}

std::size_t receive_buffer_of(udp::socket& socket) {
  asio::socket_base::receive_buffer_size size;
  std::error_code error;
  socket.get_option(size, error);
  return error ? 0 : static_cast<std::size_t>(size.value());
}

}  // namespace reckon::peer
