// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What this host may lack: each probe looks at one thing and says what it means and what to do.
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

/// How bad a finding is.
enum class FindingLevel : std::uint8_t {
  ok,
  note,     ///< works, but the user should know
  warning,  ///< works worse than it could
  problem   ///< does not work
};
[[nodiscard]] std::string_view name(FindingLevel level) noexcept;

/// One thing looked at.
struct Finding {
  FindingLevel level{FindingLevel::ok};
  std::string what;    ///< a sentence with the value found
  std::string remedy;  ///< what to do, often a command; empty where nothing is to be done
};

/// What a peer is about to need.
struct HostNeeds {
  GroupPool pool{GroupPool::ipv4_default()};  ///< address, port and family of its groups
  std::size_t groups{256};                    ///< of them, joined at the same time
  std::size_t receive_buffer{std::size_t{1} << 20};
  std::vector<NamedPeer> peers;  ///< in place of groups, where there is no multicast
};

// Each probe takes the time given or less than 1 ms, changes nothing that outlives it, throws
// nothing but std::bad_alloc, and may be called by any thread.

/// Joins the group as a peer would, on its port, sends an empty datagram there, which nobody takes
/// for a PDU, and waits up to 100 ms for it to come back: firewalls and programs that hold the port
/// show.
[[nodiscard]] Finding probe_multicast(const NetworkInterface& interface, const GroupAddress& group);
/// Joins the base group and `count` groups of the pool at once, with a socket each: descriptors,
/// memberships and socket memory. Some 30 us a group.
[[nodiscard]] Finding probe_groups(const NetworkInterface& interface, const GroupPool& pool,
                                   std::size_t count);
/// Whether the group has a route without naming an interface (other tools need one).
[[nodiscard]] Finding probe_multicast_route(const NetworkInterface& interface,
                                            const GroupAddress& group);
/// igmp_max_memberships; Reckon takes one socket a group, other programs may not.
[[nodiscard]] Finding probe_memberships();
/// net.core.rmem_max against the receive buffer asked for.
[[nodiscard]] Finding probe_receive_buffer(std::size_t asked);
/// Sends a run of two datagrams of one octet each to the group, which nobody takes for PDUs:
/// whether the kernel cuts it (UDP_SEGMENT), and may hand runs over as one (UDP_GRO).
[[nodiscard]] Finding probe_offload(const NetworkInterface& interface, const GroupAddress& group);
/// net.ipv4.conf.*.rp_filter: drops what comes from an unrouted subnet.
[[nodiscard]] Finding probe_reverse_path_filter(const NetworkInterface& interface);
/// Whether the MTU carries the default payload, and 1500.
[[nodiscard]] Finding probe_mtu(const NetworkInterface& interface);
/// Wireless, virtual and loopback interfaces.
[[nodiscard]] Finding probe_interface_kind(const NetworkInterface& interface);
/// Whether a thread may take SCHED_FIFO (tried in a thread that ends at once).
[[nodiscard]] Finding probe_real_time();
/// Whether memory may be locked (RLIMIT_MEMLOCK, CAP_IPC_LOCK); locks nothing.
[[nodiscard]] Finding probe_memory_lock();
/// Sleeps at 1 kHz for `duration` and tells the lateness and the timer slack.
[[nodiscard]] Finding probe_timer(std::chrono::milliseconds duration = std::chrono::milliseconds{
                                      200});
/// RLIMIT_NOFILE against one socket a group.
[[nodiscard]] Finding probe_open_files(std::size_t groups);

/// Looks the peers of a list up and sends each an empty datagram, which nobody takes for a PDU,
/// from the port that they answer to: who has no address, no route, and whether this host is in it.
/// Looking up may take seconds.
[[nodiscard]] Finding probe_peers(const NetworkInterface& interface,
                                  const std::vector<NamedPeer>& peers, const GroupAddress& group);

/// All probes in that order; with a list of peers that one in place of those of groups.
[[nodiscard]] std::vector<Finding> examine_host(const NetworkInterface& interface,
                                                const HostNeeds& needs);

/// Raises the soft limit of open files to the hard one; returns the limit now in force. The only
/// function here that changes something: every UdpMulticast calls it.
std::size_t raise_open_file_limit() noexcept;

}  // namespace reckon::peer
