// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of hosts of an exercise, for networks without multicast: its text form, and its host
// names resolved to addresses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::peer {

struct IpEndpoint;

/// Most addresses in a list. A datagram is sent once to each of them.
inline constexpr std::size_t kMostUnicastPeers = 256;

/// One entry of a list: "10.0.0.7", "host-b:3001", "[2001:db8::7]:3001".
struct NamedPeer {
  std::string host;
  std::uint16_t port = 0;  ///< 0: the port of the exercise
  /// The text that parse_peer() reads.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const NamedPeer&, const NamedPeer&) = default;
};

/// Reads one entry and ignores blanks around it. @throws std::invalid_argument with the entry and
/// the remedy
[[nodiscard]] NamedPeer parse_peer(std::string_view text);

/// Checks the length of a list. @throws std::invalid_argument for more than kMostUnicastPeers
void check_number(const std::vector<NamedPeer>& peers);

/// Reads a list separated by commas. @throws as parse_peer() and check_number()
[[nodiscard]] std::vector<NamedPeer> parse_peers(std::string_view list);

/// Resolves the host names and returns each address once. The look-up may take seconds. @throws
/// std::runtime_error with a name that is unknown or has no address of this family
[[nodiscard]] std::vector<IpEndpoint> resolve_peers(const std::vector<NamedPeer>& peers,
                                                    std::uint16_t port, bool ipv6);

}  // namespace reckon::peer
