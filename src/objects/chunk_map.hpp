// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A set of chunks of one object.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace reckon::peer {

/// One bit for each chunk. Allocates at construction.
class ChunkMap {
 public:
  explicit ChunkMap(std::uint32_t chunks = 0) : words_((chunks + 63) / 64), chunks_(chunks) {}

  /// Number of chunks, in the set or not.
  [[nodiscard]] std::uint32_t chunks() const noexcept { return chunks_; }
  /// Number of chunks in the set.
  [[nodiscard]] std::uint32_t count() const noexcept { return count_; }
  /// @param index of these three less than chunks()
  [[nodiscard]] bool has(std::uint32_t index) const noexcept {
    return (words_[index / 64] >> (index % 64) & 1) != 0;
  }
  void add(std::uint32_t index) noexcept { set(index, true); }
  void remove(std::uint32_t index) noexcept { set(index, false); }

  /// The first chunk at or after `from` that is in the set (`wanted`) or not; chunks() if none is.
  [[nodiscard]] std::uint32_t next(std::uint32_t from, bool wanted) const noexcept {
    for (std::uint32_t word = from / 64; from < chunks_; from = 64 * ++word) {
      const std::uint64_t bits = (wanted ? words_[word] : ~words_[word]) >> (from % 64);
      if (bits == 0) continue;
      const std::uint32_t found = from + static_cast<std::uint32_t>(std::countr_zero(bits));
      return found < chunks_ ? found : chunks_;
    }
    return chunks_;
  }

  /// Its bits, to store them.
  [[nodiscard]] std::span<const std::uint64_t> words() const noexcept { return words_; }

 private:
  void set(std::uint32_t index, bool is_in) noexcept {
    if (has(index) == is_in) return;
    words_[index / 64] ^= std::uint64_t{1} << (index % 64);
    count_ += is_in ? 1 : -1;
  }

  std::vector<std::uint64_t> words_;
  std::uint32_t chunks_;
  std::uint32_t count_ = 0;
};

}  // namespace reckon::peer
