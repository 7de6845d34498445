// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The site of a host's entity IDs.
#pragma once

#include <cstdint>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A DIS site below the site of the scene, from the address of a host: the same for all its
/// processes, and rarely the same on two hosts.
[[nodiscard]] inline std::uint16_t site_of(const IpEndpoint& host) noexcept {
  // FNV-1a of the address.
  std::uint32_t hash = 2166136261u;
  for (const std::uint8_t octet : host.octets) hash = (hash ^ octet) * 16777619u;
  return static_cast<std::uint16_t>(1 + (hash ^ (hash >> 16)) % (aoim::kSceneSite - 1u));
}

}  // namespace reckon::peer
