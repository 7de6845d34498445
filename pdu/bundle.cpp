// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "pdu/bundle.hpp"

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

// Some senders start every PDU at a multiple of 8 octets; the octets between are zero, and no PDU
// starts with a zero octet, so that nothing is lost by stepping over them.
void BundleCursor::skip_padding() noexcept {
  const std::size_t boundary = std::min((offset_ + 7) / 8 * 8, datagram_.size());
  const auto padding = datagram_.subspan(offset_, boundary - offset_);
  if (std::ranges::all_of(padding, [](std::byte octet) { return octet == std::byte{0}; }))
    offset_ = boundary;
}

bool BundleCursor::next(BundledPdu& out) noexcept {
  skip_padding();
  const std::span<const std::byte> rest = datagram_.subspan(offset_);
  const bool first = index_ == 0;
  if (rest.empty() && !first) return false;

  out.offset = offset_;
  out.index = index_++;
  out.error = decode_header(rest, out.header);
  const bool whole = rest.size() >= kHeaderSize && out.header.length >= kHeaderSize &&
                     out.header.length <= rest.size();
  if (whole) {
    out.bytes = rest.first(out.header.length);
  } else {
    // Without a length to trust there is no next PDU to step to.
    out.bytes = rest;
    const bool starts_like_a_pdu =
        !rest.empty() && is_supported_version(std::to_integer<std::uint8_t>(rest[0]));
    if (!first && !starts_like_a_pdu) out.error = DecodeError::stray;
  }
  offset_ += out.bytes.size();
  return true;
}

}  // namespace reckon::pdu
