// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits of this host: each probe examines one of them and explains the finding and its remedy.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/network/unicast_peers.hpp"

namespace reckon::peer {

/// Severity of a finding.
enum class FindingLevel : std::uint8_t {
  ok,
  note,     ///< works, but the user should know
  warning,  ///< works worse than it could
  problem   ///< does not work
};
[[nodiscard]] std::string_view name(FindingLevel level) noexcept;

/// Result of one probe.
struct Finding {
  FindingLevel level{FindingLevel::ok};
  std::string what;    ///< a sentence with the value found
  std::string remedy;  ///< often a command; empty if nothing is to be done
};

/// Needs of a peer.
struct HostNeeds {
  GroupPool pool{GroupPool::ipv4_default()};  ///< address, port and family of its groups
  std::size_t groups{256};                    ///< of them, joined at the same time
  std::size_t receive_buffer{std::size_t{1} << 20};
  std::size_t longest_bundle{1288};  ///< [octets]
  std::vector<NamedPeer> peers;      ///< instead of groups, if there is no multicast
};

// A probe takes the stated time or less than 1 ms, has no lasting effect, throws only
// std::bad_alloc, and may be called by any thread.

/// Joins the group on its port as a peer would, sends an empty datagram there and waits up to 100
/// ms for it to come back. Programs do not interpret an empty datagram as a PDU. This detects
/// firewalls and programs that hold the port.
[[nodiscard]] Finding probe_multicast(const NetworkInterface& interface, const GroupAddress& group);
/// Joins the base group and `count` groups of the pool at once, with a socket each: tests
/// descriptors, memberships and socket memory. Some 30 us a group.
[[nodiscard]] Finding probe_groups(const NetworkInterface& interface, const GroupPool& pool,
                                   std::size_t count);
/// Whether the group has a route without naming an interface (other tools need one).
[[nodiscard]] Finding probe_multicast_route(const NetworkInterface& interface,
                                            const GroupAddress& group);
/// igmp_max_memberships. Reckon uses one socket for each group; other programs may use one for
/// many.
[[nodiscard]] Finding probe_memberships();
/// net.core.rmem_max compared with the requested receive buffer.
[[nodiscard]] Finding probe_receive_buffer(std::size_t asked);
/// Sends a run of two datagrams of one octet each to the group, which no program interprets as
/// PDUs. Tests whether the kernel cuts the run (UDP_SEGMENT) and may deliver runs as one (UDP_GRO).
[[nodiscard]] Finding probe_offload(const NetworkInterface& interface, const GroupAddress& group);
/// net.ipv4.conf.*.rp_filter: drops datagrams from an unrouted subnet.
[[nodiscard]] Finding probe_reverse_path_filter(const NetworkInterface& interface);
/// Whether the MTU is large enough for bundles of this length with their headers, and for datagrams
/// of 1500 octets.
[[nodiscard]] Finding probe_mtu(const NetworkInterface& interface, std::size_t longest_bundle);
/// Wireless, virtual and loopback interfaces.
[[nodiscard]] Finding probe_interface_kind(const NetworkInterface& interface);
/// Whether a thread may take SCHED_FIFO (tried in a thread that ends at once).
[[nodiscard]] Finding probe_real_time();
/// Whether memory may be locked (RLIMIT_MEMLOCK, CAP_IPC_LOCK); locks nothing.
[[nodiscard]] Finding probe_memory_lock();
/// Sleeps at 1 kHz for `duration` and reports the lateness and the timer slack.
[[nodiscard]] Finding probe_timer(std::chrono::milliseconds duration = std::chrono::milliseconds{
                                      200});
/// RLIMIT_NOFILE against one socket a group.
[[nodiscard]] Finding probe_open_files(std::size_t groups);

/// Resolves the peers of a list and sends each of them an empty datagram from the port to which
/// they answer. Programs do not interpret it as a PDU. Reports peers without an address or a route,
/// and whether this host is in the list. Resolving may take seconds.
[[nodiscard]] Finding probe_peers(const NetworkInterface& interface,
                                  const std::vector<NamedPeer>& peers, const GroupAddress& group);

/// All probes in that order; if there is a list of peers, its probe replaces the probes of groups.
[[nodiscard]] std::vector<Finding> examine_host(const NetworkInterface& interface,
                                                const HostNeeds& needs);

/// Raises the soft limit of open files to the hard one; returns the limit now in force. The only
/// function here with a lasting effect: every UdpMulticast calls it.
std::size_t raise_open_file_limit() noexcept;

}  // namespace reckon::peer
