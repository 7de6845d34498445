// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Detects datagrams of other protocols: DNS, mDNS, NTP, SSDP and others that use UDP.
#pragma once

#include <string>
#include <string_view>

#include "reckon/pdu/bundle.hpp"
#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::tools {

/// The rule for a datagram of another protocol: a note, as it is no fault.
inline constexpr std::string_view kForeignRule = "I-FOREIGN";

/// Whether a whole datagram is no DIS of any version, judged by its first PDU: its length is wrong,
/// and either the protocol version is none of 1 to 7, or the PDU type is unknown or of another
/// protocol family. A damaged PDU with plausible version, type and family counts as DIS.
[[nodiscard]] bool is_foreign(const peer::SourceDatagram& datagram, const pdu::BundledPdu& first);

/// "no PDU of any version of DIS in 64 octets; port 5353 is mDNS's".
[[nodiscard]] std::string foreign_reason(const peer::SourceDatagram& datagram);

}  // namespace reckon::tools
