// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Encoding and decoding of any PDU or record with a field table. No heap, no exceptions. The fixed
// part is checked once and then read at compile-time offsets. Variable parts are read with bounds
// and stay in the datagram as views.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/codec/decode_error.hpp"
#include "reckon/pdu/codec/field_table.hpp"
#include "reckon/pdu/codec/pdu_header.hpp"

namespace reckon::pdu {

/// A struct with a header, a type and a field table.
template <typename T>
concept Pdu = requires(T pdu) {
  { pdu.header } -> std::same_as<PduHeader&>;
  { T::kPduType } -> std::convertible_to<PduType>;
  { T::kProtocolFamily } -> std::convertible_to<ProtocolFamily>;
};

/// Octets of a number, an array of octets or a record.
template <typename T>
inline constexpr std::size_t kWireSize = [] {
  FixedSize size;
  size({}, T{});
  return size.size();
}();

/// Visitor that reads. The caller has checked the size of the fixed part.
class Decoder {
 public:
  explicit Decoder(std::span<const std::byte> octets) noexcept
      : cursor_(octets.data()), end_(octets.data() + octets.size()) {}

  template <typename T>
  [[gnu::always_inline]] void operator()(std::string_view, T& value) noexcept {
    if constexpr (Scalar<T>) {
      value = load_big_endian<T>(take(sizeof(T)));
    } else if constexpr (kIsStdArray<T>) {
      std::memcpy(value.data(), take(value.size()), value.size());
    } else {
      fields(*this, value);
    }
  }
  // Takes the count n of records. Their octets are reserved here, and checked and located by
  // records().
  template <typename Record, typename Count>
  [[gnu::always_inline]] void count(std::string_view, std::span<const std::byte>& view,
                                    Records<Record, Count>) noexcept {
    view = {cursor_, load_big_endian<Count>(cursor_) * kFixedSize<Record>};
    take(sizeof(Count));
  }
  template <typename Record, typename Count>
  [[gnu::always_inline]] void records(std::string_view, std::span<const std::byte>& view,
                                      Records<Record, Count>) noexcept {
    const std::size_t size = view.size();
    if (size > left()) return fail(DecodeError::count);
    view = {take(size), size};
  }
  template <typename View>
  void walked(std::string_view, View& view) noexcept {
    const WalkResult result = View::walk(view.count, {cursor_, left()});
    if (result.error != DecodeError::none) return fail(result.error);
    view.bytes = {take(result.size), result.size};
  }
  template <typename T>
  void when(bool present, std::string_view name, T& value) noexcept {
    value = T{};
    if (!present) return;
    if (kWireSize < T >> left()) return fail(DecodeError::count);
    (*this)(name, value);
  }

  [[nodiscard]] DecodeError error() const noexcept { return error_; }

 private:
  [[nodiscard]] std::size_t left() const noexcept {
    return static_cast<std::size_t>(end_ - cursor_);
  }
  [[gnu::always_inline]] const std::byte* take(std::size_t size) noexcept {
    const std::byte* at = cursor_;
    cursor_ += size;
    return at;
  }
  void fail(DecodeError error) noexcept {
    if (error_ == DecodeError::none) error_ = error;
    cursor_ = end_;
  }

  const std::byte* cursor_;
  const std::byte* end_;
  DecodeError error_ = DecodeError::none;
};

/// Visitor that adds up the octets of a PDU with its variable parts, and checks that counts and
/// lengths fit into their fields.
class WireSize {
 public:
  [[gnu::always_inline]] void operator()(std::string_view, const auto&) noexcept {}
  template <typename Record, typename Count>
  [[gnu::always_inline]] void count(std::string_view, std::span<const std::byte> view,
                                    Records<Record, Count>) noexcept {
    const std::size_t size = kFixedSize<Record>;
    encodable_ = encodable_ && view.size() % size == 0 &&
                 view.size() / size <= std::numeric_limits<Count>::max();
  }
  template <typename Record, typename Count>
  [[gnu::always_inline]] void records(std::string_view, std::span<const std::byte> view,
                                      Records<Record, Count>) noexcept {
    variable_ += view.size();
  }
  [[gnu::always_inline]] void walked(std::string_view, const auto& view) noexcept {
    variable_ += view.bytes.size();
  }
  template <typename T>
  [[gnu::always_inline]] void when(bool present, std::string_view, const T&) noexcept {
    if (present) variable_ += kWireSize<T>;
  }

  [[nodiscard]] std::size_t variable() const noexcept { return variable_; }
  [[nodiscard]] bool encodable() const noexcept { return encodable_; }

 private:
  std::size_t variable_ = 0;
  bool encodable_ = true;
};

/// Visitor that writes. The caller has checked that all octets fit.
class Encoder {
 public:
  explicit Encoder(std::byte* to) noexcept : cursor_(to) {}

  template <typename T>
  [[gnu::always_inline]] void operator()(std::string_view, const T& value) noexcept {
    if constexpr (Scalar<T>) {
      store_big_endian(take(sizeof(T)), value);
    } else if constexpr (kIsStdArray<T>) {
      std::memcpy(take(value.size()), value.data(), value.size());
    } else {
      fields(*this, value);
    }
  }
  template <typename Record, typename Count>
  [[gnu::always_inline]] void count(std::string_view, std::span<const std::byte> view,
                                    Records<Record, Count>) noexcept {
    store_big_endian(take(sizeof(Count)), static_cast<Count>(view.size() / kFixedSize<Record>));
  }
  template <typename Record, typename Count>
  [[gnu::always_inline]] void records(std::string_view, std::span<const std::byte> view,
                                      Records<Record, Count>) noexcept {
    copy(view);
  }
  [[gnu::always_inline]] void walked(std::string_view, const auto& view) noexcept {
    copy(view.bytes);
  }

 private:
  [[gnu::always_inline]] std::byte* take(std::size_t size) noexcept {
    std::byte* at = cursor_;
    cursor_ += size;
    return at;
  }
  void copy(std::span<const std::byte> octets) noexcept {
    if (!octets.empty()) std::memcpy(take(octets.size()), octets.data(), octets.size());
  }

  std::byte* cursor_;
};

/// A visitor that only inspects a PDU (prints it, searches it). It may receive the records of a
/// part that is encoded and decoded as octets.
template <typename Visitor, typename Pdu>
concept Looks = std::is_const_v<Pdu> && !std::same_as<Visitor, FixedSize> &&
                !std::same_as<Visitor, WireSize> && !std::same_as<Visitor, Encoder>;

/// Octets of `pdu` on the wire, as in its length field.
template <Pdu T>
[[nodiscard]] std::size_t wire_size(const T& pdu) noexcept {
  WireSize size;
  fields(size, pdu);
  return kFixedSize<T> + size.variable();
}

/// Reads exactly one PDU from the start of `bytes`, which may be longer. Views in `out` point into
/// `bytes`. Octets within the length field but beyond all fields are skipped, because a later
/// revision may add fields at the end; trailing_octets() gives them. On an error `out` is reset.
/// About 5 ns for an Entity State.
template <Pdu T>
[[nodiscard]] DecodeError decode(std::span<const std::byte> bytes, T& out) noexcept {
  DecodeError error = check_header(bytes);
  if (error == DecodeError::none) {
    const auto length = load_big_endian<std::uint16_t>(bytes.data() + 8);
    if (load_big_endian<PduType>(bytes.data() + 2) != T::kPduType) {
      error = DecodeError::pdu_type;
    } else if (length < kFixedSize<T>) {
      error = DecodeError::length;
    } else {
      Decoder decoder(bytes.first(length));
      fields(decoder, out);
      error = decoder.error();
    }
  }
  if (error != DecodeError::none) [[unlikely]] {
    out = T{};
  }
  return error;
}

/// The octets of a PDU behind its last field, which decode() skips and encode() does not write.
/// Empty unless a sender adds octets of its own, or a count or length in the PDU is too small.
///
///   if (decode(bytes, pdu) == DecodeError::none && !trailing_octets(bytes, pdu).empty()) warn();
///
/// @param bytes from which `pdu` was decoded; the result points into them. About 1 ns.
[[nodiscard]] std::span<const std::byte> trailing_octets(std::span<const std::byte> bytes,
                                                         const Pdu auto& pdu) noexcept {
  const auto whole = bytes.first(std::min<std::size_t>(bytes.size(), pdu.header.length));
  return whole.subspan(std::min(whole.size(), wire_size(pdu)));
}

/// Writes one PDU and sets length, type and family in its octets. Returns the octets written.
/// Returns 0, with nothing written, if they do not fit into `out` or exceed 65535, or if a block of
/// records is not a whole number of records or exceeds its count field.
template <Pdu T>
[[nodiscard]] std::size_t encode(const T& pdu, std::span<std::byte> out) noexcept {
  WireSize size;
  fields(size, pdu);
  const std::size_t total = kFixedSize<T> + size.variable();
  if (!size.encodable() || total > out.size() || total > kMaxPduSize) return 0;
  Encoder encoder(out.data());
  fields(encoder, pdu);
  store_big_endian(out.data() + 2, T::kPduType);
  store_big_endian(out.data() + 3, T::kProtocolFamily);
  store_big_endian(out.data() + 8, static_cast<std::uint16_t>(total));
  return total;
}

/// Reads a record of fixed size from the start of `bytes`; false if there are too few octets.
template <typename Record>
[[nodiscard]] bool load_record(std::span<const std::byte> bytes, Record& out) noexcept {
  if (bytes.size() < kFixedSize<Record>) return false;
  Decoder decoder(bytes);
  fields(decoder, out);
  return true;
}

/// Writes a record of fixed size at the start of `out`; returns its octets, 0 if it does not fit.
template <typename Record>
[[nodiscard]] std::size_t store_record(const Record& record, std::span<std::byte> out) noexcept {
  if (out.size() < kFixedSize<Record>) return 0;
  Encoder encoder(out.data());
  fields(encoder, record);
  return kFixedSize<Record>;
}

}  // namespace reckon::pdu
