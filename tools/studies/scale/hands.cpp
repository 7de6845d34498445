// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/studies/scale/hands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reckon/tools/studies/contact/contact_run.hpp"
#include "reckon/tools/studies/contact/contact_scenes.hpp"
#include "reckon/tools/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

constexpr double kThreshold = 0.015;  // [N], of the force at which hands send
constexpr double kLongest = 20;       // [s], of a run

/// A scene and the part of it in which the hands are pressed together all the time [s].
struct Part {
  std::string_view scene;
  double from, to;
};
constexpr std::array kParts{Part{"press-20", 3, 7}, Part{"stroke-1.5", 4, 10}, Part{"tap", 0, 0},
                            Part{"light", 0, 0}};

HandsRow run_part(const Part& part, const peer::ImpairmentLaw& network, std::uint64_t seed) {
  const ContactScene& contact =
      *std::ranges::find(contact_scenes(), part.scene, &ContactScene::name);
  peer::SceneFile scene = scene_of(contact);
  scene.dead_reckoning.thresholds.force = kThreshold;
  scene.impairment.law = network;
  scene.impairment.seed = seed;
  const auto scripts = scripts_of(contact);
  const auto hands = static_cast<double>(contact.hands);
  const auto packets_until = [&](double time) {
    return run_contact(scene, contact.hands, scripts, time).packets_per_s * time / hands;
  };

  HandsRow row;
  row.scene = contact.name;
  const ContactRun run =
      run_contact(scene, contact.hands, scripts, std::min(kLongest, contact.seconds));
  row.packets_per_s = run.packets_per_s / hands;
  row.octets_per_s = run.octets_per_s / hands;
  const double shown = std::min(scene.hand.k1, stiffest_hand(scene));
  row.error = error_at_instant(run.record, {shown, 2 * scene.hand.radius});
  // The same every time: what two runs of different length differ by was sent in between.
  if (part.to > part.from)
    row.contact_packets_per_s =
        (packets_until(part.to) - packets_until(part.from)) / (part.to - part.from);
  return row;
}

std::string times_fewer(double packets) {
  return packets > 0 ? fmt::format("{:.1f} x", kRawPackets / packets) : "-";
}

}  // namespace

std::vector<HandsRow> run_hands(const peer::ImpairmentLaw& network, std::uint64_t seed,
                                const std::function<bool(double)>& go_on) {
  std::vector<HandsRow> rows;
  for (const Part& part : kParts) {
    if (go_on && !go_on(static_cast<double>(rows.size()) / kParts.size())) break;
    rows.push_back(run_part(part, network, seed));
  }
  return rows;
}

std::string hands_text(std::span<const HandsRow> rows) {
  constexpr auto kRight = TextTable::Align::right;
  TextTable table({{"HANDS"},
                   {"TOUCHING/s", kRight},
                   {"FEWER", kRight},
                   {"WHOLE RUN/s", kRight},
                   {"FEWER", kRight},
                   {"B/s", kRight},
                   {"FORCE p50", kRight},
                   {"FORCE p99", kRight}});
  for (const HandsRow& row : rows) {
    const bool has_part = row.contact_packets_per_s > 0;
    table.add({std::string(row.scene), has_part ? number_text(row.contact_packets_per_s) : "-",
               times_fewer(row.contact_packets_per_s), number_text(row.packets_per_s),
               times_fewer(row.packets_per_s), number_text(row.octets_per_s),
               fmt::format("{} N", number_text(row.error.p50)),
               fmt::format("{} N", number_text(row.error.p99))});
  }
  return fmt::format(
      "two whole peers whose hands touch, each sending where its force is off by {:g} mN\n{}"
      "FEWER: datagrams than one in each servo step, {:g} a second. FORCE: felt against stiffness "
      "x "
      "overlap at that\ninstant, while they touch.\n",
      1e3 * kThreshold, table.text(), kRawPackets);
}

std::string hands_json(std::span<const HandsRow> rows) {
  std::string out;
  for (const HandsRow& row : rows)
    JsonObject(out)
        .text("kind", "hands")
        .text("scene", row.scene)
        .value("contact_packets_per_s", row.contact_packets_per_s)
        .value("packets_per_s", row.packets_per_s)
        .value("bytes_per_s", row.octets_per_s)
        .value("raw_packets_per_s", kRawPackets)
        .value("force_error_p50_n", row.error.p50)
        .value("force_error_p99_n", row.error.p99)
        .end("\n");
  return out;
}

}  // namespace reckon::tools
