// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records of varying size with a fixed head that states their length: emitter systems, environment
// records, IFF layers, standard variable records. A head is a struct with a field table and
//   WalkResult extent(octets) const   octets after the head, padding included, that belong to the
//                                     record; an error if they do not fit into `octets`
//   std::size_t claim(n)              sets its length fields for a body of about n octets without
//                                     parts; returns the octets of the body
//                                     (for test values; not for a head that is only shown)
// and, if the body has known parts, `parts(visitor, head, body)` with the signature of `fields`.
#pragma once

#include <cstddef>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/record_range.hpp"

namespace reckon::pdu {

/// One record in the datagram.
template <typename HeadType>
struct SizedRecord {
  HeadType head;
  std::span<const std::byte> body;  ///< after the head, with padding
};

/// Iterates over `count` sized records with bounds.
template <typename Head>
class SizedRecordCursor {
 public:
  SizedRecordCursor(std::size_t count, std::span<const std::byte> rest) noexcept
      : count_(count), rest_(rest) {}
  /// False at the end and at the first record that does not fit (then error() has the reason).
  [[nodiscard]] bool next(SizedRecord<Head>& out) noexcept {
    if (count_ == 0) return false;
    if (!load_record(rest_, out.head)) {
      error_ = DecodeError::count;
      return false;
    }
    const std::span<const std::byte> behind = rest_.subspan(kFixedSize<Head>);
    const WalkResult extent = out.head.extent(behind);
    if (extent.error != DecodeError::none || extent.size > behind.size()) {
      error_ = extent.error != DecodeError::none ? extent.error : DecodeError::record;
      return false;
    }
    out.body = behind.first(extent.size);
    rest_ = behind.subspan(extent.size);
    --count_;
    return true;
  }
  [[nodiscard]] DecodeError error() const noexcept { return error_; }
  [[nodiscard]] std::span<const std::byte> rest() const noexcept { return rest_; }

 private:
  std::size_t count_;
  std::span<const std::byte> rest_;
  DecodeError error_ = DecodeError::none;
};

template <typename Head>
[[nodiscard]] WalkResult walk_sized(std::size_t count, std::span<const std::byte> octets) noexcept {
  SizedRecordCursor<Head> cursor(count, octets);
  SizedRecord<Head> record;
  while (cursor.next(record)) {
  }
  return {octets.size() - cursor.rest().size(), cursor.error()};
}

/// `count` consecutive records. `for (const auto& [head, body] : view.records())`
template <typename HeadType, typename CountType>
struct SizedRecords {
  using Head = HeadType;
  CountType count = 0;
  std::span<const std::byte> bytes;

  [[nodiscard]] static WalkResult walk(std::size_t count,
                                       std::span<const std::byte> octets) noexcept {
    return walk_sized<Head>(count, octets);
  }
  [[nodiscard]] auto records() const noexcept {
    return CursorRange<SizedRecordCursor<Head>, SizedRecord<Head>>(
        SizedRecordCursor<Head>(count, bytes));
  }
};

/// Records up to the end of the PDU, which does not state their number.
template <typename HeadType>
struct SizedRecordsToEnd {
  using Head = HeadType;
  static constexpr std::size_t count = 0;
  std::span<const std::byte> bytes;

  [[nodiscard]] static WalkResult walk(std::size_t, std::span<const std::byte> octets) noexcept {
    std::span<const std::byte> rest = octets;
    while (!rest.empty()) {
      const WalkResult one = walk_sized<Head>(1, rest);
      if (one.error != DecodeError::none) return {0, DecodeError::record};
      rest = rest.subspan(one.size);
    }
    return {octets.size(), DecodeError::none};
  }
  // Each record has a head of at least one octet, so that this count is never too small. The cursor
  // ends with the octets.
  [[nodiscard]] auto records() const noexcept {
    return CursorRange<SizedRecordCursor<Head>, SizedRecord<Head>>(
        SizedRecordCursor<Head>(bytes.size(), bytes));
  }
};

template <typename View>
concept SizedView = requires {
  typename View::Head;
};

/// A head whose body has named parts.
template <typename Head, typename Visitor>
concept HasParts = requires(Visitor& visitor, const Head& head, std::span<const std::byte> body) {
  parts(visitor, head, body);
};

/// The octets after a head of `fixed` octets if the whole record has `total`.
[[nodiscard]] constexpr WalkResult behind_head(std::size_t total, std::size_t fixed) noexcept {
  if (total < fixed) return {0, DecodeError::record};
  return {total - fixed, DecodeError::none};
}

/// Extent for a head of `fixed` octets whose body has `count` sized parts. The length field, in
/// units of 4 octets, gives the body, and all parts must fit into it. If it is 0, the parts give
/// the body.
template <typename Part>
[[nodiscard]] WalkResult extent_by_parts(std::size_t length_words, std::size_t fixed,
                                         std::size_t count,
                                         std::span<const std::byte> behind) noexcept {
  if (length_words == 0) return walk_sized<Part>(count, behind);
  const WalkResult said = behind_head(length_words * 4, fixed);
  if (said.error != DecodeError::none) return said;
  if (said.size > behind.size()) return {0, DecodeError::record};
  const WalkResult parts = walk_sized<Part>(count, behind.first(said.size));
  return {said.size, parts.error};
}

[[nodiscard]] constexpr std::size_t padded_to(std::size_t octets, std::size_t boundary) noexcept {
  return (octets + boundary - 1) / boundary * boundary;
}

}  // namespace reckon::pdu
