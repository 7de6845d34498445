// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Consecutive numbers of any width in bits, highest bit first. Used by the compressed forms of an
// Entity State.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::pdu {

/// Greatest width at which three numbers are written and read at once.
inline constexpr unsigned kThreeTogether = 18;

/// Writes into octets of the caller. Data that do not fit are not written, and finish() reports it.
class BitWriter {
 public:
  explicit BitWriter(std::span<std::byte> out) noexcept : out_(out) {}

  /// Writes the lowest `bits` of `value`, 0 .. 56. Without a branch if 8 octets of room are left.
  void put(std::uint64_t value, unsigned bits) noexcept {
    const unsigned count = count_ + bits;
    held_ |= (value & ((std::uint64_t{1} << bits) - 1)) << (63 - count) << 1;
    if (size_ + 8 <= out_.size()) [[likely]] {
      store_big_endian(out_.data() + size_, held_);
    } else {
      store_octets();
    }
    size_ += count / 8;
    held_ <<= count / 8 * 8;
    count_ = count % 8;
  }
  /// Writes the lowest `bits` of each, 0 .. 56.
  void put_three(const std::array<std::uint64_t, 3>& values, unsigned bits) noexcept {
    if (bits > kThreeTogether) [[unlikely]] {
      for (const std::uint64_t value : values) put(value, bits);
      return;
    }
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    put(((values[0] & mask) << bits | (values[1] & mask)) << bits | (values[2] & mask), 3 * bits);
  }
  /// Fills the last octet with zeros. Returns the number of octets, or 0 if they did not fit.
  [[nodiscard]] std::size_t finish() const noexcept {
    const std::size_t size = size_ + (count_ > 0 ? 1 : 0);
    return size <= out_.size() ? size : 0;
  }

 private:
  void store_octets() noexcept {
    for (std::size_t i = 0; i < 8 && size_ + i < out_.size(); ++i) {
      out_[size_ + i] = static_cast<std::byte>(held_ >> (56 - 8 * i));
    }
  }

  std::span<std::byte> out_;
  std::size_t size_ = 0;    // whole octets
  std::uint64_t held_ = 0;  // the bits after them, highest first
  unsigned count_ = 0;      // number of bits held, below 8
};

/// Reads the output of a BitWriter. Beyond the end it returns zeros, and overran() is true.
class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> in) noexcept
      : in_(in), last_(std::max(in.size(), few_.size()) - few_.size()) {
    if (in.size() < few_.size()) std::ranges::copy(in, few_.begin());
  }

  /// Reads `bits` 0 .. 32.
  [[nodiscard]] std::uint32_t take(unsigned bits) noexcept {
    return static_cast<std::uint32_t>(take_wide(bits));
  }
  /// The same, `bits` 0 .. 56.
  [[nodiscard]] std::uint64_t take_wide(unsigned bits) noexcept {
    const std::uint64_t word = octets_at(at_ / 8) << at_ % 8;
    at_ += bits;
    return word >> 1 >> (63 - bits);
  }
  /// Reads three numbers into their lowest bits, `bits` 0 .. 56 of each; the bits above are
  /// undefined.
  [[nodiscard]] std::array<std::uint64_t, 3> take_three(unsigned bits) noexcept {
    if (bits > kThreeTogether) [[unlikely]] {
      const std::uint64_t first = take_wide(bits), second = take_wide(bits);
      return {first, second, take_wide(bits)};
    }
    const std::uint64_t all = take_wide(3 * bits);
    return {all >> 2 * bits, all >> bits, all};
  }
  /// The same as a number in two's complement, `bits` 0 .. 32.
  [[nodiscard]] std::int32_t take_signed(unsigned bits) noexcept {
    const auto half = static_cast<std::uint32_t>(std::uint64_t{1} << bits >> 1);
    return static_cast<std::int32_t>((take(bits) ^ half) - half);
  }
  [[nodiscard]] bool overran() const noexcept { return at_ > 8 * in_.size(); }
  /// Whether only the zeros that fill the last octet are left.
  [[nodiscard]] bool at_end() const noexcept { return !overran() && 8 * in_.size() - at_ < 8; }

 private:
  // The 8 octets from there; zeros beyond the end.
  [[nodiscard]] std::uint64_t octets_at(std::size_t octet) const noexcept {
    const std::byte* octets = in_.size() < few_.size() ? few_.data() : in_.data();
    const std::size_t from = std::min(octet, last_);
    const std::size_t beyond = octet - from;
    return beyond < 8 ? load_big_endian<std::uint64_t>(octets + from) << 8 * beyond : 0;
  }

  std::span<const std::byte> in_;
  std::array<std::byte, 8> few_{};  // all octets, if there are fewer than 8
  std::size_t last_;                // begin of the last 8 octets
  std::size_t at_ = 0;              // bits read, including those beyond the end
};

}  // namespace reckon::pdu
