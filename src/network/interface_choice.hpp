// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Chooses the network interface of a peer: the user's choice, else a stated rule with reported
// scores.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// One interface of this host.
struct NetworkInterface {
  std::string name;
  unsigned index{0};
  std::vector<IpEndpoint> addresses;   ///< port 0
  std::vector<IpEndpoint> broadcasts;  ///< broadcast addresses of its IPv4 subnets, port 0
  std::size_t mtu{0};                  ///< [octets]
  bool up{false};
  bool running{false};  ///< the link is up (cable, association)
  bool multicast{false};
  bool loopback{false};
  bool point_to_point{false};
  bool wireless{false};
  bool virtual_device{false};  ///< bridge, veth, tunnel, ...: it has no cable

  /// The address to send from: the first that is not link-local, else the first of the family.
  [[nodiscard]] std::optional<IpEndpoint> address(bool ipv6) const;
};

/// True for 169.254.0.0/16 and fe80::/10.
[[nodiscard]] bool is_link_local(const IpEndpoint& endpoint) noexcept;

/// True for 255.255.255.255 and for an IPv4 address that is the broadcast address of a subnet of
/// some size, such as 10.9.9.255. Only the host knows whether one of its interfaces has that
/// subnet.
[[nodiscard]] bool may_be_broadcast(const IpEndpoint& endpoint) noexcept;

/// All interfaces with their addresses. @throws std::system_error.
[[nodiscard]] std::vector<NetworkInterface> list_interfaces();

/// Suitability of an interface for multicast of one address family.
struct InterfaceScore {
  bool usable{false};  ///< up, running, with an address of the family
  int score{0};        ///< see rate()
  std::string reason;  ///< "+5 routable address, +4 multicast, ..."
};

/// The rule: +5 an address that is not link-local, +4 multicast-capable, +3 not point-to-point,
/// +2 not a virtual device, +1 not wireless; loopback counts 0 and comes last.
[[nodiscard]] InterfaceScore rate(const NetworkInterface& interface, bool ipv6);

/// The chosen interface with the reason, for the user.
struct InterfaceChoice {
  NetworkInterface interface;
  std::string explanation;  ///< lines, with the scores of all interfaces
  /// One line. It begins with "WARNING" if loopback was taken because no other can be used.
  std::string sentence;
};

/// Picks from `candidates` by name, address or index if `requested` is not empty (a missing cable
/// is then only reported), else by score, the lower index among equals.
/// @throws std::runtime_error with a list of the interfaces if none fits. Pure.
[[nodiscard]] InterfaceChoice choose_interface(std::span<const NetworkInterface> candidates,
                                               std::string_view requested, bool ipv6);
/// The same over list_interfaces().
[[nodiscard]] InterfaceChoice choose_interface(std::string_view requested, bool ipv6);

/// Whether the interface on which a link was opened can still be used.
struct InterfaceStanding {
  std::optional<NetworkInterface> interface;  ///< its present state; nothing if it cannot be used
  std::string_view why_not;                   ///< "is gone", "is down", ..., for a sentence
};

/// Finds the interface of a link again: the one with the requested address, or the one of the same
/// name with any index. Pure.
/// @param requested as for choose_interface().
/// @param used the interface that was chosen at first
[[nodiscard]] InterfaceStanding find_again(std::span<const NetworkInterface> candidates,
                                           std::string_view requested, const NetworkInterface& used,
                                           bool ipv6);

}  // namespace reckon::peer
