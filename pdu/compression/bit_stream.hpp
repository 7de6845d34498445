// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of any width in bits, one behind another, the highest bit first: under the compressed
// forms of an Entity State.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::pdu {

/// Writes into octets of the caller; what does not fit is not written, and told by finish().
class BitWriter {
 public:
  explicit BitWriter(std::span<std::byte> out) noexcept : out_(out) {}

  /// The lowest `bits` of `value`, 0 .. 32.
  void put(std::uint64_t value, unsigned bits) noexcept {
    held_ = held_ << bits | (value & ((std::uint64_t{1} << bits) - 1));
    count_ += bits;
    if (count_ < 32) return;
    count_ -= 32;
    if (size_ + 4 <= out_.size()) {
      store_big_endian(out_.data() + size_, static_cast<std::uint32_t>(held_ >> count_));
    }
    size_ += 4;
  }
  /// Fills the last octet up with zeros; octets in all, or 0 where they did not fit.
  [[nodiscard]] std::size_t finish() noexcept {
    for (; count_ > 0; count_ = count_ > 8 ? count_ - 8 : 0) {
      const std::uint64_t octet = count_ >= 8 ? held_ >> (count_ - 8) : held_ << (8 - count_);
      if (size_ < out_.size()) out_[size_] = static_cast<std::byte>(octet);
      ++size_;
    }
    return size_ <= out_.size() ? size_ : 0;
  }

 private:
  std::span<std::byte> out_;
  std::size_t size_ = 0;
  std::uint64_t held_ = 0;
  unsigned count_ = 0;  // below 32 between two calls
};

/// Reads what a BitWriter wrote. Behind the end it gives zeros, and overran() says so.
class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> in) noexcept : in_(in) {}

  /// `bits` 0 .. 32.
  [[nodiscard]] std::uint32_t take(unsigned bits) noexcept {
    if (count_ < bits) refill();
    count_ -= bits;
    return static_cast<std::uint32_t>(held_ >> count_ & ((std::uint64_t{1} << bits) - 1));
  }
  /// The same as a number in two's complement.
  [[nodiscard]] std::int32_t take_signed(unsigned bits) noexcept {
    if (bits == 0) return 0;
    return static_cast<std::int32_t>(take(bits) << (32 - bits)) >> (32 - bits);
  }
  [[nodiscard]] bool overran() const noexcept { return 8 * in_.size() + count_ < 8 * at_; }
  /// Whether nothing is left but the zeros that fill the last octet up.
  [[nodiscard]] bool at_end() const noexcept {
    const std::size_t read = 8 * at_ - count_;
    return !overran() && 8 * in_.size() - read < 8;
  }

 private:
  void refill() noexcept {
    if (at_ + 4 <= in_.size()) {
      held_ = held_ << 32 | load_big_endian<std::uint32_t>(in_.data() + at_);
    } else {
      for (std::size_t i = at_; i < at_ + 4; ++i) {
        held_ = held_ << 8 | (i < in_.size() ? std::to_integer<std::uint64_t>(in_[i]) : 0);
      }
    }
    at_ += 4;
    count_ += 32;
  }

  std::span<const std::byte> in_;
  std::size_t at_ = 0;  // octets taken in, zeros behind the end included
  std::uint64_t held_ = 0;
  unsigned count_ = 0;
};

}  // namespace reckon::pdu
