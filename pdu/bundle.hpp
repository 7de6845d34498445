// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bundles: several whole PDUs in one datagram. The writer keeps the order that older receivers
// tolerate. The reader steps by length fields. A damaged PDU with a credible length does not hide
// the PDUs after it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/decode_error.hpp"
#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/pdu/codec/record_range.hpp"

namespace reckon::pdu {

/// Place of a PDU type in a bundle: Entity State 0, other standard types 1, Attribute 2,
/// experimental 3, datagram trailer 4; a unicast frame precedes all. Ranks never decrease within a
/// bundle.
[[nodiscard]] constexpr std::uint8_t bundle_rank(PduType type) noexcept {
  if (type == PduType::entity_state || type == PduType::unicast_frame) return 0;
  if (type == PduType::attribute) return 2;
  if (type == PduType::datagram_trailer) return 4;
  return is_experimental(type) ? 3 : 1;
}

/// Appends PDUs to the caller's buffer, whose size is the limit of the datagram. A call that
/// returns false has changed nothing. No heap; one thread.
class BundleWriter {
 public:
  explicit BundleWriter(std::span<std::byte> buffer) noexcept : buffer_(buffer) {}

  /// Encodes `pdu` at the end. False if it does not fit, would break the order, or follows a
  /// trailer.
  template <Pdu T>
  [[nodiscard]] bool append(const T& pdu) noexcept {
    if (!in_order(T::kPduType)) return false;
    const std::size_t written = encode(pdu, buffer_.subspan(size_));
    if (written == 0) return false;
    accept(T::kPduType, written);
    return true;
  }
  /// Copies one encoded PDU. Also false if `pdu` is not exactly one PDU by its length field.
  [[nodiscard]] bool append_raw(std::span<const std::byte> pdu) noexcept;

  /// Whether a PDU of this type and size would be accepted.
  [[nodiscard]] bool accepts(PduType type, std::size_t octets) const noexcept {
    return in_order(type) && octets <= left();
  }
  [[nodiscard]] bool in_order(PduType type) const noexcept {
    return bundle_rank(type) >= rank_ && rank_ < bundle_rank(PduType::datagram_trailer);
  }

  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return buffer_.first(size_); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t left() const noexcept { return buffer_.size() - size_; }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  /// Starts the next bundle in the same buffer.
  void clear() noexcept { size_ = count_ = rank_ = 0; }

 private:
  void accept(PduType type, std::size_t octets) noexcept {
    size_ += octets;
    ++count_;
    rank_ = bundle_rank(type);
  }

  std::span<std::byte> buffer_;
  std::size_t size_ = 0;
  std::size_t count_ = 0;
  std::uint8_t rank_ = 0;
};

/// One PDU in a datagram.
struct BundledPdu {
  PduHeader header;                  ///< as far as it was readable
  std::span<const std::byte> bytes;  ///< the PDU by its length field; the whole rest if damaged
  std::size_t offset = 0;            ///< of its first octet in the datagram
  std::size_t index = 0;             ///< 0 for the first PDU
  /// none, or version (skipped by its length), or truncated, length, stray (nothing follows).
  DecodeError error = DecodeError::none;
};

/// Iterates over a datagram. It does not check bodies: decode() or visit() does.
class BundleCursor {
 public:
  explicit BundleCursor(std::span<const std::byte> datagram) noexcept : datagram_(datagram) {}
  [[nodiscard]] bool next(BundledPdu& out) noexcept;

 private:
  /// Next place to read from `offset`: after zero octets up to the next multiple of 8.
  [[nodiscard]] std::size_t behind_padding(std::size_t offset) const noexcept;
  /// Whether the length in `header`, at offset_, leads to the next PDU.
  [[nodiscard]] bool is_credible(const PduHeader& header) const noexcept;

  std::span<const std::byte> datagram_;
  std::size_t offset_ = 0;
  std::size_t index_ = 0;
};

/// `for (const BundledPdu& pdu : BundleReader(datagram))`. Zero octets up to the next multiple of 8
/// are accepted between PDUs and at the end. An empty datagram gives one truncated entry, because a
/// header is missing: every reader sees at least one entry.
class BundleReader : public CursorRange<BundleCursor, BundledPdu> {
 public:
  explicit BundleReader(std::span<const std::byte> datagram) noexcept
      : CursorRange(BundleCursor(datagram)) {}
};

}  // namespace reckon::pdu
