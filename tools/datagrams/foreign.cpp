// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/foreign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "reckon/pdu/pdu_types.hpp"

namespace reckon::tools {
namespace {

constexpr unsigned kOldestDis = 1;

struct KnownPort {
  std::uint16_t port;
  std::string_view protocol;
};
constexpr std::array kKnownPorts{
    KnownPort{53, "DNS"},     KnownPort{67, "DHCP"},     KnownPort{68, "DHCP"},
    KnownPort{123, "NTP"},    KnownPort{137, "NetBIOS"}, KnownPort{138, "NetBIOS"},
    KnownPort{161, "SNMP"},   KnownPort{319, "PTP"},     KnownPort{320, "PTP"},
    KnownPort{514, "syslog"}, KnownPort{1900, "SSDP"},   KnownPort{3702, "WS-Discovery"},
    KnownPort{5353, "mDNS"},  KnownPort{5355, "LLMNR"}};

/// Whether the standard, or this project, defines this PDU type in this family.
template <typename... T>
bool is_type_of_family(const pdu::PduHeader& header, pdu::TypeList<T...>) {
  return ((T::kPduType == header.pdu_type && T::kProtocolFamily == header.protocol_family) || ...);
}

}  // namespace

bool is_foreign(const peer::SourceDatagram& datagram, const pdu::BundledPdu& first) {
  if (datagram.portion != peer::Portion::whole || first.bytes.empty()) return false;
  const auto version = std::to_integer<unsigned>(first.bytes[0]);
  const bool is_version = version >= kOldestDis && version <= pdu::kProtocolVersion;
  // A truncated header has too little information.
  if (first.bytes.size() < pdu::kHeaderSize) return !is_version;
  const bool is_credible = first.header.length == first.bytes.size() && first.header.length > 0;
  if (is_credible) return false;
  return !is_version || !is_type_of_family(first.header, pdu::PduTypes{});
}

std::string foreign_reason(const peer::SourceDatagram& datagram) {
  const auto is_used = [&](const KnownPort& known) {
    return known.port == datagram.source.port || known.port == datagram.group.port;
  };
  const auto* known = std::find_if(kKnownPorts.begin(), kKnownPorts.end(), is_used);
  const std::string port =
      known == kKnownPorts.end()
          ? std::string()
          : fmt::format("; port {} is registered for {}", known->port, known->protocol);
  return fmt::format("no DIS PDU in {} octets{}", datagram.bytes.size(), port);
}

}  // namespace reckon::tools
