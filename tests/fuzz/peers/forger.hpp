// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A stranger on the network that has recorded everything: it has the ids, epochs and sequence
// numbers of all, and sends from its own address. (An attacker that can forge source addresses can
// do all of this to peers without keys.)
#pragma once

#include "reckon/tests/fuzz/peers/life.hpp"

namespace reckon::fuzz {

/// Datagram number `count` of this fault on `victim`.
[[nodiscard]] PeerDatagram forged(const Fault& fault, const Life& victim, std::uint32_t count,
                                  nanoseconds utc);

/// How many datagrams the forger sends at once.
[[nodiscard]] constexpr std::size_t forged_at_once(FaultKind kind) noexcept {
  return kind == FaultKind::flood ? 20 : 1;
}

}  // namespace reckon::fuzz
