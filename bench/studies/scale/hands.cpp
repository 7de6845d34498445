// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/hands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reckon/bench/studies/contact/contact_run.hpp"
#include "reckon/bench/studies/contact/contact_scenes.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr double kLongest = 20;  // [s], run of the shipped pair
constexpr double kTenths = 10;   // in a second

/// A scene and the part of it in which the hands are pressed together all the time [s].
struct Part {
  std::string_view scene;
  double from, to;
};
constexpr std::array kParts{Part{"press-20", 3, 7},    Part{"stroke-0.5", 4, 10},
                            Part{"stroke-1.5", 4, 10}, Part{"tap", 0, 0},
                            Part{"visit", 8, 16},      Part{"light", 0, 0}};

HandsRow run_part(const Part& part, double threshold, const peer::ImpairmentLaw& network,
                  std::uint64_t seed) {
  const ContactScene& contact =
      *std::ranges::find(contact_scenes(), part.scene, &ContactScene::name);
  peer::SceneFile scene = scene_of(contact);
  scene.dead_reckoning.thresholds.force = threshold;
  scene.impairment.law = network;
  scene.impairment.seed = seed;
  scene.hash = peer::scene_hash(scene);
  const auto hands = static_cast<double>(contact.hands);
  const double seconds = contact.shipped ? kLongest : contact.seconds;
  const ContactRun run = run_contact(scene, contact.hands, scripts_of(contact), seconds);

  HandsRow row;
  row.scene = contact.name;
  row.threshold = threshold;
  row.packets_per_s = run.packets_per_s / hands;
  row.octets_per_s = run.octets_per_s / hands;
  const double shown = std::min(scene.hand.k1, stiffest_hand(scene));
  row.error = error_at_instant(run.record, {shown, 2 * scene.hand.radius});
  const auto sent_until = [&](double time) {
    return run.packets[static_cast<std::size_t>(time * kTenths)] / hands;
  };
  if (part.to > part.from)
    row.contact_packets_per_s =
        (sent_until(part.to) - sent_until(part.from)) / (part.to - part.from);
  return row;
}

std::string times_fewer(double packets) {
  return packets > 0 ? fmt::format("{:.1f} x", kRawPackets / packets) : "-";
}

std::string newtons(double value) { return fmt::format("{} mN", number_text(1e3 * value)); }

/// For each scene and bar, the smallest threshold that meets the bar, and its error.
std::string bars_text(std::span<const HandsRow> rows) {
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table({{"HANDS"},
                          {fmt::format("{:g} x TOUCHING AT", kFewerTouching), kRight},
                          {"FORCE p99", kRight},
                          {fmt::format("{:g} x WHOLE RUN AT", kFewerWhole), kRight},
                          {"FORCE p99", kRight}});
  for (std::size_t begin = 0; begin < rows.size();) {
    const HandsRow& first = rows[begin];
    std::size_t end = begin;
    while (end < rows.size() && rows[end].scene == first.scene) ++end;
    std::vector<std::string> cells{std::string(first.scene)};
    const auto add_bar = [&](double HandsRow::*packets, double bar) {
      if (first.*packets <= 0) return void(cells.insert(cells.end(), {"-", "-"}));
      for (std::size_t i = begin; i < end; ++i)
        if (rows[i].*packets * bar <= kRawPackets)
          return void(
              cells.insert(cells.end(), {newtons(rows[i].threshold), newtons(rows[i].error.p99)}));
      cells.insert(cells.end(), {"none of these", "-"});
    };
    add_bar(&HandsRow::contact_packets_per_s, kFewerTouching);
    add_bar(&HandsRow::packets_per_s, kFewerWhole);
    table.add(cells);
    begin = end;
  }
  return table.text();
}

}  // namespace

std::vector<HandsRow> run_hands(const peer::ImpairmentLaw& network, std::uint64_t seed,
                                const std::function<bool(double)>& go_on) {
  constexpr double kAll = kParts.size() * kHandThresholds.size();
  std::vector<HandsRow> rows;
  for (const Part& part : kParts)
    for (const double threshold : kHandThresholds) {
      if (go_on && !go_on(static_cast<double>(rows.size()) / kAll)) return rows;
      rows.push_back(run_part(part, threshold, network, seed));
    }
  return rows;
}

std::string hands_text(std::span<const HandsRow> rows) {
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table({{"HANDS"},
                          {"SENT AT", kRight},
                          {"TOUCHING/s", kRight},
                          {"FEWER", kRight},
                          {"WHOLE RUN/s", kRight},
                          {"FEWER", kRight},
                          {"B/s", kRight},
                          {"FORCE p50", kRight},
                          {"FORCE p99", kRight}});
  for (const HandsRow& row : rows) {
    const bool has_part = row.contact_packets_per_s > 0;
    table.add({std::string(row.scene), newtons(row.threshold),
               has_part ? number_text(row.contact_packets_per_s) : "-",
               times_fewer(row.contact_packets_per_s), number_text(row.packets_per_s),
               times_fewer(row.packets_per_s), number_text(row.octets_per_s),
               newtons(row.error.p50), newtons(row.error.p99)});
  }
  return fmt::format(
      "two complete peers with touching hands; each sends when its force error exceeds the row's "
      "value\n{}FEWER: reduction against one datagram in each servo step, {:g} a second. FORCE: "
      "felt against stiffness x\noverlap at that instant, while they touch.\n\nthe least of these "
      "errors for each reduction against a stream\n{}",
      table.text(), kRawPackets, bars_text(rows));
}

std::string hands_json(std::span<const HandsRow> rows) {
  std::string out;
  for (const HandsRow& row : rows)
    tools::JsonObject(out)
        .text("kind", "hands")
        .text("scene", row.scene)
        .value("threshold_n", row.threshold)
        .value("contact_packets_per_s", row.contact_packets_per_s)
        .value("packets_per_s", row.packets_per_s)
        .value("bytes_per_s", row.octets_per_s)
        .value("raw_packets_per_s", kRawPackets)
        .value("force_error_p50_n", row.error.p50)
        .value("force_error_p99_n", row.error.p99)
        .end("\n");
  return out;
}

}  // namespace reckon::bench
