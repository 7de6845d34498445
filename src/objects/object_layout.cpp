// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/object_layout.hpp"

#include <sodium.h>

#include <array>

#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::peer {
namespace {

const unsigned char* octets_of(std::span<const std::byte> bytes) noexcept {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

constexpr std::string_view kDigits = "0123456789abcdef";

}  // namespace

ObjectHash hash_of_block(std::span<const std::byte> octets) noexcept {
  ObjectHash hash;
  crypto_generichash_blake2b(hash.data(), hash.size(), octets_of(octets), octets.size(), nullptr,
                             0);
  return hash;
}

ObjectHash hash_of_object(std::uint64_t size, std::span<const ObjectHash> blocks) noexcept {
  crypto_generichash_blake2b_state state;
  ObjectHash hash;
  crypto_generichash_blake2b_init(&state, nullptr, 0, hash.size());
  std::array<std::byte, sizeof(size)> length;
  pdu::store_big_endian(length.data(), size);
  crypto_generichash_blake2b_update(&state, octets_of(length), length.size());
  const auto list = std::as_bytes(blocks);
  crypto_generichash_blake2b_update(&state, octets_of(list), list.size());
  crypto_generichash_blake2b_final(&state, hash.data(), hash.size());
  return hash;
}

std::string text_of(const ObjectHash& hash) {
  std::string text;
  for (const std::uint8_t octet : hash) {
    text += kDigits[octet >> 4];
    text += kDigits[octet & 15];
  }
  return text;
}

std::optional<ObjectHash> parse_object_hash(std::string_view text) noexcept {
  ObjectHash hash{};
  if (text.size() != 2 * hash.size()) return std::nullopt;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t digit = kDigits.find(text[i]);
    if (digit == std::string_view::npos) return std::nullopt;
    hash[i / 2] = static_cast<std::uint8_t>((hash[i / 2] << 4) | digit);
  }
  return hash;
}

std::uint64_t key_of(const ObjectHash& hash) noexcept {
  std::uint64_t key = 0;
  for (std::size_t i = 0; i < sizeof(key); ++i) key = (key << 8) | hash[i];
  return key;
}

}  // namespace reckon::peer
