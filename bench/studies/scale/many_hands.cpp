// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/many_hands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reckon/bench/studies/contact/contact_run.hpp"
#include "reckon/bench/studies/contact/contact_scenes.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr double kApart = 0.4;  // [m], between places, so that no other hands touch
constexpr std::size_t kInRow = 8;
constexpr double kServoHz = 1000;
// Entity State, Attribute PDU with one force model, headers of UDP and IPv4 [octets].
constexpr double kRawDatagram = 144 + 32 + 8 + 72 + peer::kUdpIpv4Headers;

Eigen::Vector3d place_of_hand(std::size_t place) {
  return kApart * Eigen::Vector3d(static_cast<double>(place % kInRow),
                                  static_cast<double>(place / kInRow), 0);
}

/// Pairs of hands perform the visit of contact_scenes(). The others oscillate by 5 cm in 2 to 5 s.
haptics::HandTarget target_of(std::size_t hand, std::size_t touching, double time,
                              const ContactScene& visit) {
  if (hand < touching) {
    haptics::HandTarget target = visit.path(hand % 2, time);
    target.position += place_of_hand(hand / 2);
    return target;
  }
  constexpr double kReach = 0.05, kHeight = 0.2;  // [m]
  const double rate = 2 * std::numbers::pi / (2 + 0.05 * static_cast<double>(hand));
  haptics::HandTarget target;
  target.position =
      place_of_hand(hand) + Eigen::Vector3d(kReach * std::sin(rate * time), 0, kHeight);
  target.velocity = {kReach * rate * std::cos(rate * time), 0, 0};
  return target;
}

/// Number of touching hands: kManyTouching, or with fewer peers as many pairs as there are.
std::size_t touching_of(std::size_t peers) { return std::min(kManyTouching, peers / 2 * 2); }

ManyHandsRow run_at(double threshold, std::size_t peers, const peer::ImpairmentLaw& network,
                    std::uint64_t seed, const std::function<bool(double)>& go_on) {
  const std::size_t touching = touching_of(peers);
  const ContactScene& visit = *std::ranges::find(contact_scenes(), "visit", &ContactScene::name);
  peer::SceneFile scene = scene_of(visit);
  scene.operators.resize(peers);
  scene.dead_reckoning.thresholds.force = threshold;
  scene.impairment.law = network;
  scene.impairment.seed = seed;
  scene.hash = peer::scene_hash(scene);
  std::vector<haptics::HandScript> scripts;
  for (std::size_t hand = 0; hand < peers; ++hand)
    scripts.emplace_back(
        [hand, touching, &visit](double time) { return target_of(hand, touching, time, visit); });
  const ContactRun run = run_contact(scene, peers, scripts, visit.seconds, touching, go_on);
  const double shown = std::min(scene.hand.k1, stiffest_hand(scene));
  return {threshold,        peers,
          touching,         run.packets_per_s,
          run.octets_per_s, error_at_instant(run.record, {shown, 2 * scene.hand.radius})};
}

std::string fewer_by(double raw, double sent) {
  return sent > 0 ? fmt::format("{:.1f} x", raw / sent) : "-";
}

std::string millinewtons(double value) { return fmt::format("{} mN", number_text(1e3 * value)); }

}  // namespace

RawStream raw_stream_of(std::size_t peers) {
  const double packets = kServoHz * static_cast<double>(peers);
  return {packets, packets * kRawDatagram};
}

std::vector<ManyHandsRow> run_many_hands(std::size_t peers, const peer::ImpairmentLaw& network,
                                         std::uint64_t seed,
                                         const std::function<bool(double)>& go_on) {
  std::vector<ManyHandsRow> rows;
  for (const double threshold : kManyThresholds) {
    bool stopped = false;
    ManyHandsRow row = run_at(threshold, peers, network, seed, [&](double share) {
      const double done = (static_cast<double>(rows.size()) + share) / kManyThresholds.size();
      stopped = go_on && !go_on(done);
      return !stopped;
    });
    if (stopped) break;
    rows.push_back(row);
  }
  return rows;
}

std::string many_hands_text(std::span<const ManyHandsRow> rows) {
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table({{"FORCE SENT AT", kRight},
                          {"DATAGRAMS/s", kRight},
                          {"FEWER", kRight},
                          {"B/s", kRight},
                          {"FEWER", kRight},
                          {"FORCE p50", kRight},
                          {"FORCE p99", kRight}});
  if (rows.empty()) return {};
  const std::size_t peers = rows.front().peers, touching = rows.front().touching;
  const RawStream raw = raw_stream_of(peers);
  for (const ManyHandsRow& row : rows)
    table.add({millinewtons(row.threshold), number_text(row.packets_per_s),
               fewer_by(raw.packets_per_s, row.packets_per_s), number_text(row.octets_per_s),
               fewer_by(raw.octets_per_s, row.octets_per_s), millinewtons(row.error.p50),
               millinewtons(row.error.p99)});
  table.add({"each step", number_text(raw.packets_per_s), "1.0 x",
             fmt::format("{:.0f}", raw.octets_per_s), "1.0 x", "-", "-"});
  return fmt::format(
      "{} peers with a hand each, {} of them touching two by two for 8 of 22 s{}\n{}{}: without "
      "dead reckoning of the force, each change is sent. Each step: pose and force in\na datagram "
      "of {:g} octets a servo step. FORCE: felt against stiffness x overlap at that instant.\n",
      peers, touching, touching < peers ? ", while the others move" : "", table.text(),
      millinewtons(kManyThresholds.back()), kRawDatagram);
}

std::string many_hands_json(std::span<const ManyHandsRow> rows) {
  std::string out;
  for (const ManyHandsRow& row : rows) {
    const RawStream raw = raw_stream_of(row.peers);
    tools::JsonObject(out)
        .text("kind", "many_hands")
        .value("peers", row.peers)
        .value("touching", row.touching)
        .value("threshold_n", row.threshold)
        .value("packets_per_s", row.packets_per_s)
        .value("bytes_per_s", row.octets_per_s)
        .value("raw_packets_per_s", raw.packets_per_s)
        .value("raw_bytes_per_s", raw.octets_per_s)
        .value("force_error_p50_n", row.error.p50)
        .value("force_error_p99_n", row.error.p99)
        .end("\n");
  }
  return out;
}

}  // namespace reckon::bench
