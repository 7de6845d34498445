// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any octets from the line of a Falcon, one by one: a report does not depend on earlier octets,
// equals its octets, and costs no heap. Its counts give a position with exactly these angles, or
// none.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "reckon/haptics/falcon/falcon_kinematics.hpp"
#include "reckon/haptics/falcon/falcon_packets.hpp"
#include "reckon/haptics/usb/usb_line.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

using haptics::FalconReport;
using haptics::FalconReportParser;
using Input = std::span<const std::uint8_t>;

/// The octets as the device writes them, except the spare octet.
std::array<std::uint8_t, haptics::kFalconPacket> written(const FalconReport& report) {
  auto octets = haptics::octets_of({report.counts, 0, false});
  octets[13] = static_cast<std::uint8_t>('A' + (report.homed << 4 | report.buttons));
  return octets;
}

void check_place(const FalconReport& report) {
  Eigen::Vector3d angles;
  for (int i = 0; i < 3; ++i)
    angles[i] = haptics::falcon_angle(report.counts[static_cast<std::size_t>(i)]);
  const auto pose = haptics::falcon_pose(angles);
  if (!pose) return;
  const auto back = haptics::falcon_angles(pose->position);
  require(back.has_value(), "a place that has no angles");
  for (int i = 0; i < 3; ++i) {
    const double off = std::remainder((*back)[i] - angles[i], 2 * std::numbers::pi);
    require(std::abs(off) < 1e-6, "the place of other angles");
  }
}

/// The report that ends at an octet of the input, read from the last sixteen octets.
std::optional<FalconReport> ending_at(Input input, std::size_t end) {
  if (end + 1 < haptics::kFalconPacket) return std::nullopt;
  FalconReportParser parser;
  std::optional<FalconReport> last;
  for (const std::uint8_t octet :
       input.subspan(end + 1 - haptics::kFalconPacket, haptics::kFalconPacket))
    last = parser.take(octet);
  return last;
}

}  // namespace

void check(std::span<const std::byte> data) {
  const Input input = numbers_of(data);
  const HeapMeter heap;
  FalconReportParser parser;
  for (std::size_t i = 0; i < input.size(); ++i) {
    const auto report = parser.take(input[i]);
    require(report == ending_at(input, i), "what came before changed a report");
    if (!report) continue;
    auto octets = written(*report);
    octets[14] = input[i - 1];
    require(std::ranges::equal(octets, input.subspan(i + 1 - octets.size(), octets.size())),
            "a report is not what its octets say");
    check_place(*report);
  }
  require(parser.malformed() <= input.size(), "more dropped than came");
  std::size_t own = 0;
  haptics::each_payload_octet(input, haptics::kFalconHeader, [&](std::uint8_t) { ++own; });
  require(own <= input.size(), "more octets than came");
  require(heap.allocations() == 0, "reading took heap");
}

}  // namespace reckon::fuzz
