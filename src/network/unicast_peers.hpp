// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A list of the hosts of an exercise, for networks without multicast: as it is written, and the
// addresses that it names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::peer {

struct IpEndpoint;

/// Most addresses of a list: each datagram is sent so many times.
inline constexpr std::size_t kMostUnicastPeers = 256;

/// One address of a list as it is written: "10.0.0.7", "host-b:3001", "[2001:db8::7]:3001".
struct NamedPeer {
  std::string host;
  std::uint16_t port = 0;  ///< 0: that of the exercise
  /// As it is read.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const NamedPeer&, const NamedPeer&) = default;
};

/// Reads one; blanks around it are passed over. @throws std::invalid_argument with the item and the
/// remedy
[[nodiscard]] NamedPeer parse_peer(std::string_view text);

/// @throws std::invalid_argument where there are more than kMostUnicastPeers
void check_number(const std::vector<NamedPeer>& peers);

/// Reads a list, commas between. @throws as these two
[[nodiscard]] std::vector<NamedPeer> parse_peers(std::string_view list);

/// Their addresses, each once, names looked up now; may take seconds. @throws std::runtime_error
/// with the name that is not known, or knows no address of that family
[[nodiscard]] std::vector<IpEndpoint> resolve_peers(const std::vector<NamedPeer>& peers,
                                                    std::uint16_t port, bool ipv6);

}  // namespace reckon::peer
