// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exact place of a fault in a PDU. The codec only reports the rule; this finds the field, octet and
// number.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "reckon/pdu/codec/decode_error.hpp"
#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/pdu/entity/attribute.hpp"

namespace reckon::tools {

/// One fault of one PDU.
struct PduFault {
  pdu::DecodeError error = pdu::DecodeError::none;
  std::size_t offset = 0;  ///< of the faulty field, from the PDU's first octet
  std::string reason;      ///< a clause without full stop: "entity_location.x is NaN"
};

/// Explains `error` in the octets of one PDU, or in the whole rest of the datagram if the length is
/// not credible. `header` as far as it was readable.
[[nodiscard]] PduFault explain_fault(std::span<const std::byte> octets,
                                     const pdu::PduHeader& header, pdu::DecodeError error);

/// E-LENGTH for a PDU that fills all of `octets`, ignoring its length field.
[[nodiscard]] PduFault explain_shortness(std::span<const std::byte> octets,
                                         const pdu::PduHeader& header);

/// Whether an invalid length field is valid with its two octets exchanged, as a little-endian
/// sender writes it. `error` and `octets` as in explain_fault().
[[nodiscard]] bool has_exchanged_length(std::span<const std::byte> octets,
                                        const pdu::PduHeader& header, pdu::DecodeError error);

/// Finds the field of a decoded PDU that is NaN or infinite; `field` is the result of
/// pdu::first_not_finite().
[[nodiscard]] PduFault explain_not_finite(std::span<const std::byte> octets,
                                          const pdu::PduHeader& header, std::string_view field);

/// Searches an Attribute PDU, decoded from `octets`, for records of ours that cannot be read.
/// `none`, without allocation, if all can be read.
[[nodiscard]] PduFault examine_records(std::span<const std::byte> octets,
                                       const pdu::Attribute& attribute);

}  // namespace reckon::tools
