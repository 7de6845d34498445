// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The open sockets of a UdpMulticast: the unicast socket, and one for each joined group. Private to
// the network.
#pragma once

#include <asio/io_context.hpp>
#include <cstddef>
#include <span>
#include <system_error>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/echo_watch.hpp"
#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/network/link_counters.hpp"
#include "reckon/peer/network/link_tap.hpp"
#include "reckon/peer/network/local_endpoint.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/network/udp_readiness.hpp"
#include "reckon/peer/network/udp_receiver.hpp"
#include "reckon/peer/network/udp_slot.hpp"
#include "reckon/peer/network/udp_socket.hpp"

namespace reckon::peer {

/// Slots by number, the same as in UdpReadiness. Slot 0 sends and receives unicast, the others are
/// of groups, open or free. For the reading thread; joining and leaving may allocate.
class UdpSocketTable {
 public:
  /// Parts of the link, which outlives this.
  struct Surroundings {
    const UdpMulticastOptions& options;
    const Clock& clock;
    UdpReadiness& ready;
    UdpReceiver& receiver;  ///< reads pending datagrams of a closing socket
    LocalEndpoint& local;
    LinkTap& tap;
    EchoWatch& echo;
    LinkCounters& counts;
  };

  /// Opens the unicast socket. @throws std::system_error with the value and the remedy
  UdpSocketTable(const Surroundings& link, const NetworkInterface& interface);

  [[nodiscard]] UdpSlot& operator[](std::size_t number) noexcept { return slots_[number]; }
  [[nodiscard]] std::span<UdpSlot> slots() noexcept { return slots_; }

  /// See Link::join and Link::leave.
  std::error_code join(const GroupAddress& group) noexcept;
  void leave(const GroupAddress& group) noexcept;

  /// Leaves and rejoins all groups: a membership belongs to an interface, not to its name.
  void rejoin();
  /// Joins groups that rejoin() could not, as far as possible by now.
  void join_missing();
  /// Numbers of joined groups, and of groups that could not be joined again.
  [[nodiscard]] std::size_t joined() const noexcept;
  [[nodiscard]] std::size_t missing() const noexcept { return missing_.size(); }

  /// Opens all further sockets on this interface.
  void set_interface(const NetworkInterface& interface) {
    options_.interface_index = interface.index;
    broadcasts_ = interface.broadcasts;
  }
  /// Sets the new index of the interface on the unicast socket.
  [[nodiscard]] std::error_code renew_outgoing_interface();
  /// Replaces the unicast socket by one bound to this endpoint, or to another port if that is in
  /// use. It keeps the number of the old one, so that the writing thread always has a socket.
  [[nodiscard]] std::error_code reopen_unicast(const IpEndpoint& endpoint);

  /// Whether the kernel hands over runs of datagrams as one.
  [[nodiscard]] bool coalesces() const noexcept { return options_.coalesce; }
  /// 0 if the kernel can cut a run, else its errno.
  [[nodiscard]] int segment_error() noexcept;
  /// SO_RCVBUF of the unicast socket [octets], in the unit of the request.
  [[nodiscard]] std::size_t receive_buffer();
  /// IP_MTU towards that group [octets], 0 if the kernel does not know it.
  [[nodiscard]] std::size_t mtu(const GroupAddress& group);

 private:
  [[nodiscard]] bool watch(std::size_t number) noexcept;
  [[nodiscard]] std::vector<IpEndpoint> addresses_of(const GroupAddress& group) const;
  [[nodiscard]] UdpSlot* find(const GroupAddress& group) noexcept;
  std::error_code open(const GroupAddress& group) noexcept;
  std::error_code adopt(asio::ip::udp::socket socket, const GroupAddress& group);
  void close(UdpSlot& slot) noexcept;
  void take_local_endpoint();
  [[nodiscard]] bool reads_first(const GroupAddress& group) const noexcept;

  Surroundings link_;
  UdpSocketOptions options_;
  asio::io_context context_{1};  // owns the sockets; its own loop never runs, see docs/transport.md
  std::vector<UdpSlot> slots_;
  std::vector<IpEndpoint> broadcasts_;  // of the interface's subnets
  std::vector<GroupAddress> missing_;   // lost with the interface and not rejoined yet
};

}  // namespace reckon::peer
