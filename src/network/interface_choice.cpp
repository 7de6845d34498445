// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/interface_choice.hpp"

#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace reckon::peer {
namespace {

namespace fs = std::filesystem;

std::optional<IpEndpoint> to_endpoint(const sockaddr* address) {
  if (address == nullptr) return std::nullopt;
  IpEndpoint out;
  if (address->sa_family == AF_INET) {
    const auto* v4 = reinterpret_cast<const sockaddr_in*>(address);
    std::memcpy(out.octets.data(), &v4->sin_addr, sizeof v4->sin_addr);
    return out;
  }
  if (address->sa_family == AF_INET6) {
    const auto* v6 = reinterpret_cast<const sockaddr_in6*>(address);
    out.is_v6 = true;
    std::memcpy(out.octets.data(), &v6->sin6_addr, sizeof v6->sin6_addr);
    return out;
  }
  return std::nullopt;
}

// The broadcast address of the subnet; nothing for IPv6 and if the subnet has none (/31, /32).
std::optional<IpEndpoint> broadcast_of(const IpEndpoint& address, const sockaddr* netmask) {
  if (address.is_v6 || netmask == nullptr) return std::nullopt;
  sockaddr_in mask{};
  std::memcpy(&mask, netmask, sizeof mask);
  const std::uint32_t host_bits = ~ntohl(mask.sin_addr.s_addr);
  if (host_bits < 3) return std::nullopt;
  IpEndpoint out = address;
  for (std::size_t i = 0; i < 4; ++i)
    out.octets[i] = static_cast<std::uint8_t>(out.octets[i] | host_bits >> (24 - 8 * i));
  return out;
}

std::string read_line(const fs::path& path) {
  std::string line;
  std::ifstream file(path);
  std::getline(file, line);
  return line;
}

// Properties that only sysfs has. In a network namespace sysfs may show the interfaces of another
// one, which the index reveals; then nothing is assumed.
void read_sysfs(NetworkInterface& interface) {
  const fs::path base = fs::path("/sys/class/net") / interface.name;
  if (read_line(base / "ifindex") != std::to_string(interface.index)) return;
  std::error_code ignored;
  interface.wireless =
      fs::exists(base / "wireless", ignored) || fs::exists(base / "phy80211", ignored);
  const fs::path target = fs::read_symlink(base, ignored);
  interface.virtual_device = target.string().find("/virtual/") != std::string::npos;
}

std::size_t read_mtu(const std::string& name) {
  const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (handle < 0) return 0;
  ifreq request{};
  name.copy(request.ifr_name, IFNAMSIZ - 1);
  const bool known = ioctl(handle, SIOCGIFMTU, &request) == 0;
  close(handle);
  return known ? static_cast<std::size_t>(request.ifr_mtu) : 0;
}

NetworkInterface& interface_named(std::vector<NetworkInterface>& all, const ifaddrs& entry) {
  for (NetworkInterface& interface : all) {
    if (interface.name == entry.ifa_name) return interface;
  }
  NetworkInterface& made = all.emplace_back();
  made.name = entry.ifa_name;
  made.index = if_nametoindex(entry.ifa_name);
  made.up = (entry.ifa_flags & IFF_UP) != 0;
  made.running = (entry.ifa_flags & IFF_RUNNING) != 0;
  made.multicast = (entry.ifa_flags & IFF_MULTICAST) != 0;
  made.loopback = (entry.ifa_flags & IFF_LOOPBACK) != 0;
  made.point_to_point = (entry.ifa_flags & IFF_POINTOPOINT) != 0;
  made.mtu = read_mtu(made.name);
  read_sysfs(made);
  return made;
}

bool matches(const NetworkInterface& interface, std::string_view requested) {
  if (interface.name == requested) return true;
  unsigned index = 0;
  const auto [end, error] =
      std::from_chars(requested.data(), requested.data() + requested.size(), index);
  if (error == std::errc{} && end == requested.data() + requested.size()) {
    return interface.index == index;
  }
  const std::optional<IpEndpoint> address = IpEndpoint::parse(requested);
  return address && std::find(interface.addresses.begin(), interface.addresses.end(), *address) !=
                        interface.addresses.end();
}

std::string describe(const NetworkInterface& interface, bool ipv6) {
  const InterfaceScore score = rate(interface, ipv6);
  const std::optional<IpEndpoint> address = interface.address(ipv6);
  return interface.name + " (index " + std::to_string(interface.index) +
         (address ? ", " + address->address_text() : "") +
         "): " + (score.usable ? "score " + std::to_string(score.score) + ": " : "not usable: ") +
         score.reason + "\n";
}

std::string describe_all(std::span<const NetworkInterface> candidates, bool ipv6) {
  std::string text;
  for (const NetworkInterface& interface : candidates) text += "  " + describe(interface, ipv6);
  return text;
}

// "interface eth0 (10.0.0.5), the best of 3; --iface names another".
std::string sentence_of(const NetworkInterface& best, std::span<const NetworkInterface> candidates,
                        bool ipv6) {
  if (!best.loopback) {
    return "interface " + best.name + " (" + best.address(ipv6).value().address_text() +
           "), the best of " + std::to_string(candidates.size()) + "; --iface names another";
  }
  std::string others;
  for (const NetworkInterface& one : candidates) {
    if (!one.loopback)
      others += (others.empty() ? "" : ", ") + one.name + ": " + rate(one, ipv6).reason;
  }
  return "WARNING: no other host is reached: interface " + best.name +
         (others.empty() ? " is the only one" : ", because no other can be used (" + others + ")") +
         "; write --iface " + best.name + " if that is intended, else see reckon doctor";
}

InterfaceChoice choose_requested(std::span<const NetworkInterface> candidates,
                                 std::string_view requested, bool ipv6) {
  for (const NetworkInterface& interface : candidates) {
    if (!matches(interface, requested)) continue;
    if (!interface.up || !interface.address(ipv6)) {
      throw std::runtime_error("interface " + describe(interface, ipv6) +
                               "bring it up with an address, or choose another of:\n"
                               "" +
                               describe_all(candidates, ipv6));
    }
    const std::string sentence = "interface " + interface.name + ", as asked for" +
                                 (interface.running ? "" : "; it has no carrier yet");
    return {interface, sentence + '\n', sentence};
  }
  throw std::runtime_error("no interface is named, numbered or addressed '" +
                           std::string(requested) + "'; there are:\n" +
                           describe_all(candidates, ipv6));
}

}  // namespace

bool is_link_local(const IpEndpoint& endpoint) noexcept {
  if (endpoint.is_v6) return endpoint.octets[0] == 0xfe && (endpoint.octets[1] & 0xc0) == 0x80;
  return endpoint.octets[0] == 169 && endpoint.octets[1] == 254;
}

bool may_be_broadcast(const IpEndpoint& endpoint) noexcept {
  if (endpoint.is_v6) return false;
  // At least two bits for the host, all of them 1.
  const auto& octets = endpoint.octets;
  return endpoint.is_broadcast() || (octets[0] != 0 && octets[0] < 224 && (octets[3] & 3) == 3);
}

std::optional<IpEndpoint> NetworkInterface::address(bool ipv6) const {
  std::optional<IpEndpoint> best;
  for (const IpEndpoint& candidate : addresses) {
    if (candidate.is_v6 != ipv6) continue;
    if (!is_link_local(candidate)) return candidate;
    if (!best) best = candidate;
  }
  return best;
}

std::vector<NetworkInterface> list_interfaces() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot list the network interfaces");
  }
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> owner(first, freeifaddrs);
  std::vector<NetworkInterface> all;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    NetworkInterface& interface = interface_named(all, *entry);
    const std::optional<IpEndpoint> address = to_endpoint(entry->ifa_addr);
    if (!address) continue;
    interface.addresses.push_back(*address);
    if (const auto broadcast = broadcast_of(*address, entry->ifa_netmask))
      interface.broadcasts.push_back(*broadcast);
  }
  return all;
}

InterfaceScore rate(const NetworkInterface& interface, bool ipv6) {
  InterfaceScore out;
  const std::optional<IpEndpoint> address = interface.address(ipv6);
  if (!interface.up) return {false, 0, "it is down"};
  if (!interface.running) return {false, 0, "it has no carrier"};
  if (!address) return {false, 0, ipv6 ? "no IPv6 address" : "no IPv4 address"};
  out.usable = true;
  if (interface.loopback) return {true, 0, "loopback comes last"};
  const auto add = [&out](bool holds, int points, const char* yes, const char* no) {
    if (holds) out.score += points;
    if (!out.reason.empty()) out.reason += ", ";
    if (holds) out.reason += '+';
    out.reason += std::to_string(holds ? points : 0).append(" ").append(holds ? yes : no);
  };
  add(!is_link_local(*address), 5, "address", "link-local address");
  add(interface.multicast, 4, "multicast", "no multicast");
  add(!interface.point_to_point, 3, "not point-to-point", "point-to-point");
  add(!interface.virtual_device, 2, "physical", "virtual");
  add(!interface.wireless, 1, "not wireless", "wireless");
  return out;
}

InterfaceChoice choose_interface(std::span<const NetworkInterface> candidates,
                                 std::string_view requested, bool ipv6) {
  if (!requested.empty()) return choose_requested(candidates, requested, ipv6);
  const NetworkInterface* best = nullptr;
  int best_score = -1;
  for (const NetworkInterface& interface : candidates) {
    const InterfaceScore score = rate(interface, ipv6);
    const bool first_of_equals =
        best != nullptr && score.score == best_score && interface.index < best->index;
    if (!score.usable || (score.score <= best_score && !first_of_equals)) continue;
    best = &interface;
    best_score = score.score;
  }
  if (best == nullptr) {
    throw std::runtime_error(std::string("no interface has an ") + (ipv6 ? "IPv6" : "IPv4") +
                             " address and is up; there are:\n" + describe_all(candidates, ipv6));
  }
  return {*best,
          "interface " + best->name + ", by score (choose another with --iface):\n" +
              describe_all(candidates, ipv6),
          sentence_of(*best, candidates, ipv6)};
}

InterfaceStanding find_again(std::span<const NetworkInterface> candidates,
                             std::string_view requested, const NetworkInterface& used, bool ipv6) {
  const std::optional<IpEndpoint> address = IpEndpoint::parse(requested);
  const auto is_it = [&](const NetworkInterface& candidate) {
    return address ? matches(candidate, requested) : candidate.name == used.name;
  };
  const auto found = std::find_if(candidates.begin(), candidates.end(), is_it);
  if (found == candidates.end()) return {{}, address ? "has lost its address" : "is gone"};
  if (!found->up) return {{}, "is down"};
  if (!found->running) return {{}, "has no carrier"};
  if (!found->address(ipv6)) return {{}, ipv6 ? "has no IPv6 address" : "has no IPv4 address"};
  return {*found, {}};
}

InterfaceChoice choose_interface(std::string_view requested, bool ipv6) {
  return choose_interface(list_interfaces(), requested, ipv6);
}

}  // namespace reckon::peer
