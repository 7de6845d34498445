// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where exactly a PDU is broken: the codec says only which rule, this says which field, octet and
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
  std::size_t offset = 0;  ///< of the field at fault, from the PDU's first octet
  std::string reason;      ///< a clause without full stop: "entity_location.x is NaN"
};

/// Says what `error`, found in the octets of one PDU (all that is left of the datagram where its
/// length cannot be trusted), is about. `header` as far as it could be read.
[[nodiscard]] PduFault explain_fault(std::span<const std::byte> octets,
                                     const pdu::PduHeader& header, pdu::DecodeError error);

/// Says which field of a PDU that decodes is NaN or infinite; `field` is what
/// pdu::first_not_finite() named.
[[nodiscard]] PduFault explain_not_finite(std::span<const std::byte> octets,
                                          const pdu::PduHeader& header, std::string_view field);

/// Looks for records of ours in an Attribute PDU, decoded from `octets`, that cannot be read.
/// `none` where all can; then it allocates nothing.
[[nodiscard]] PduFault examine_records(std::span<const std::byte> octets,
                                       const pdu::Attribute& attribute);

}  // namespace reckon::tools
