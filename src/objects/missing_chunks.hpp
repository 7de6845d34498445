// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The missing chunks of a request on the wire: bits or ranges, whichever names more chunks in the
// room of one datagram.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/reckon/object_messages.hpp"
#include "reckon/peer/objects/chunk_map.hpp"

namespace reckon::peer {

/// Names the chunks that are not in `received`, from chunk `from` on. Sets first and form.
/// @param from less than chunks(), or 0  @param room at least 8 octets  @param end set to the first
/// chunk after those that the request covers
/// @return octets written to `room`; 0 if none is missing from there on
[[nodiscard]] std::size_t store_missing(const ChunkMap& received, std::uint32_t from,
                                        pdu::ObjectRequest& request, std::span<std::byte> room,
                                        std::uint32_t& end) noexcept;

/// Calls visit(first, count) for each range that a request names, within an object of `chunks`.
/// Ranges have to ascend; it stops at the first that does not.
void for_each_missing(const pdu::ObjectRequest& request, std::span<const std::byte> octets,
                      std::uint32_t chunks, auto&& visit) noexcept {
  if (request.form == pdu::kMissingRanges) {
    std::uint32_t end = 0;
    for (; octets.size() >= 8; octets = octets.subspan(8)) {
      const auto first = pdu::load_big_endian<std::uint32_t>(octets.data());
      const auto count = pdu::load_big_endian<std::uint32_t>(octets.data() + 4);
      if (first < end || first >= chunks) return;
      end = first + std::min(count, chunks - first);
      visit(first, end - first);
    }
    return;
  }
  if (request.form != pdu::kMissingBits) return;
  for (std::size_t i = 0; i < 8 * octets.size(); ++i) {
    const std::uint64_t index = std::uint64_t{request.first} + i;
    if (index >= chunks) return;
    if ((static_cast<unsigned>(octets[i / 8]) >> (i % 8) & 1) != 0)
      visit(static_cast<std::uint32_t>(index), std::uint32_t{1});
  }
}

}  // namespace reckon::peer
