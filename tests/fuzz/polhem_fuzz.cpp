// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transfers of any length and octets from the line of a Polhem: a transfer is a report of a form
// exactly if it has the length of the form; it equals its octets and costs no heap. Its counts give
// a position with exactly these angles, or none, and a unit quaternion for the tool.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include "reckon/haptics/polhem/polhem_kinematics.hpp"
#include "reckon/haptics/polhem/polhem_packets.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

using haptics::PolhemForm;
using haptics::PolhemReport;
using Input = std::span<const std::uint8_t>;

int word_at(Input octets, std::size_t word) {
  const int low = octets[2 * word], high = octets[2 * word + 1];
  return high < 128 ? 256 * high + low : 256 * high + low - 65'536;
}

void check_place(const PolhemReport& report) {
  const auto& arm = haptics::polhem_1();
  const Eigen::Vector3d angles =
      haptics::polhem_angles_at(arm, {report.arm[0], report.arm[1], report.arm[2]});
  const Eigen::Quaterniond turned = haptics::polhem_orientation(arm, angles, report.gimbal);
  require(std::abs(turned.norm() - 1.0) < 1e-9, "a turn that is none");
  const auto pose = haptics::polhem_pose(arm, angles);
  if (!pose) return;
  const auto back = haptics::polhem_angles(arm, pose->position);
  require(back.has_value(), "a place that has no angles");
  for (int i = 0; i < 3; ++i) {
    const double off = std::remainder((*back)[i] - angles[i], 2 * std::numbers::pi);
    require(std::abs(off) < 1e-6, "the place of other angles");
  }
}

void check_report(PolhemForm form, Input transfer) {
  const auto report = haptics::polhem_report(form, transfer);
  const auto length = static_cast<std::size_t>(form);
  require(report.has_value() == (transfer.size() == length), "a report of another length");
  if (!report) return;
  for (std::size_t i = 0; i < 3; ++i)
    require(report->arm[i] == word_at(transfer, i), "a report is not what its octets say");
  require(static_cast<std::int16_t>(report->info) == word_at(transfer, length / 2 - 1),
          "another information");
  if (form == PolhemForm::fourteen) {
    const int outermost = report->gimbal[2] + (report->button ? 10'000 : 0);
    require(outermost == word_at(transfer, 3) && report->gimbal[1] == word_at(transfer, 4) &&
                report->gimbal[0] == word_at(transfer, 5),
            "the gimbal is not what its octets say");
  }
  check_place(*report);
}

// Each command reads back from its octets as a device reads them.
void check_command(Input octets) {
  haptics::PolhemCommand command;
  for (std::size_t i = 0; i < 3; ++i)
    command.currents[i] = static_cast<std::int16_t>(word_at(octets, i));
  const auto told = haptics::octets_of(command);
  for (std::size_t i = 0; i < 7; ++i)
    require(word_at(told, i) == (i < 3 ? command.currents[i] : 0), "another command");
}

}  // namespace

void check(std::span<const std::byte> data) {
  const Input input = numbers_of(data);
  const HeapMeter heap;
  for (std::size_t from = 0; from < input.size(); from += 7) {
    const Input rest = input.subspan(from);
    for (const std::size_t length : {std::size_t{8}, std::size_t{14}, rest.size()}) {
      const Input transfer = rest.first(std::min(length, rest.size()));
      check_report(PolhemForm::eight, transfer);
      check_report(PolhemForm::fourteen, transfer);
    }
    if (rest.size() >= 6) check_command(rest);
  }
  require(heap.allocations() == 0, "reading took heap");
}

}  // namespace reckon::fuzz
