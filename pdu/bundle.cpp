// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/bundle.hpp"

#include <algorithm>

namespace reckon::pdu {

bool BundleWriter::append_raw(std::span<const std::byte> pdu) noexcept {
  PduHeader header;
  if (decode_header(pdu, header) != DecodeError::none || header.length != pdu.size()) return false;
  if (!accepts(header.pdu_type, pdu.size())) return false;
  std::copy(pdu.begin(), pdu.end(), buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
  accept(header.pdu_type, pdu.size());
  return true;
}

// Some senders start every PDU at a multiple of 8 octets, with zero octets in between. No PDU
// starts with a zero octet, so that nothing is lost if they are skipped.
std::size_t BundleCursor::behind_padding(std::size_t offset) const noexcept {
  const std::size_t boundary = std::min((offset + 7) / 8 * 8, datagram_.size());
  const auto padding = datagram_.subspan(offset, boundary - offset);
  const bool zero =
      std::ranges::all_of(padding, [](std::byte octet) { return octet == std::byte{0}; });
  return zero ? boundary : offset;
}

// A length that fits is accepted. Octets of an unsupported version may not be a PDU at all. Their
// length must therefore also lead to a possible PDU: the end, a supported version, or the same
// version.
bool BundleCursor::is_credible(const PduHeader& header) const noexcept {
  const std::size_t left = datagram_.size() - offset_;
  if (left < kHeaderSize || header.length < kHeaderSize || header.length > left) return false;
  if (is_supported_version(header.protocol_version)) return true;
  const std::size_t next = behind_padding(offset_ + header.length);
  if (next == datagram_.size()) return true;
  const auto version = std::to_integer<std::uint8_t>(datagram_[next]);
  return is_supported_version(version) || version == header.protocol_version;
}

bool BundleCursor::next(BundledPdu& out) noexcept {
  offset_ = behind_padding(offset_);
  const std::span<const std::byte> rest = datagram_.subspan(offset_);
  const bool first = index_ == 0;
  if (rest.empty() && !first) return false;

  out.offset = offset_;
  out.index = index_++;
  out.error = decode_header(rest, out.header);
  if (is_credible(out.header)) {
    out.bytes = rest.first(out.header.length);
  } else {
    // Without a credible length there is no next PDU.
    out.bytes = rest;
    const bool starts_like_a_pdu =
        !rest.empty() && is_supported_version(std::to_integer<std::uint8_t>(rest[0]));
    if (!first && !starts_like_a_pdu) out.error = DecodeError::stray;
  }
  offset_ += out.bytes.size();
  return true;
}

}  // namespace reckon::pdu
