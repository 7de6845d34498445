// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Destinations of a replay: groups, hosts, broadcast addresses, and the sockets for them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/network/udp_multicast.hpp"

namespace reckon::tools {

/// Reads "udp://239.1.2.3:3000", "udp://192.168.1.255", "127.0.0.1:3000"; the default port is 3000.
/// @throws UsageError.
[[nodiscard]] peer::IpEndpoint parse_destination(const std::string& text);

/// One IPv4 network of this host.
struct LocalNetwork {
  std::string interface;
  std::uint32_t address = 0;  ///< in host order
  std::uint32_t mask = 0;
};
/// All IPv4 networks of this host. @throws EnvironmentError.
[[nodiscard]] std::vector<LocalNetwork> local_networks();

/// The interface with the broadcast address `to`. Empty for 255.255.255.255, which belongs to every
/// interface. No value if `to` is not a broadcast address.
[[nodiscard]] std::optional<std::string> broadcast_interface(
    const peer::IpEndpoint& to, std::span<const LocalNetwork> networks);

/// The sockets of a replay: one for each address family, opened on demand. The kernel fragments
/// datagrams above the MTU.
class ReplaySenders {
 public:
  ReplaySenders(std::string interface, bool broadcast, const peer::Clock& clock)
      : interface_(std::move(interface)), broadcast_(broadcast), clock_(clock) {}

  /// Sends on this interface; call it before prepare().
  void use(std::string interface) { interface_ = std::move(interface); }
  [[nodiscard]] const std::string& interface() const noexcept { return interface_; }
  /// Opens the socket for `to`. @throws EnvironmentError if that fails.
  void prepare(const peer::IpEndpoint& to);
  /// False if the kernel refused it. @throws EnvironmentError, see prepare().
  bool send(const peer::IpEndpoint& to, std::span<const std::byte> bytes);
  /// Number of refused datagrams that were too long even for fragments.
  [[nodiscard]] std::uint64_t too_big() const;
  /// Number of datagrams above the MTU, which were sent in IP fragments.
  [[nodiscard]] std::uint64_t fragmented() const noexcept { return fragmented_; }
  /// The least MTU in use [octets]; 0 before the first datagram.
  [[nodiscard]] std::size_t mtu() const;

 private:
  [[nodiscard]] std::unique_ptr<peer::UdpMulticast> open(bool ipv6) const;

  std::string interface_;
  bool broadcast_;
  const peer::Clock& clock_;
  std::array<std::unique_ptr<peer::UdpMulticast>, 2> links_;
  std::uint64_t fragmented_ = 0;
};

}  // namespace reckon::tools
