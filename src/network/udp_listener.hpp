// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Receives datagrams to groups, broadcast addresses and addresses of this host, on one interface or
// on all of them. Sends nothing. Private to the peer library.
#pragma once

#include <asio/io_context.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/copy_filter.hpp"
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

/// The addresses to receive from, and the interface.
struct UdpListenerOptions {
  std::string interface;  ///< name, address or index; empty: every interface that is up
  /// At least one, all of one family. A group; 255.255.255.255 or the broadcast address of a
  /// subnet, where each includes the other; an address of this host; 0.0.0.0 for all of its
  /// broadcast and own addresses ([::]: its own ones).
  std::vector<IpEndpoint> places;
  bool skips_failures{false};  ///< skips places without a socket; else they throw
};

/// One socket for each address; a group is joined on each interface. A datagram that came over
/// several interfaces is returned once, see CopyFilter. Interfaces and addresses that appear later
/// are included. One thread, except wake(). Joining, interfaces and copies allocate.
class UdpListener {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  /// @param clock outlives this. @throws std::system_error or std::runtime_error with the value and
  /// the remedy
  UdpListener(const UdpListenerOptions& options, const Clock& clock);

  /// Takes arrived datagrams without blocking; valid until the next call. @returns their number
  [[nodiscard]] std::size_t receive(std::span<Datagram> out);
  /// Waits until receive() has something, wake() is called or `timeout` is over.
  void wait(nanoseconds timeout);
  /// Index of the interface over which a returned datagram came, until the next call of receive().
  [[nodiscard]] unsigned interface_of(const Datagram& datagram) const noexcept {
    return receiver_.interface_of(datagram);
  }
  void wake() noexcept { ready_.wake(); }

  /// The interfaces in use, by index. Changes in wait().
  [[nodiscard]] const std::vector<NetworkInterface>& interfaces() const noexcept { return used_; }
  [[nodiscard]] LinkStatistics statistics() const noexcept { return counts_.values(); }
  [[nodiscard]] std::uint64_t copies() const noexcept { return copies_; }
  /// Sentences about places from which nothing can be received; empty if there are none.
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  /// An address to which a socket is bound.
  struct Ear {
    IpEndpoint address;
    unsigned interface = 0;  ///< its only interface; 0: all
    bool is_broadcast{false};
    bool operator==(const Ear&) const = default;
  };
  [[nodiscard]] std::vector<NetworkInterface> choose() const;
  [[nodiscard]] std::vector<Ear> ears_of(const IpEndpoint& place,
                                         std::span<const NetworkInterface> interfaces) const;
  [[nodiscard]] UdpSocketOptions socket_options(const Ear& ear) const;
  void listen();
  void close_all_but(std::span<const Ear> wanted);
  void listen_to(const IpEndpoint& place, std::span<const NetworkInterface> added);
  [[nodiscard]] UdpSlot* find(const Ear& ear) noexcept;
  [[nodiscard]] std::error_code open(const Ear& ear);
  [[nodiscard]] std::error_code join(UdpSlot& slot, std::span<const NetworkInterface> added);
  void leave(std::span<const NetworkInterface> gone);
  void warn(std::string sentence);

  UdpListenerOptions asked_;
  const Clock& clock_;
  UdpMulticastOptions options_;  // of the sockets
  std::string interface_;        // its name, if one was asked for
  asio::io_context context_{1};  // owns the sockets; its own loop never runs
  LinkCounters counts_;
  LocalEndpoint nobody_;  // nothing is sent: no datagram is our own
  EchoWatch echo_;
  LinkTap no_tap_{nullptr, {}};
  UdpReadiness ready_;
  UdpReceiver receiver_;
  std::vector<Ear> ears_;       // of the slots with the same number
  std::vector<UdpSlot> slots_;  // open or free
  std::vector<NetworkInterface> used_;
  CopyFilter filter_;
  std::uint64_t copies_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace reckon::peer
