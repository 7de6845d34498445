// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/contact/contact_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::bench {
namespace {

/// A wide threshold counts as worse from this ratio of errors.
constexpr double kWorse = 1.1;

constexpr std::string_view kLegend =
    "Forces in mN. FEWER: an Entity State and an Attribute PDU each millisecond of each hand, over "
    "all packets.\nP50 to RMS: felt force against the undelayed truth: spring that the devices can "
    "display x true overlap at\nthat instant, in contact. ASKED: P99 against the requested spring. "
    "TWIN: RMS against a twin run of the\nsame hands and devices without a network. WEBER: share "
    "of the time in contact with an error that a\nperson may notice, above 10 % of the force and "
    "50 mN; ! above 1 %. PEAK: in the first second of\ntouch, x the twin's. GAIN, PHASE [deg]: at "
    "the strokes' frequency, of the hand that strokes and of\nthe other, against the truth at that "
    "instant. LINGER [ms]: felt after the hands had parted. NS: one\nservo step, some 400 ns of it "
    "the simulated device. <: another row of the scene sends and errs no more.\n";

std::string millinewtons(double newtons) { return number_text(1e3 * newtons); }

/// With two decimals.
std::string ratio_text(const std::optional<double>& ratio) {
  return ratio ? fmt::format("{:.2f}", *ratio) : "-";
}

/// Of both hands, separated by blanks.
template <typename Text>
std::string stroke_text(const ContactRow& row, Text&& text) {
  return row.stroke ? text((*row.stroke)[0]) + ' ' + text((*row.stroke)[1]) : "-";
}

void add_error(Fields& fields, std::string_view from, const ForceError& error) {
  const auto known = [&](double value) {
    return error.samples > 0 ? std::optional(value) : std::nullopt;
  };
  Fields sizes;
  for (const auto& [name, value] : {std::pair{"p50", error.p50}, std::pair{"p99", error.p99},
                                    std::pair{"max", error.max}, std::pair{"rms", error.rms}}) {
    sizes.json(name, value);
    fields.csv(fmt::format("{}_{}_n", from, name), known(value));
  }
  sizes.json("noticed", error.noticed).json("samples", error.samples);
  fields.csv(fmt::format("{}_noticed", from), known(error.noticed))
      .json(fmt::format("error_{}_n", from), error.samples > 0 ? Value(sizes) : Value(known(0)));
}

void add_stroke(Fields& fields, const ContactRow& row) {
  for (std::size_t hand = 0; hand < 2; ++hand) {
    const auto of = [&](double Response::*member) {
      return row.stroke ? std::optional((*row.stroke)[hand].*member) : std::nullopt;
    };
    fields.csv(hand == 0 ? "gain" : "other_gain", of(&Response::gain))
        .csv(hand == 0 ? "phase_rad" : "other_phase_rad", of(&Response::phase));
  }
  const auto hand_fields = [](const Response& response) {
    return Fields().json("gain", response.gain).json("phase_rad", response.phase);
  };
  fields.json("stroke", row.stroke ? Value::array(*row.stroke, hand_fields) : Value::raw("null"));
}

void add_cells(Fields& fields, const ContactRow& row) {
  const ForceError& error = row.from_shown;
  fields.page_word("scene", html_escaped(row.scene))
      .page_word("send at", html_escaped(sending_text(row.sending)))
      .cell("SEND AT", sending_text(row.sending))
      .shown("PKT/S", "packets/s", row.packets_per_s, number_text(row.packets_per_s))
      .shown("FEWER", "fewer", row.times_fewer(), number_text(row.times_fewer()));
  for (const auto& [title, newtons] :
       {std::pair{"P50", error.p50}, std::pair{"P99", error.p99}, std::pair{"MAX", error.max},
        std::pair{"RMS", error.rms}, std::pair{"ASKED", row.from_asked.p99}})
    fields.cell(title, millinewtons(newtons));
  fields.cell("TWIN", row.from_twin ? millinewtons(*row.from_twin) : "-")
      .cell("WEBER",
            fmt::format("{:.1f} %{}", 100 * error.noticed, error.noticed > 0.01 ? " !" : ""))
      .cell("PEAK", ratio_text(row.first_peak))
      .cell("GAIN", stroke_text(row, [](auto& at) { return fmt::format("{:.2f}", at.gain); }))
      .cell("PHASE",
            stroke_text(row, [](auto& at) { return fmt::format("{:.0f}", degrees(at.phase)); }))
      .cell("LINGER", fmt::format("{:.0f}", 1e3 * row.linger))
      .cell("NS", fmt::format("{:.0f}", row.servo_step_ns))
      .word("", row.beaten ? "<" : "");
  for (const auto& [title, value] :
       {std::pair{"RMS [N]", error.rms}, std::pair{"99 % [N]", error.p99},
        std::pair{"max [N]", error.max}, std::pair{"linger [s]", row.linger},
        std::pair{"servo step [ns]", row.servo_step_ns}})
    fields.page(title, value, number_text(value));
  if (!row.touched()) fields.instead(3, "did not touch").page_instead(4, "did not touch");
}

Fields fields_of(const ContactRow& row, const peer::ImpairmentConfig& network) {
  Fields fields("contact");
  fields.value("scene", row.scene)
      .value("send_at", sending_text(row.sending))
      .value("delay_s", pdu::to_seconds(network.law.delay))
      .value("jitter", peer::jitter_share(network.law))
      .value("loss", network.law.loss)
      .json("seed", network.seed)
      .value("hands", row.hands)
      .value("asked_n_per_m", row.asked)
      .value("shown_n_per_m", row.shown)
      .value("packets_per_s", row.packets_per_s)
      .value("octets_per_s", row.octets_per_s)
      .value("for_force_per_s", row.for_force_per_s)
      .value("times_fewer", row.times_fewer());
  add_error(fields, "shown", row.from_shown);
  add_error(fields, "asked", row.from_asked);
  fields.value("twin_rms_n", row.touched() ? row.from_twin : std::nullopt)
      .value("first_peak", row.first_peak);
  add_stroke(fields, row);
  fields.value("linger_s", Value::decimals(row.linger, 3))
      .value("servo_step_ns", row.servo_step_ns)
      .value("front", !row.beaten);
  add_cells(fields, row);
  return fields;
}

/// A row's fields for a network.
auto contact_fields(const peer::ImpairmentConfig& network) {
  return [network](const ContactRow& row) { return fields_of(row, network); };
}

/// Effect of wide thresholds in scenes where they do not help.
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
  return fmt::format(
      "{} is worse than {} in both: {} packets/s against {}, P99 {} mN against {}.\n",
      sending_text(worst->sending), sending_text(best->sending), number_text(worst->packets_per_s),
      number_text(best->packets_per_s), millinewtons(worst->from_shown.p99),
      millinewtons(best->from_shown.p99));
}

std::string scene_text(std::span<const ContactRow> rows) {
  const ContactRow& first = rows.front();
  std::string meaning;
  for (const ContactScene& scene : contact_scenes())
    if (scene.name == first.scene) meaning = scene.meaning;
  std::string text = fmt::format("{}: {}\n{} hands of {} N/m", first.scene, meaning, first.hands,
                                 number_text(first.asked));
  if (first.shown < first.asked)
    text += fmt::format(", of which the devices can display {}", number_text(first.shown));
  return text + "\n" + table_of(rows, contact_fields({})) + wide_text(rows) + "\n";
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
  return json_of(rows, contact_fields(network));
}

std::string contact_csv(std::span<const ContactRow> rows, const peer::ImpairmentConfig& network) {
  return csv_of(rows, contact_fields(network));
}

std::string contact_page_table(std::span<const ContactRow> rows) {
  return page_table_of(rows, contact_fields({}));
}

}  // namespace reckon::bench
