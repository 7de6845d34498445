// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/contact/contact_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

/// A wide threshold is told to be worse from this much more error on.
constexpr double kWorse = 1.1;

constexpr std::string_view kLegend =
    "Forces in mN. FEWER: an Entity State and an Attribute PDU each millisecond of each hand, over "
    "all "
    "packets.\nP50 to RMS: felt against the undelayed truth: spring that the devices can show x "
    "true "
    "overlap at that\ninstant, in contact. ASKED: P99 against the spring that was asked for. TWIN: "
    "RMS "
    "against a twin run of\nthe same hands and devices without a network. WEBER: share of the time "
    "in "
    "contact with an error that\na person may notice, above 10 % of the force and 50 mN; ! above 1 "
    "%. "
    "PEAK: in the first second of\ntouch, x the twin's. GAIN, PHASE [deg]: at the strokes' "
    "frequency, "
    "of the hand that strokes and of\nthe other, against the truth at that instant. LINGER [ms]: "
    "felt "
    "after the hands had parted. NS: one\nservo step, some 400 ns of it the simulated device. <: "
    "another "
    "row of the scene sends and errs no more.\n";

std::string millinewtons(double newtons) { return number_text(1e3 * newtons); }

/// Two digits behind the point.
std::string ratio_text(const std::optional<double>& ratio) {
  return ratio ? fmt::format("{:.2f}", *ratio) : "-";
}

std::string gain_text(const ContactRow& row) {
  if (!row.stroke) return "-";
  return fmt::format("{:.2f} {:.2f}", (*row.stroke)[0].gain, (*row.stroke)[1].gain);
}

std::string phase_text(const ContactRow& row) {
  if (!row.stroke) return "-";
  return fmt::format("{:.0f} {:.0f}", degrees((*row.stroke)[0].phase),
                     degrees((*row.stroke)[1].phase));
}

std::vector<std::string> cells_of(const ContactRow& row) {
  const ForceError& error = row.from_shown;
  if (!row.touched())
    return {sending_text(row.sending), number_text(row.packets_per_s),
            number_text(row.times_fewer()), "did not touch"};
  return {sending_text(row.sending),
          number_text(row.packets_per_s),
          number_text(row.times_fewer()),
          millinewtons(error.p50),
          millinewtons(error.p99),
          millinewtons(error.max),
          millinewtons(error.rms),
          millinewtons(row.from_asked.p99),
          row.from_twin ? millinewtons(*row.from_twin) : "-",
          fmt::format("{:.1f} %{}", 100 * error.noticed, error.noticed > 0.01 ? " !" : ""),
          ratio_text(row.first_peak),
          gain_text(row),
          phase_text(row),
          fmt::format("{:.0f}", 1e3 * row.linger),
          fmt::format("{:.0f}", row.servo_step_ns),
          row.beaten ? "<" : ""};
}

/// What wide thresholds do here, where they do not help.
std::string wide_text(std::span<const ContactRow> rows) {
  const ContactRow *best = nullptr, *worst = nullptr;
  for (const ContactRow& row : rows) {
    if (row.sending.rate_hz > 0 || !row.touched()) continue;
    if (best == nullptr || row.sending.threshold < best->sending.threshold) best = &row;
  }
  for (const ContactRow& row : rows) {
    if (best == nullptr || row.sending.rate_hz > 0 || !row.beaten) continue;
    const bool worse = row.sending.threshold > best->sending.threshold &&
                       row.from_shown.p99 > kWorse * best->from_shown.p99 &&
                       row.packets_per_s >= best->packets_per_s;
    if (worse && (worst == nullptr || row.from_shown.p99 > worst->from_shown.p99)) worst = &row;
  }
  if (worst == nullptr) return "";
  return fmt::format("{} is worse than {} here in both: {} packets/s for {}, P99 {} mN for {}.\n",
                     sending_text(worst->sending), sending_text(best->sending),
                     number_text(worst->packets_per_s), number_text(best->packets_per_s),
                     millinewtons(worst->from_shown.p99), millinewtons(best->from_shown.p99));
}

std::string scene_text(std::span<const ContactRow> rows) {
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table({{"SEND AT", kRight},
                          {"PKT/S", kRight},
                          {"FEWER", kRight},
                          {"P50", kRight},
                          {"P99", kRight},
                          {"MAX", kRight},
                          {"RMS", kRight},
                          {"ASKED", kRight},
                          {"TWIN", kRight},
                          {"WEBER", kRight},
                          {"PEAK", kRight},
                          {"GAIN", kRight},
                          {"PHASE", kRight},
                          {"LINGER", kRight},
                          {"NS", kRight},
                          {""}});
  for (const ContactRow& row : rows) table.add(cells_of(row));
  const ContactRow& first = rows.front();
  std::string meaning;
  for (const ContactScene& scene : contact_scenes())
    if (scene.name == first.scene) meaning = scene.meaning;
  std::string text = fmt::format("{}: {}\n{} hands of {} N/m", first.scene, meaning, first.hands,
                                 number_text(first.asked));
  if (first.shown < first.asked)
    text += fmt::format(", of which the devices can show {}", number_text(first.shown));
  return text + "\n" + table.text() + wide_text(rows) + "\n";
}

std::string error_json(const ForceError& error) {
  if (error.samples == 0) return "null";
  std::string out;
  tools::JsonObject(out)
      .value("p50", error.p50)
      .value("p99", error.p99)
      .value("max", error.max)
      .value("rms", error.rms)
      .value("noticed", error.noticed)
      .value("samples", error.samples)
      .end();
  return out;
}

std::string maybe(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}

}  // namespace

std::string contact_text(std::span<const ContactRow> rows, const peer::ImpairmentConfig& network) {
  std::string text;
  while (!rows.empty()) {
    const auto next = std::find_if(rows.begin(), rows.end(), [&](const ContactRow& row) {
      return row.scene != rows.front().scene;
    });
    const auto count = static_cast<std::size_t>(next - rows.begin());
    text += scene_text(rows.first(count));
    rows = rows.subspan(count);
  }
  text += fmt::format("Whole peers in simulated time; {}; seed {}.\n", network_text(network.law),
                      network.seed);
  return text + std::string(kLegend);
}

std::string contact_json(std::span<const ContactRow> rows, const peer::ImpairmentConfig& network) {
  std::string text;
  for (const ContactRow& row : rows) {
    tools::JsonObject object(text);
    object.text("kind", "contact")
        .text("scene", row.scene)
        .text("send_at", sending_text(row.sending))
        .value("delay_s", pdu::to_seconds(network.law.delay))
        .value("jitter", peer::jitter_share(network.law))
        .value("loss", network.law.loss)
        .value("seed", network.seed)
        .value("hands", row.hands)
        .value("asked_n_per_m", row.asked)
        .value("shown_n_per_m", row.shown)
        .value("packets_per_s", row.packets_per_s)
        .value("octets_per_s", row.octets_per_s)
        .value("for_force_per_s", row.for_force_per_s)
        .value("times_fewer", row.times_fewer())
        .value("error_shown_n", error_json(row.from_shown))
        .value("error_asked_n", error_json(row.from_asked))
        .number("twin_rms_n", row.touched() ? row.from_twin : std::nullopt)
        .number("first_peak", row.first_peak);
    if (row.stroke)
      object.array("stroke", *row.stroke, [](std::string& out, const Response& response) {
        tools::JsonObject(out)
            .value("gain", response.gain)
            .value("phase_rad", response.phase)
            .end();
      });
    else
      object.value("stroke", "null");
    object.decimals("linger_s", row.linger, 3)
        .value("servo_step_ns", row.servo_step_ns)
        .value("front", !row.beaten)
        .end("\n");
  }
  return text;
}

std::string contact_csv(std::span<const ContactRow> rows, const peer::ImpairmentConfig& network) {
  std::string text =
      "scene,send_at,delay_s,jitter,loss,hands,asked_n_per_m,shown_n_per_m,packets_per_s,"
      "octets_per_s,for_force_per_s,times_fewer,shown_p50_n,shown_p99_n,shown_max_n,shown_rms_n,"
      "shown_noticed,asked_p50_n,asked_p99_n,asked_max_n,asked_rms_n,asked_noticed,twin_rms_n,"
      "first_peak,gain,phase_rad,other_gain,other_phase_rad,linger_s,servo_step_ns,front\n";
  for (const ContactRow& row : rows) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{}", row.scene,
                   sending_text(row.sending), pdu::to_seconds(network.law.delay),
                   peer::jitter_share(network.law), network.law.loss, row.hands, row.asked,
                   row.shown, row.packets_per_s, row.octets_per_s, row.for_force_per_s,
                   row.times_fewer());
    for (const ForceError& error : {row.from_shown, row.from_asked})
      text += error.samples > 0 ? fmt::format(",{},{},{},{},{}", error.p50, error.p99, error.max,
                                              error.rms, error.noticed)
                                : ",,,,,";
    text += fmt::format(",{},{}", maybe(row.touched() ? row.from_twin : std::nullopt),
                        maybe(row.first_peak));
    for (std::size_t hand = 0; hand < 2; ++hand)
      text += row.stroke
                  ? fmt::format(",{},{}", (*row.stroke)[hand].gain, (*row.stroke)[hand].phase)
                  : ",,";
    text += fmt::format(",{:.3f},{},{}\n", row.linger, row.servo_step_ns, row.beaten ? 0 : 1);
  }
  return text;
}

}  // namespace reckon::bench
