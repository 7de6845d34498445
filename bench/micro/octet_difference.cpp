// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/micro/octet_difference.hpp"

#include <algorithm>
#include <array>

#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::bench {
namespace {

constexpr std::size_t kCheckSize = 2;

constexpr std::size_t map_size(std::size_t groups) noexcept { return (groups + 7) / 8; }

// Mask of the 8 octets from `at` that differ, with the first one in the highest bit.
unsigned difference(std::span<const std::byte> a, std::span<const std::byte> b,
                    std::size_t at) noexcept {
  const std::size_t count = std::min<std::size_t>(8, a.size() - at);
  if (std::equal(a.data() + at, a.data() + at + count, b.data() + at)) return 0;
  unsigned map = 0;
  for (std::size_t i = 0; i < count; ++i) map |= a[at + i] == b[at + i] ? 0U : 0x80U >> i;
  return map;
}

}  // namespace

std::uint16_t key_check(std::span<const std::byte> key) noexcept {
  std::uint64_t hash = key.size();
  for (std::size_t at = 0; at < key.size(); at += 8) {
    std::uint64_t word = 0;
    for (std::size_t i = at; i < std::min(at + 8, key.size()); ++i) {
      word = word << 8 | std::to_integer<std::uint64_t>(key[i]);
    }
    hash = (hash ^ word) * 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 29;
  }
  hash *= 0x9E3779B97F4A7C15ULL;  // the highest octets of the last word are included
  return static_cast<std::uint16_t>(hash >> 48);
}

std::size_t encode_delta(std::span<const std::byte> key, std::uint16_t check,
                         std::span<const std::byte> pdu, std::span<std::byte> out) noexcept {
  const std::size_t groups = (pdu.size() + 7) / 8;
  const std::size_t head = kCheckSize + map_size(groups);
  if (key.size() != pdu.size() || pdu.size() > kMostDelta || out.size() < head) return 0;
  const std::size_t most = std::min(out.size(), pdu.size());
  std::fill_n(out.begin(), head, std::byte{0});
  pdu::store_big_endian(out.data(), check);
  std::size_t size = head;
  for (std::size_t group = 0; group < groups; ++group) {
    const unsigned map = difference(key, pdu, 8 * group);
    if (map == 0) continue;
    if (size + 9 > most) return 0;
    out[kCheckSize + group / 8] |= static_cast<std::byte>(0x80U >> group % 8);
    out[size++] = static_cast<std::byte>(map);
    for (std::size_t i = 0; i < 8; ++i) {
      if ((map & 0x80U >> i) != 0) out[size++] = pdu[8 * group + i];
    }
  }
  return size < pdu.size() ? size : 0;
}

std::uint16_t key_of_delta(std::span<const std::byte> body) noexcept {
  return body.size() < kCheckSize ? std::uint16_t{0}
                                  : pdu::load_big_endian<std::uint16_t>(body.data());
}

bool decode_delta(std::span<const std::byte> key, std::span<const std::byte> body,
                  std::span<std::byte> out) noexcept {
  const std::size_t groups = (key.size() + 7) / 8;
  std::size_t at = kCheckSize + map_size(groups);
  if (out.size() != key.size() || key.size() > kMostDelta || body.size() < at) return false;
  std::copy(key.begin(), key.end(), out.begin());
  for (std::size_t group = 0; group < groups; ++group) {
    const auto of_eight = std::to_integer<unsigned>(body[kCheckSize + group / 8]);
    if ((of_eight & 0x80U >> group % 8) == 0) continue;
    if (at == body.size()) return false;
    const auto map = std::to_integer<unsigned>(body[at++]);
    for (std::size_t i = 0; i < 8; ++i) {
      if ((map & 0x80U >> i) == 0) continue;
      if (at == body.size() || 8 * group + i >= out.size()) return false;
      out[8 * group + i] = body[at++];
    }
  }
  return at == body.size();
}

}  // namespace reckon::bench
