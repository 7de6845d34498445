// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contents of Assured Records (PDU 150) that transfer objects, files of any length named by their
// content hash. An object is a sequence of chunks: first the hashes of its blocks, 32 octets each,
// then its octets. Every chunk is 1,280 octets long, except the last one of each of the two parts.
// A block is 64 chunks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"

namespace reckon::pdu {

/// BLAKE2b-256 of the size as 8 big-endian octets and the BLAKE2b-256 of each block.
using ObjectHash = std::array<std::uint8_t, 32>;

/// Octets of a chunk, and chunks of a block.
inline constexpr std::size_t kChunkOctets = 1280, kChunksOfBlock = 64;

/// Asks for the manifest of a scene. To all.
struct ObjectQuery {
  std::uint64_t scene_hash = 0;  ///< 0: of any scene
};
static_assert(kFixedSize<ObjectQuery> == 8);

/// The answer of a peer that has all files of the scene. To all.
struct ObjectOffer {
  std::uint64_t scene_hash = 0;
  std::uint64_t size = 0;  ///< of the manifest [octets]
  ObjectHash manifest{};
  std::uint16_t pool_size =
      0;  ///< number of groups after the base group; chunks go to the next one
  std::array<char, 30> name{};  ///< of the scene file, for people, padded with NUL
};
static_assert(kFixedSize<ObjectOffer> == 80);

/// How the rest of a request names the missing chunks.
inline constexpr std::uint8_t kMissingBits = 0;    ///< one bit for each chunk from `first` on
inline constexpr std::uint8_t kMissingRanges = 1;  ///< pairs of u32: first chunk, number of chunks
/// Bit of ObjectRequest::flags: `seen` is valid.
inline constexpr std::uint8_t kSeenKnown = 1;

/// Asks for chunks. To all, so that peers that lack the same need not ask. The missing chunks
/// follow it.
struct ObjectRequest {
  ObjectHash object{};
  std::uint64_t size = 0;    ///< of the object [octets]
  std::uint32_t server = 0;  ///< epoch of the sender of the last chunk; 0: none
  std::uint32_t seen = 0;    ///< highest serial received from it: what it sent later may arrive yet
  std::uint32_t first = 0;   ///< chunk of the first bit
  std::uint8_t form = kMissingBits;
  std::uint8_t flags = 0;  ///< kSeenKnown
  std::uint16_t padding = 0;
};
static_assert(kFixedSize<ObjectRequest> == 56);

/// What a server is about to do. To all. The sequence of its record is the server's last serial.
struct ObjectStatus {
  std::uint64_t object = 0;   ///< the first 8 octets of its hash
  std::uint32_t pending = 0;  ///< chunks that it will send; 0: it waits for requests
};
static_assert(kFixedSize<ObjectStatus> == 12);

/// One chunk; its octets follow. The sequence of its record is its serial: each sent chunk of a
/// server, of any object, has the next one.
struct ObjectChunk {
  std::uint64_t object = 0;  ///< the first 8 octets of its hash
  std::uint32_t index = 0;
};
static_assert(kFixedSize<ObjectChunk> == 12);

}  // namespace reckon::pdu
