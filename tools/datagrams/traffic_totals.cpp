// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/traffic_totals.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

/// Octets of headers before the UDP payload: Ethernet 14, UDP 8, IPv4 20 or IPv6 40.
constexpr std::uint64_t kHeadersV4 = 42;
constexpr std::uint64_t kHeadersV6 = 62;
constexpr double kBitsAnOctet = 8;

TrafficRates::Rates rates(std::uint64_t pdus, std::uint64_t datagrams, std::uint64_t octets,
                          double seconds) {
  if (seconds <= 0) return {};
  return {static_cast<double>(pdus) / seconds, static_cast<double>(datagrams) / seconds,
          kBitsAnOctet * static_cast<double>(octets) / seconds};
}

}  // namespace

void TrafficTotals::count(const PduRow& row) noexcept {
  ++pdus;
  if (row.status == PduStatus::error)
    ++errors;
  else
    pdu_octets += row.bytes.size();
}

void TrafficTotals::count(const peer::SourceDatagram& datagram) noexcept {
  if (datagrams++ == 0) first = last = datagram.time;
  first = std::min(first, datagram.time);
  last = std::max(last, datagram.time);
  octets += datagram.bytes.size();
  wire_octets += datagram.bytes.size() + (datagram.group.is_v6 ? kHeadersV6 : kHeadersV4);
}

double TrafficTotals::efficiency() const noexcept {
  return wire_octets == 0 ? 0 : static_cast<double>(pdu_octets) / static_cast<double>(wire_octets);
}

double TrafficTotals::pdus_per_datagram() const noexcept {
  return static_cast<double>(pdus) / std::max(1.0, static_cast<double>(datagrams));
}

double TrafficTotals::seconds() const noexcept { return pdu::to_seconds(last - first); }

TrafficRates::Rates TrafficRates::at(const TrafficTotals& totals, std::chrono::nanoseconds now) {
  const Mark mark{now, totals.pdus, totals.datagrams, totals.wire_octets};
  if (!begun_) marks_ = {mark, mark};
  begun_ = true;
  if (now - marks_[1].time >= kWindow) marks_ = {marks_[1], mark};
  const Mark& from = marks_[0];
  return rates(mark.pdus - from.pdus, mark.datagrams - from.datagrams,
               mark.wire_octets - from.wire_octets, pdu::to_seconds(now - from.time));
}

TrafficRates::Rates mean_rates(const TrafficTotals& totals) {
  return rates(totals.pdus, totals.datagrams, totals.wire_octets, totals.seconds());
}

}  // namespace reckon::tools
