// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Content hash of an object, and its division into blocks and chunks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/pdu/reckon/object_messages.hpp"

namespace reckon::peer {

using pdu::ObjectHash;

/// Longest object: the longest mesh file that a scene may name [octets].
inline constexpr std::uint64_t kMostObjectOctets = std::uint64_t{256} << 20;
/// Octets of a block.
inline constexpr std::size_t kBlockOctets = pdu::kChunkOctets * pdu::kChunksOfBlock;

/// BLAKE2b-256 of a block. About 1.3 ns an octet.
[[nodiscard]] ObjectHash hash_of_block(std::span<const std::byte> octets) noexcept;
/// See pdu::ObjectHash.
[[nodiscard]] ObjectHash hash_of_object(std::uint64_t size,
                                        std::span<const ObjectHash> blocks) noexcept;
/// 64 hexadecimal digits.
[[nodiscard]] std::string text_of(const ObjectHash& hash);
/// Nothing if the text is not 64 lower-case hexadecimal digits.
[[nodiscard]] std::optional<ObjectHash> parse_object_hash(std::string_view text) noexcept;
/// The first 8 octets.
[[nodiscard]] std::uint64_t key_of(const ObjectHash& hash) noexcept;

/// The chunks of an object of `size` octets: those of its hash list, then those of its data.
class ObjectLayout {
 public:
  /// @param size at most kMostObjectOctets
  explicit constexpr ObjectLayout(std::uint64_t size = 0) noexcept : size_(size) {}

  [[nodiscard]] constexpr std::uint64_t size() const noexcept { return size_; }
  [[nodiscard]] constexpr std::uint32_t blocks() const noexcept {
    return parts(size_, kBlockOctets);
  }
  /// Chunks of the hash list; the data begins at this index.
  [[nodiscard]] constexpr std::uint32_t list_chunks() const noexcept {
    return parts(list_octets(), pdu::kChunkOctets);
  }
  [[nodiscard]] constexpr std::uint32_t chunks() const noexcept {
    return list_chunks() + parts(size_, pdu::kChunkOctets);
  }
  [[nodiscard]] constexpr bool is_of_list(std::uint32_t index) const noexcept {
    return index < list_chunks();
  }
  /// Start of chunk `index` within its part [octets].
  [[nodiscard]] constexpr std::uint64_t offset(std::uint32_t index) const noexcept {
    return std::uint64_t{is_of_list(index) ? index : index - list_chunks()} * pdu::kChunkOctets;
  }
  /// Length of chunk `index` < chunks() [octets].
  [[nodiscard]] constexpr std::size_t length(std::uint32_t index) const noexcept {
    const std::uint64_t part = is_of_list(index) ? list_octets() : size_;
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(pdu::kChunkOctets, part - offset(index)));
  }
  /// Block of a chunk of the data.
  [[nodiscard]] constexpr std::uint32_t block_of(std::uint32_t index) const noexcept {
    return (index - list_chunks()) / pdu::kChunksOfBlock;
  }
  /// First chunk of a block.
  [[nodiscard]] constexpr std::uint32_t first_of(std::uint32_t block) const noexcept {
    return list_chunks() + block * static_cast<std::uint32_t>(pdu::kChunksOfBlock);
  }
  [[nodiscard]] constexpr std::size_t block_length(std::uint32_t block) const noexcept {
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(kBlockOctets, size_ - std::uint64_t{block} * kBlockOctets));
  }

 private:
  static constexpr std::uint32_t parts(std::uint64_t whole, std::uint64_t part) noexcept {
    return static_cast<std::uint32_t>((whole + part - 1) / part);
  }
  [[nodiscard]] constexpr std::uint64_t list_octets() const noexcept {
    return std::uint64_t{blocks()} * sizeof(ObjectHash);
  }

  std::uint64_t size_;
};

}  // namespace reckon::peer
