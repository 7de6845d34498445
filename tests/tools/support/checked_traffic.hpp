// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A truck's traffic for `reckon inspect check`, faults in it, and the findings of the check.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools::checks {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::append_pdu;
using test::CaptureBuilder;
using test::Octets;
using test::run_reckon;

inline constexpr nanoseconds kStart = seconds(1'700'000'000);

/// Truck 1:2:3 on the ground at latitude 0, driving at 10 m/s, `t` after the start.
inline pdu::EntityState truck(nanoseconds t) {
  pdu::EntityState pdu;
  pdu.header.timestamp = pdu::to_dis_timestamp(kStart + t, true);
  pdu.entity_id = {1, 2, 3};
  pdu.force_id = pdu::ForceId::friendly;
  pdu.entity_type.kind = pdu::EntityKind::platform;
  pdu.entity_type.domain = pdu::EntityDomain::land;
  pdu.location = {6378137.0, 10.0 * std::chrono::duration<double>(t).count(), 0.0};
  pdu.linear_velocity = {0, 10, 0};
  pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  return pdu;
}

/// The datagram of one PDU.
inline Octets datagram_of(const pdu::EntityState& pdu) {
  Octets datagram;
  append_pdu(datagram, pdu);
  return datagram;
}

/// An Attribute PDU of truck 1:2:3 with a force model.
inline Octets attribute() {
  std::array<std::byte, 256> buffer{};
  pdu::AttributeWriter writer(buffer, pdu::Attribute{});
  pdu::HapticRecord record;
  record.kind = pdu::ForceModelKind::sphere;
  EXPECT_TRUE(writer.begin_set({1, 2, 3}) && writer.add(record));
  const auto size = static_cast<std::ptrdiff_t>(writer.finish());
  return {buffer.begin(), buffer.begin() + size};
}

/// Appends `more` to a datagram.
inline void join(Octets& datagram, const Octets& more) {
  datagram.insert(datagram.end(), more.begin(), more.end());
}

/// Four good seconds of driving, including a coupled datagram.
inline void drive(CaptureBuilder& capture, nanoseconds from = {}) {
  for (int i = 0; i < 4; ++i) {
    const nanoseconds t = from + seconds(i);
    pdu::EntityState pdu = truck(t);
    Octets datagram;
    if (i == 2) pdu.header.pdu_status = pdu::kStatusCoupledExtension;
    append_pdu(datagram, pdu);
    if (i == 2) join(datagram, attribute());
    capture.add(datagram, kStart + t + milliseconds(2));
  }
}

/// Adds datagrams with a fault to a capture.
using Plant = std::function<void(CaptureBuilder&)>;

/// A fault in an otherwise good Entity State, four seconds after the start.
inline Plant in_fields(const std::function<void(pdu::EntityState&)>& change) {
  return [change](CaptureBuilder& capture) {
    pdu::EntityState pdu = truck(seconds(4));
    change(pdu);
    capture.add(datagram_of(pdu), kStart + seconds(4));
  };
}

/// The output of `reckon inspect check --json` for a capture.
struct Checked {
  int status;
  std::vector<nlohmann::json> findings;
  nlohmann::json summary;

  [[nodiscard]] std::map<std::string, int> codes() const {
    std::map<std::string, int> codes;
    for (const nlohmann::json& finding : findings) ++codes[finding["rule"]];
    return codes;
  }
};

inline Checked check(const std::string& source) {
  const auto result = run_reckon({"inspect", source, "check", "--json"});
  Checked checked{result.status, {}, {}};
  for (const std::string& line : result.lines())
    checked.findings.push_back(nlohmann::json::parse(line));
  checked.summary = checked.findings.back();
  checked.findings.pop_back();
  return checked;
}

}  // namespace reckon::tools::checks
