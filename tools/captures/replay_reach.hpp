// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where a replay sends, in words.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::tools {

/// Word of `--iface` for the interface that the capture names.
inline constexpr std::string_view kRecorded = "recorded";
/// The interface that captured the present datagram.
/// @throws UsageError if the capture does not name it, or it is not on this host.
[[nodiscard]] std::string recorded_interface(const peer::DatagramSource& source);

/// Destinations of a replay.
class ReplayReach {
 public:
  /// Limit of counted destinations; with more, the text says "at least".
  static constexpr std::size_t kMost = 1000;

  void note(const peer::IpEndpoint& to) {
    if (destinations_.size() < kMost) destinations_.insert(to);
  }
  /// "239.192.1.0:3000 and 2 more on lo (this host alone; --iface eth0 for the LAN)".
  [[nodiscard]] std::string text(const std::string& interface) const;

 private:
  std::set<peer::IpEndpoint> destinations_;
};

}  // namespace reckon::tools
