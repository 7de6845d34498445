// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/site_number.hpp"

namespace reckon::peer {

// FNV-1a of the address.
std::uint16_t site_of(const IpEndpoint& host) noexcept {
  std::uint32_t hash = 2166136261u;
  for (const std::uint8_t octet : host.octets) hash = (hash ^ octet) * 16777619u;
  return static_cast<std::uint16_t>(1 + (hash ^ (hash >> 16)) % 65533);
}

}  // namespace reckon::peer
