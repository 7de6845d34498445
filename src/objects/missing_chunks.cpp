// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/missing_chunks.hpp"

namespace reckon::peer {
namespace {

struct Written {
  std::size_t octets = 0;
  std::uint32_t end = 0;  // chunks before it are named, if they are missing
};

Written store_ranges(const ChunkMap& received, std::uint32_t first,
                     std::span<std::byte> room) noexcept {
  Written written{0, first};
  while (first < received.chunks() && written.octets + 8 <= room.size()) {
    const std::uint32_t end = received.next(first, true);
    pdu::store_big_endian(room.data() + written.octets, first);
    pdu::store_big_endian(room.data() + written.octets + 4, end - first);
    written.octets += 8;
    first = end < received.chunks() ? received.next(end, false) : end;
    written.end = first;
  }
  return written;
}

Written bits_of(const ChunkMap& received, std::uint32_t first, std::size_t room) noexcept {
  const auto end = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(received.chunks(), std::uint64_t{first} + 8 * room));
  std::uint32_t last = first;
  for (std::uint32_t i = first; i < end; i = received.next(i + 1, false)) last = i;
  return {(last - first) / 8 + 1, end};
}

void store_bits(const ChunkMap& received, std::uint32_t first, std::span<std::byte> room) noexcept {
  std::ranges::fill(room, std::byte{0});
  const std::uint64_t end = std::uint64_t{first} + 8 * room.size();
  for (std::uint32_t i = first; i < received.chunks() && i < end; i = received.next(i + 1, false))
    room[(i - first) / 8] |= static_cast<std::byte>(1U << ((i - first) % 8));
}

}  // namespace

std::size_t store_missing(const ChunkMap& received, std::uint32_t from, pdu::ObjectRequest& request,
                          std::span<std::byte> room, std::uint32_t& end) noexcept {
  const std::uint32_t first = from < received.chunks() ? received.next(from, false) : from;
  end = received.chunks();
  if (first >= received.chunks()) return 0;
  request.first = first;
  const Written ranges = store_ranges(received, first, room);
  const Written bits = bits_of(received, first, room.size());
  const bool takes_bits =
      bits.end > ranges.end || (bits.end == ranges.end && bits.octets < ranges.octets);
  request.form = takes_bits ? pdu::kMissingBits : pdu::kMissingRanges;
  if (takes_bits) store_bits(received, first, room.first(bits.octets));
  end = takes_bits ? bits.end : ranges.end;
  return takes_bits ? bits.octets : ranges.octets;
}

}  // namespace reckon::peer
