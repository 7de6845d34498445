// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any report descriptor, or a wheel's descriptor with some octets changed, followed by any reports.
// Fields are read within the reports, written fields change only their own bits, no wall is stiffer
// than requested, and nothing after the descriptor allocates heap.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/haptics/hid/pid_reports.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"
#include "reckon/tests/haptics/support/pid_wheel.hpp"

namespace reckon::fuzz {
namespace {

using haptics::HidField;
using haptics::HidKind;
using haptics::HidReport;
using haptics::HidReports;
using haptics::PidReports;
using Input = std::span<const std::uint8_t>;

Input taken(Input& input, std::size_t octets) {
  const Input out = input.first(std::min(octets, input.size()));
  input = input.subspan(out.size());
  return out;
}

// An even octet, then a length and a descriptor; or an odd octet, then changes of the wheel's
// descriptor.
std::vector<std::uint8_t> descriptor_of(Input& input) {
  const Input head = taken(input, 1);
  if (head.empty() || head[0] % 2 == 0) {
    const Input length = taken(input, 2);
    const std::size_t octets = length.size() < 2 ? 0 : length[0] + 256U * length[1];
    const Input own = taken(input, octets);
    return {own.begin(), own.end()};
  }
  std::vector<std::uint8_t> out = test::PidWheel({.axes = head[0] % 4 == 1 ? 1 : 2}).descriptor();
  for (int i = 0; i < head[0] / 32; ++i) {
    const Input change = taken(input, 3);
    if (change.size() == 3) out[(change[0] + 256U * change[1]) % out.size()] = change[2];
  }
  return out;
}

void check_fields(const HidReports& reports) {
  require(reports.fields.size() <= HidReports::kMostFields, "too many fields");
  for (const HidField& field : reports.fields) {
    require(field.bits >= 1 && field.bits <= 32, "a field without bits");
    require(field.least <= field.most, "a range that is none");
    require(field.collection < reports.collections.size(), "a field that is nowhere");
    require((field.bit + field.bits + 7) / 8 <= reports.size(field.kind, field.report),
            "a field beyond its report");
    require(field.first_choice + field.choices <= reports.choices.size(), "choices of another");
  }
  for (std::size_t i = 0; i < reports.collections.size(); ++i) {
    require(reports.collections[i].parent <= i, "a collection within one that comes later");
    static_cast<void>(reports.is_within(i, ~0U));
  }
}

void check_reports(const PidReports& reports, Input input) {
  haptics::HidPlaces places;
  while (!input.empty()) {
    const Input report = taken(input, 1 + input[0] % 32U);
    static_cast<void>(reports.take(report, places));
    for (std::size_t axis = 0; axis < places.axes.size(); ++axis) {
      const auto& range = reports.axes()[axis];
      require(!range || places.axes[axis] == 0 ||
                  (places.axes[axis] >= range->minimum && places.axes[axis] <= range->maximum),
              "a place beyond the axis");
    }
    static_cast<void>(reports.read_pool(report));
    static_cast<void>(reports.has_room_of_its_own(report));
    if (!reports.has_springs() || !reports.fault().empty()) continue;
    const haptics::PidLoad load = reports.read_load(report);
    require((load.outcome == haptics::PidLoad::Outcome::done) == (load.block != 0),
            "an effect without a number");
    const auto word = [&](std::size_t i) {
      return static_cast<std::int16_t>(i < report.size() ? 257 * report[i] : 0);
    };
    ff_condition_effect condition{};
    condition.center = std::max<std::int16_t>(word(1), -0x7FFF);
    condition.left_coeff = static_cast<std::int16_t>(word(2) & 0x7FFF);
    condition.right_coeff =
        static_cast<std::int16_t>(condition.left_coeff > 0 ? 0 : word(3) & 0x7FFF);
    condition.left_saturation = static_cast<std::uint16_t>(word(4));
    const auto sent = reports.set_condition(report[0], 0, condition);
    require(!sent.span().empty() && sent.span()[0] != 0, "a report without its number");
    for (const HidReport& other :
         {reports.create(), reports.load(), reports.set_effect(report[0], haptics::kEffectLength),
          reports.operate(report[0], haptics::PidOperation::start)})
      require(!other.span().empty() && other.span()[0] != 0, "a report without its number");
    static_cast<void>(reports.free(report[0]));
    static_cast<void>(reports.gain());
    static_cast<void>(reports.control(haptics::PidControl::reset));
  }
}

}  // namespace

void check(std::span<const std::byte> data) {
  Input input = numbers_of(data);
  const auto reports = haptics::hid_reports(descriptor_of(input));
  if (!reports) return;
  check_fields(*reports);
  const PidReports read(*reports);
  const HeapMeter heap;
  check_reports(read, input);
  require(heap.allocations() == 0, "a report took heap");
}

}  // namespace reckon::fuzz
