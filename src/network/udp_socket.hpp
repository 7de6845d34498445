// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Opens UDP sockets for multicast, with every option whose default would be wrong. Private to the
// peer library: no other header includes it.
#pragma once

#include <sys/socket.h>

#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>
#include <cstddef>
#include <system_error>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Options that all sockets of a link share.
struct UdpSocketOptions {
  unsigned interface_index{0};
  bool ipv6{false};
  int ttl{1};
  std::size_t receive_buffer{0};  ///< [octets] requested for SO_RCVBUF
  bool broadcast{false};          ///< the sending socket may reach broadcast addresses
  bool fragments{false};          ///< the sending socket may exceed the MTU
  bool coalesce{false};           ///< runs of datagrams may come as one (UDP_GRO)
};

/// Converts an endpoint for the kernel. `interface_index` gives link-local IPv6 its scope.
socklen_t to_sockaddr(const IpEndpoint& endpoint, unsigned interface_index,
                      sockaddr_storage& out) noexcept;
/// The inverse; unspecified for other families.
[[nodiscard]] IpEndpoint from_sockaddr(const sockaddr_storage& address) noexcept;

/// An error of Asio's own category as one that compares equal to std::errc.
[[nodiscard]] std::error_code generic(const std::error_code& error) noexcept;

/// The sending socket, bound to `local` (port 0 = a free one): outgoing interface, TTL, loopback
/// on, fragments only if asked. Errors in `error`, as returned by generic().
[[nodiscard]] asio::ip::udp::socket open_sender(asio::io_context& context,
                                                const UdpSocketOptions& options,
                                                const IpEndpoint& local, std::error_code& error);

/// Sets the outgoing interface of multicast again, on a socket in use. Any thread.
[[nodiscard]] std::error_code set_outgoing_interface(asio::ip::udp::socket& socket,
                                                     const UdpSocketOptions& options);

/// A receiving socket bound to `group`, joined on the interface, without datagrams of other groups.
[[nodiscard]] asio::ip::udp::socket open_group(asio::io_context& context,
                                               const UdpSocketOptions& options,
                                               const GroupAddress& group, std::error_code& error);

/// Opens a receiving socket of a listener, bound to `place`: a group, a broadcast address, or an
/// address of this host. It reports the interface of each datagram, and receives from all of them
/// unless the options name one; a group needs join_group() on each. The port is shared with other
/// programs, except for an address of this host: the kernel delivers a datagram to such an address
/// to only one program, and a listener must not take it from another.
[[nodiscard]] asio::ip::udp::socket open_listener(asio::io_context& context,
                                                  const UdpSocketOptions& options,
                                                  const IpEndpoint& place, std::error_code& error);

/// Joins the group on the interface of the options.
[[nodiscard]] std::error_code join_group(asio::ip::udp::socket& socket,
                                         const UdpSocketOptions& options,
                                         const GroupAddress& group) noexcept;

/// Ends the membership: nothing more arrives, and pending datagrams can still be read.
void leave_group(asio::ip::udp::socket& socket, const UdpSocketOptions& options,
                 const GroupAddress& group) noexcept;

/// IP_MTU towards `group` [octets], 0 if the kernel does not know it.
[[nodiscard]] std::size_t path_mtu(asio::io_context& context, const UdpSocketOptions& options,
                                   const GroupAddress& group);

/// Whether the kernel hands over runs as one there.
[[nodiscard]] bool coalesces(asio::ip::udp::socket& socket) noexcept;
/// 0 if the kernel can cut a run (UDP_SEGMENT), else its errno.
[[nodiscard]] int segment_error(asio::ip::udp::socket& socket) noexcept;

/// SO_RCVBUF [octets], in the unit of the request; less if it was capped.
[[nodiscard]] std::size_t receive_buffer_of(asio::ip::udp::socket& socket);

}  // namespace reckon::peer
