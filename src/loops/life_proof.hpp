// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Functions that prove an epoch (aoim/presence/life_chain.hpp): BLAKE2b, by libsodium.
#pragma once

#include <cstdint>
#include <span>

#include "reckon/aoim/presence/life_chain.hpp"

namespace reckon::peer {

/// BLAKE2b with 128 bits of output, of the link and the number. Some 0.1 us.
[[nodiscard]] aoim::ChainLink follow_chain(const aoim::ChainLink& link,
                                           std::uint32_t number) noexcept;
/// BLAKE2b with 128 bits of output and a key. Some 0.2 us for an announcement.
[[nodiscard]] aoim::ChainLink hash_with_key(const aoim::ChainLink& key,
                                            std::span<const std::byte> octets) noexcept;
/// Secret of an epoch, from the system's random source.  @throws RandomSourceError
[[nodiscard]] aoim::ChainLink draw_chain_secret();
/// Secret of an epoch in a simulation, where equal epochs give equal octets.
[[nodiscard]] aoim::ChainLink chain_secret_of(std::uint32_t epoch) noexcept;

}  // namespace reckon::peer
