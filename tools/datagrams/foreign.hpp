// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams of other protocols among those of DIS: DNS, mDNS, NTP, SSDP and whatever else uses UDP.
#pragma once

#include <string>
#include <string_view>

#include "reckon/pdu/bundle.hpp"
#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::tools {

/// The rule that marks a datagram of another protocol: a note, as nothing is wrong with it.
inline constexpr std::string_view kForeignRule = "I-FOREIGN";

/// Whether a whole datagram is no DIS of any version, by its first PDU: its length leads to no end
/// of a PDU, and either the protocol version is none of 1 to 7, or the PDU type has no name or
/// another protocol family. A damaged PDU whose version, type and family fit stays one.
[[nodiscard]] bool is_foreign(const peer::SourceDatagram& datagram, const pdu::BundledPdu& first);

/// "no PDU of any version of DIS in 64 octets; port 5353 is mDNS's".
[[nodiscard]] std::string foreign_reason(const peer::SourceDatagram& datagram);

}  // namespace reckon::tools
