// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/life_proof.hpp"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <span>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/peer/sealing/random_source.hpp"

namespace reckon::peer {

aoim::ChainLink follow_chain(const aoim::ChainLink& link, std::uint32_t number) noexcept {
  std::array<std::byte, sizeof(aoim::ChainLink) + sizeof number> argument;
  std::ranges::copy(std::as_bytes(std::span(link)), argument.begin());
  pdu::store_big_endian(argument.data() + sizeof(aoim::ChainLink), number);
  aoim::ChainLink value;
  crypto_generichash(value.data(), value.size(),
                     reinterpret_cast<const unsigned char*>(argument.data()), argument.size(),
                     nullptr, 0);
  return value;
}

aoim::ChainLink hash_with_key(const aoim::ChainLink& key,
                              std::span<const std::byte> octets) noexcept {
  aoim::ChainLink value;
  crypto_generichash(value.data(), value.size(),
                     reinterpret_cast<const unsigned char*>(octets.data()), octets.size(),
                     key.data(), key.size());
  return value;
}

aoim::ChainLink draw_chain_secret() {
  aoim::ChainLink secret;
  if (!system_random(std::as_writable_bytes(std::span(secret)))) throw RandomSourceError();
  return secret;
}

aoim::ChainLink chain_secret_of(std::uint32_t epoch) noexcept { return follow_chain({}, epoch); }

}  // namespace reckon::peer
