// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/balance_report.hpp"

#include <fmt/format.h>

#include <string_view>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {
namespace {

JsonObject& add_key(JsonObject& row, const peer::SenderInGroup& key) {
  if (key.stream == 0) {
    row.value("epoch", key.epoch);
  } else {
    row.text("boot", fmt::format("{:016x}", key.epoch)).value("stream", key.stream - 1);
  }
  return row.text("group", key.group.text());
}

void append_fates(std::string& out, const peer::FateCounts& counts) {
  JsonObject row(out);
  add_key(row, counts.key);
  for (std::size_t i = 0; i < counts.counts.size(); ++i) {
    if (counts.counts[i] > 0) row.value(name(static_cast<peer::DatagramFate>(i)), counts.counts[i]);
  }
  row.end();
}

// Both kinds of stretch begin with the same keys.
template <class Stretch>
JsonObject& add_numbers(JsonObject& row, const Stretch& stretch) {
  return add_key(row, stretch.key).value("first", stretch.first).value("last", stretch.last);
}

// A time that may not have been reached: null.
JsonObject& add_time(JsonObject& row, std::string_view name, std::chrono::nanoseconds time) {
  if (time < std::chrono::nanoseconds(0)) return row.value(name, "null");
  return row.decimals(name, pdu::to_seconds(time), 6);
}

void append_stretch(std::string& out, const peer::Stretch& stretch) {
  JsonObject row(out);
  add_numbers(row, stretch)
      .value("arrived", stretch.arrived)
      .value("missing", stretch.missing)
      .value("copies", stretch.copies);
  add_time(row, "joined_s", stretch.joined).end();
}

void append_tracked(std::string& out, const peer::TrackedStretch& stretch) {
  JsonObject row(out);
  add_numbers(row, stretch).value("received", stretch.received).value("lost", stretch.lost).end();
}

void append_membership(std::string& out, const peer::Membership& membership) {
  JsonObject row(out);
  row.text("group", membership.group.text())
      .decimals("joining_s", pdu::to_seconds(membership.joining), 6)
      .decimals("joined_s", pdu::to_seconds(membership.joined), 6);
  add_time(row, "leaving_s", membership.leaving);
  add_time(row, "left_s", membership.left);
  row.value("kernel_drops", membership.kernel_drops).end();
}

}  // namespace

std::string balance_line(const peer::BalanceReport& report, double seconds, bool end) {
  std::string line;
  JsonObject(line)
      .text("event", "balance")
      .decimals("seconds", seconds, 3)
      .value("end", end)
      .value("missed_events", report.missed)
      .array("fates", report.fates, append_fates)
      .array("stretches", report.stretches, append_stretch)
      .array("tracked", report.tracked, append_tracked)
      .array("memberships", report.memberships, append_membership)
      .end("\n");
  return line;
}

}  // namespace reckon::tools
