// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/contact/contact_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <thread>

#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/units.hpp"

namespace reckon::bench {
namespace {

constexpr double kNoThreshold = 1e3;  // [m], [rad] and [N]: never passed

peer::SceneFile scene_on(const ContactScene& contact, const ContactSending& sending,
                         const peer::ImpairmentConfig& network) {
  peer::SceneFile scene = scene_of(contact);
  deadreckon::Thresholds& thresholds = scene.dead_reckoning.thresholds;
  if (sending.rate_hz > 0) {
    thresholds.position = thresholds.angle = thresholds.force = kNoThreshold;
    scene.dead_reckoning.heartbeat = pdu::from_seconds(1 / sending.rate_hz);
  } else {
    thresholds.force = sending.threshold;
  }
  scene.impairment = network;
  return scene;
}

std::size_t step_at(double seconds) {
  return static_cast<std::size_t>(std::lround(std::max(0.0, seconds) * 1e3));
}

ContactRow run_row(const ContactScene& contact, const ContactSending& sending,
                   const peer::ImpairmentConfig& network, double seconds) {
  const peer::SceneFile scene = scene_on(contact, sending, network);
  const auto scripts = scripts_of(contact);
  const ContactRun run = run_contact(scene, contact.hands, scripts, seconds);
  ContactRow row;
  row.scene = contact.name;
  row.sending = sending;
  row.hands = contact.hands;
  row.asked = scene.hand.k1;
  row.shown = std::min(row.asked, stiffest_hand(scene));
  row.packets_per_s = run.packets_per_s;
  row.octets_per_s = run.octets_per_s;
  row.for_force_per_s = run.for_force_per_s;
  row.servo_step_ns = run.servo_step_ns;
  const ContactTruth truth{row.shown, 2 * scene.hand.radius};
  row.from_shown = error_at_instant(run.record, truth);
  row.from_asked = error_at_instant(run.record, {row.asked, truth.reach});
  row.linger = linger(run.record, truth);
  row.stroke = stroke_response(run.record, truth, contact.stroke_hz, step_at(contact.strokes_from),
                               step_at(contact.strokes_to));
  if (scripts.empty()) return row;
  const ContactRecord twin = run_twins(scene, row.shown, scripts, seconds);
  row.from_twin = error_of_twin(run.record, twin);
  row.first_peak = first_peak(run.record, twin);
  return row;
}

// With the digits of the tables.
bool beats(const ContactRow& one, const ContactRow& other) {
  const double packets = in_three_digits(one.packets_per_s),
               more = in_three_digits(other.packets_per_s);
  const double error = in_three_digits(one.from_shown.p99),
               worse = in_three_digits(other.from_shown.p99);
  return one.scene == other.scene && one.touched() && packets <= more && error <= worse &&
         (packets < more || error < worse);
}

void mark_beaten(std::vector<ContactRow>& rows) {
  for (ContactRow& row : rows)
    row.beaten = std::any_of(rows.begin(), rows.end(),
                             [&](const ContactRow& other) { return beats(other, row); });
}

}  // namespace

std::string sending_text(const ContactSending& sending) {
  return sending.rate_hz > 0 ? fmt::format("{:.3g} Hz", sending.rate_hz)
                             : peer::format_quantity(sending.threshold, "N");
}

std::vector<ContactRow> run_contact_study(std::span<const ContactScene> scenes,
                                          std::span<const ContactSending> sendings,
                                          const peer::ImpairmentConfig& network, double longest,
                                          const ContactProgress& go_on) {
  const std::size_t all = scenes.size() * sendings.size();
  const std::size_t abreast = std::max(1U, std::thread::hardware_concurrency());
  std::vector<ContactRow> rows;
  while (rows.size() < all && (!go_on || go_on(rows.size(), all))) {
    std::vector<std::future<ContactRow>> runs;
    for (std::size_t i = rows.size(); i < std::min(all, rows.size() + abreast); ++i)
      runs.push_back(std::async(std::launch::async, [&, i] {
        const ContactScene& contact = scenes[i / sendings.size()];
        return run_row(contact, sendings[i % sendings.size()], network,
                       std::min(longest, contact.seconds));
      }));
    for (auto& run : runs) rows.push_back(run.get());
  }
  mark_beaten(rows);
  return rows;
}

}  // namespace reckon::bench
