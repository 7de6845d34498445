// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/timestamp_rewrite.hpp"

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::tools {
namespace {

constexpr std::size_t kTimestampOffset = 4;  // in the header, IEEE 1278.1-2012 6.2.66

void rewrite_trailer(std::span<std::byte> octets, std::chrono::nanoseconds utc) {
  pdu::DatagramTrailer trailer;
  if (decode(octets, trailer) != pdu::DecodeError::none) return;
  trailer.send_time = pdu::trailer_time(utc);
  // A trailer of a later version is longer than the known one, and stays unchanged.
  if (wire_size(trailer) == octets.size()) (void)encode(trailer, octets);
}

}  // namespace

void rewrite_timestamps(std::span<std::byte> datagram, std::chrono::nanoseconds utc) noexcept {
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram)) {
    if (pdu.error != pdu::DecodeError::none) continue;
    const std::span<std::byte> octets = datagram.subspan(pdu.offset, pdu.bytes.size());
    const bool absolute = pdu::is_absolute(pdu.header.timestamp);
    pdu::store_big_endian(octets.data() + kTimestampOffset, pdu::to_dis_timestamp(utc, absolute));
    if (pdu.header.pdu_type == pdu::PduType::datagram_trailer) rewrite_trailer(octets, utc);
  }
}

}  // namespace reckon::tools
