// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/incoming_datagram.hpp"

#include "reckon/pdu/bundle.hpp"

namespace reckon::aoim {

std::optional<pdu::DatagramTrailer> trailer_of(std::span<const std::byte> datagram) noexcept {
  if (datagram.size() < pdu::kDatagramTrailerSize) return {};
  pdu::DatagramTrailer trailer;
  const auto error = pdu::decode(datagram.last(pdu::kDatagramTrailerSize), trailer);
  const bool whole = trailer.header.length == pdu::kDatagramTrailerSize;
  if (error != pdu::DecodeError::none || !whole) return {};
  return trailer;
}

bool announces_another_exercise(std::span<const std::byte> datagram,
                                std::uint8_t exercise) noexcept {
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    const bool announces = bundled.error == pdu::DecodeError::none &&
                           bundled.header.pdu_type == pdu::PduType::presence;
    if (announces && bundled.header.exercise_id != exercise) return true;
  }
  return false;
}

}  // namespace reckon::aoim
