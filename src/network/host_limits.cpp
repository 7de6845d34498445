// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/host_limits.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <optional>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/network/udp_socket.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kDefaultPayload = 1352;  // of a bundle, over IPv6 with an MTU of 1400
constexpr std::size_t kIpv6AndUdp = 48;
constexpr std::size_t kAroundBundle = 64 + kIpv6AndUdp;  // an authentication tag's room first
constexpr std::size_t kUsualMtu = 1500;
constexpr nanoseconds kEchoLimit = std::chrono::milliseconds(100);

std::optional<long> read_number(const std::string& path) {
  std::ifstream file(path);
  long value = 0;
  if (!(file >> value)) return std::nullopt;
  return value;
}

std::string microseconds(nanoseconds duration) {
  return std::to_string(duration.count() / 1000) + " us";
}

Finding ok(std::string what) { return {FindingLevel::ok, std::move(what), {}}; }

std::string multicast_remedy(const NetworkInterface& interface, const GroupAddress& group) {
  return "choose another interface with --iface; let UDP to port " + std::to_string(group.port) +
         " through the firewall (nft list ruleset); ip link set " + interface.name +
         " multicast on. Clouds, WSL2 and Docker bridges carry no multicast: reckon peer --to "
         "ADDRESSES, or [network] peers = [\"ADDRESS\", ..] in the scene, does without";
}

UdpMulticastOptions link_options(const NetworkInterface& interface, const GroupAddress& group) {
  UdpMulticastOptions options;
  options.interface = interface.name;
  options.ipv6 = group.is_v6;
  options.broadcast = may_be_broadcast(group);
  options.deliver_own = true;
  return options;
}

// Sends to the group; returns the time until it came back, within the limit.
std::optional<nanoseconds> echo(UdpMulticast& link, const GroupAddress& group, const Clock& clock) {
  const nanoseconds sent = clock.now();
  if (!link.send(group, {})) return std::nullopt;
  std::array<Datagram, 4> batch;
  while (clock.now() - sent < kEchoLimit) {
    link.wait(kEchoLimit - (clock.now() - sent));
    const std::size_t count = link.receive(batch);
    for (std::size_t i = 0; i < count; ++i) {
      if (batch[i].sender == link.local_endpoint()) return clock.now() - sent;
    }
  }
  return std::nullopt;
}

// Runs in a separate thread, which takes the right and ends with it.
void* try_real_time(void* result) {
  sched_param parameter{};
  parameter.sched_priority = 50;
  *static_cast<int*>(result) = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter);
  return nullptr;
}

void sleep_until(nanoseconds due) {
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(due);
  const timespec limit{whole.count(), (due - whole).count()};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &limit, nullptr) == EINTR) {
  }
}

}  // namespace

std::string_view name(FindingLevel level) noexcept {
  switch (level) {
    case FindingLevel::ok:
      return "ok";
    case FindingLevel::note:
      return "note";
    case FindingLevel::warning:
      return "warning";
    case FindingLevel::problem:
      return "problem";
  }
  return "?";
}

Finding probe_multicast(const NetworkInterface& interface, const GroupAddress& group) {
  const std::string where = (may_be_broadcast(group) ? "broadcast on " : "multicast on ") +
                            interface.name + " to " + group.text();
  const std::string remedy = multicast_remedy(interface, group);
  try {
    const SteadyClock clock;
    UdpMulticast link(link_options(interface, group), clock);
    if (const std::error_code error = link.join(group)) {
      return {FindingLevel::problem, where + ": " + advice(error, group), remedy};
    }
    if (const auto took = echo(link, group, clock)) {
      return ok(where + ": own datagram back after " + microseconds(*took));
    }
    const std::error_code refused(link.statistics().last_send_error, std::generic_category());
    if (!refused) {
      return {FindingLevel::problem, where + ": own datagram not back within 100 ms", remedy};
    }
    return {FindingLevel::problem,
            where + ": the kernel refuses to send: " + refused.message() + "; " +
                std::string(send_remedy(refused)),
            remedy};
  } catch (const std::exception& failure) {
    return {FindingLevel::problem, where + ": " + failure.what(), remedy};
  }
}

Finding probe_groups(const NetworkInterface& interface, const GroupPool& pool, std::size_t count) {
  const std::size_t wanted = std::min(count, pool.size());
  const std::string what = std::to_string(wanted) + " groups behind " + pool.base().text();
  try {
    const SteadyClock clock;
    UdpMulticast link(link_options(interface, pool.base()), clock);
    for (std::size_t i = 0; i < wanted; ++i) {
      const std::error_code error = link.join(pool.address(i));
      if (!error) continue;
      return {FindingLevel::problem,
              what + ": " + std::to_string(i) + " could be joined, then: " + error.message(),
              std::string(join_remedy(error))};
    }
    return ok(what + " can be joined at once");
  } catch (const std::exception& failure) {
    return {FindingLevel::problem, what + ": " + failure.what(), {}};
  }
}

Finding probe_multicast_route(const NetworkInterface& interface, const GroupAddress& group) {
  const bool ipv6 = group.is_v6;
  const int handle = socket(ipv6 ? AF_INET6 : AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (handle < 0) {
    return {FindingLevel::problem, std::string("no UDP socket: ") + std::strerror(errno), {}};
  }
  sockaddr_storage to{};
  const socklen_t size = to_sockaddr(group, 0, to);
  const int error = connect(handle, reinterpret_cast<const sockaddr*>(&to), size) == 0 ? 0 : errno;
  close(handle);
  const std::string where = "route to " + group.address_text();
  if (error == 0) return ok(where + ": there is one");
  const std::string net =
      ipv6 ? "-6 route add multicast ff00::/8 dev " : "route add 239.0.0.0/8 dev ";
  return {FindingLevel::note,
          where + ": " + std::strerror(error) +
              "; Reckon sets its interface and needs none; other programs may",
          "ip " + net + interface.name + (ipv6 ? " table local" : "")};
}

Finding probe_memberships() {
  const auto value = read_number("/proc/sys/net/ipv4/igmp_max_memberships");
  if (!value) return {FindingLevel::note, "igmp_max_memberships cannot be read", {}};
  const std::string what = "igmp_max_memberships = " + std::to_string(*value) +
                           " groups per socket; Reckon uses one socket per group";
  if (*value >= 1) return ok(what);
  return {FindingLevel::problem, what, "sysctl -w net.ipv4.igmp_max_memberships=20"};
}

Finding probe_receive_buffer(std::size_t asked) {
  const auto value = read_number("/proc/sys/net/core/rmem_max");
  if (!value) return {FindingLevel::note, "net.core.rmem_max cannot be read", {}};
  const std::string what = "net.core.rmem_max = " + std::to_string(*value) + " octets, asked for " +
                           std::to_string(asked);
  if (static_cast<std::size_t>(*value) >= asked) return ok(what);
  const std::string remedy = "sysctl -w net.core.rmem_max=" + std::to_string(asked);
  if (geteuid() == 0) return {FindingLevel::note, what + "; as root, Reckon exceeds it", remedy};
  return {FindingLevel::warning, what + ": datagrams are lost when a thread stalls", remedy};
}

Finding probe_offload(const NetworkInterface& interface, const GroupAddress& group) {
  const std::string where = "runs of datagrams on " + interface.name + ": ";
  try {
    const SteadyClock clock;
    UdpMulticast link(link_options(interface, group), clock);
    const std::array<std::byte, 2> octets{};
    const std::array<OutgoingDatagram, 2> run{
        {{group, std::span(octets).first(1)}, {group, std::span(octets).last(1)}}};
    const SentBatch sent = link.send_batch(run);
    const UdpOffload used = link.offload();
    const std::string what =
        where +
        (used.segments ? "segmented by the kernel (UDP_SEGMENT)" : "each is sent separately") +
        ", " + (used.coalesces ? "taken whole (UDP_GRO)" : "each is received separately");
    if (sent.datagrams < run.size()) return {FindingLevel::note, where + "cannot be sent", {}};
    if (used.segments && used.coalesces) return ok(what);
    const std::string why =
        used.refusal == 0 ? "" : "; UDP_SEGMENT: " + std::generic_category().message(used.refusal);
    return {FindingLevel::note, what + why + "; bulk traffic costs 2 to 9 times as much",
            used.refusal == EIO ? "ethtool -K " + interface.name + " tx on" : ""};
  } catch (const std::exception& failure) {
    return {FindingLevel::problem, where + failure.what(), {}};
  }
}

Finding probe_reverse_path_filter(const NetworkInterface& interface) {
  const std::string base = "/proc/sys/net/ipv4/conf/";
  const long all = read_number(base + "all/rp_filter").value_or(0);
  const long own = read_number(base + interface.name + "/rp_filter").value_or(0);
  const long value = std::max(all, own);  // the kernel uses this one
  const std::string what = "rp_filter of " + interface.name + " = " + std::to_string(value);
  if (value == 0) return ok(what);
  return {FindingLevel::note,
          what + ": peers in a subnet without a route from here are not received",
          "sysctl -w net.ipv4.conf.all.rp_filter=0 net.ipv4.conf." + interface.name +
              ".rp_filter=0, or give the peers addresses of one subnet"};
}

Finding probe_mtu(const NetworkInterface& interface, std::size_t longest_bundle) {
  const std::string what = "MTU of " + interface.name + " = " + std::to_string(interface.mtu);
  const std::size_t needed = longest_bundle + kAroundBundle;
  if (interface.mtu < needed) {
    const bool fits_default = interface.mtu >= kDefaultPayload + kIpv6AndUdp;
    const std::string bundle = std::to_string(longest_bundle);
    return {fits_default ? FindingLevel::warning : FindingLevel::problem,
            what + ": bundles of " + bundle + " octets do not fit; shorter ones are sent",
            "ip link set " + interface.name + " mtu " +
                std::to_string(std::max(needed, kUsualMtu)) +
                ", or a smaller [network.bundle] max"};
  }
  if (interface.mtu >= kUsualMtu) return ok(what);
  return {FindingLevel::note,
          what +
              ", less than 1500; Reckon's datagrams fit, those of other DIS programs may be "
              "fragmented",
          {}};
}

Finding probe_interface_kind(const NetworkInterface& interface) {
  if (interface.loopback) {
    return {FindingLevel::note,
            interface.name + " is loopback: only peers of this host are received",
            "choose another with --iface"};
  }
  if (interface.wireless) {
    return {FindingLevel::warning,
            interface.name + " is wireless: multicast goes at the lowest rate and is not repeated",
            "use a cable for haptic peers"};
  }
  if (interface.virtual_device) {
    return {FindingLevel::note,
            interface.name + " is virtual (bridge, tunnel, container): it may not reach the LAN",
            "choose another with --iface if peers are not found"};
  }
  return ok(interface.name + " is a wired interface");
}

Finding probe_real_time() {
  int result = 0;
  pthread_t thread{};
  if (const int error = pthread_create(&thread, nullptr, try_real_time, &result); error != 0) {
    return {FindingLevel::problem, std::string("no thread: ") + std::strerror(error), {}};
  }
  pthread_join(thread, nullptr);
  if (result == 0) return ok("SCHED_FIFO is permitted");
  return {FindingLevel::warning,
          std::string("SCHED_FIFO: ") + std::strerror(result) +
              "; the servo is late while other programs run",
          "setcap cap_sys_nice+ep on the program, or 'rtprio 50' in /etc/security/limits.conf"};
}

Finding probe_memory_lock() {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY) return ok("memory may be locked");
  return {FindingLevel::warning,
          "RLIMIT_MEMLOCK = " + std::to_string(limit.rlim_cur) +
              " octets: a page fault may delay the servo",
          "setcap cap_ipc_lock+ep on the program, or 'memlock unlimited' in "
          "/etc/security/limits.conf"};
}

Finding probe_timer(std::chrono::milliseconds duration) {
  const SteadyClock clock;
  constexpr nanoseconds period = std::chrono::milliseconds(1);
  DurationHistogram lateness;
  const nanoseconds start = clock.now();
  for (nanoseconds due = start + period; due <= start + duration; due += period) {
    sleep_until(due);
    lateness.add(clock.now() - due);
  }
  const Percentiles late = percentiles(lateness);
  const int slack_ns = prctl(PR_GET_TIMERSLACK);
  const std::string what = "1 kHz sleep for " + std::to_string(duration.count()) +
                           " ms: late by p50 " + microseconds(late.p50) + ", p99 " +
                           microseconds(late.p99) + ", max " + microseconds(late.max) +
                           "; timer slack " + microseconds(nanoseconds(slack_ns));
  if (late.p99 < period / 2) return ok(what);
  return {FindingLevel::warning, what,
          "end other load, permit SCHED_FIFO, or give the servo a core of its own (isolcpus)"};
}

Finding probe_open_files(std::size_t groups) {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  const std::size_t needed = groups + 64;
  const std::string what = "open files: " + std::to_string(limit.rlim_cur) + ", can be raised to " +
                           std::to_string(limit.rlim_max) + "; " + std::to_string(groups) +
                           " groups need " + std::to_string(needed);
  if (limit.rlim_max >= needed) return ok(what);
  return {FindingLevel::problem, what,
          "'nofile " + std::to_string(needed) + "' in /etc/security/limits.conf, or fewer groups"};
}

std::size_t raise_open_file_limit() noexcept {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return 0;
  if (limit.rlim_cur < limit.rlim_max) {
    const rlimit raised{limit.rlim_max, limit.rlim_max};
    if (setrlimit(RLIMIT_NOFILE, &raised) == 0) limit = raised;
  }
  return static_cast<std::size_t>(limit.rlim_cur);
}

Finding probe_peers(const NetworkInterface& interface, const std::vector<NamedPeer>& peers,
                    const GroupAddress& group) {
  const std::string what = "the list of " + std::to_string(peers.size()) + " peers";
  const std::string remedy = "name addresses that this host has a route to: ip route get ADDRESS";
  try {
    UdpMulticastOptions options = link_options(interface, group);
    options.unicast_port = group.port;
    const SteadyClock clock;
    UdpMulticast link(options, clock);
    bool is_in = false;
    for (const IpEndpoint& peer : resolve_peers(peers, group.port, group.is_v6)) {
      if (peer == link.local_endpoint()) {
        is_in = true;
      } else if (!link.send(peer, {})) {
        return {FindingLevel::problem,
                what + ": cannot send to " + peer.text() + ": " +
                    std::generic_category().message(link.statistics().last_send_error),
                remedy};
      }
    }
    const std::string self = "this host, " + link.local_endpoint().text();
    if (is_in) return ok(what + " can be sent to; " + self + ", is in it");
    return {FindingLevel::note, what + " can be sent to; " + self + ", is not in it",
            "one list serves all hosts of an exercise: put this one into theirs"};
  } catch (const std::exception& failure) {
    return {FindingLevel::problem, what + ": " + failure.what(), remedy};
  }
}

std::vector<Finding> examine_host(const NetworkInterface& interface, const HostNeeds& needs) {
  std::vector<Finding> findings;
  if (needs.peers.empty()) {
    findings = {probe_multicast(interface, needs.pool.base()),
                probe_groups(interface, needs.pool, needs.groups),
                probe_multicast_route(interface, needs.pool.base()), probe_memberships()};
  } else {
    findings = {probe_peers(interface, needs.peers, needs.pool.base())};
  }
  const std::size_t groups = needs.peers.empty() ? needs.groups : 0;
  for (Finding& finding : std::vector<Finding>{
           probe_receive_buffer(needs.receive_buffer), probe_offload(interface, needs.pool.base()),
           probe_reverse_path_filter(interface), probe_mtu(interface, needs.longest_bundle),
           probe_interface_kind(interface), probe_real_time(), probe_memory_lock(), probe_timer(),
           probe_open_files(groups)})
    findings.push_back(std::move(finding));
  return findings;
}

}  // namespace reckon::peer
