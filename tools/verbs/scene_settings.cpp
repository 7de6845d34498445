// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_settings.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstddef>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/peer/notation/entity_type_text.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/ownership/tenure.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/tools/verbs/loaded_scene.hpp"
#include "reckon/tools/verbs/scene_cells_text.hpp"
#include "reckon/tools/verbs/scene_groups_text.hpp"

namespace reckon::tools {
namespace {

using peer::format_quantity;

std::string duration_of(std::chrono::nanoseconds duration) {
  return format_quantity(pdu::to_seconds(duration), "s");
}

/// Convergence of remote entities.
std::string shown_as(const peer::ConvergenceConfig& config) {
  const auto& settings = config.settings;
  return fmt::format("{} in {}, at once above {}; follows {}", peer::word_of(settings.curve),
                     format_quantity(settings.duration, "s"),
                     format_quantity(settings.teleport_distance, "m"),
                     config.prediction == peer::Prediction::adaptive ? "the best recent model"
                                                                     : "the model as sent");
}

/// Multicast, or a list of addresses instead.
std::string way_of(const peer::NetworkConfig& network) {
  if (peer::may_be_broadcast(network.group)) return "broadcast";
  if (network.peers.empty()) return "multicast";
  std::string text = "unicast, each datagram to";
  for (const peer::NamedPeer& peer : network.peers)
    text += (&peer == network.peers.data() ? " " : ", ") + peer.text();
  return text;
}

/// "5 ms", "5 ms or until 6 go together".
std::string wait_of(const peer::BundlePolicy& policy) {
  std::string text = duration_of(policy.hold);
  if (policy.updates > 0) text += fmt::format(" or until {} are bundled", policy.updates);
  return text;
}

/// "all that is within the radius", "platform, within 500 m; 2 boxes hide".
std::string awareness_of(const peer::AwarenessConfig& config) {
  std::string text = config.kinds.empty() ? "all entities within the radius" : config.kinds;
  if (config.aura > 0) text += fmt::format("; none beyond {}", format_quantity(config.aura, "m"));
  for (const peer::NimbusClass& one : config.nimbus)
    text += fmt::format("; {} from {} farther away", peer::entity_type_numbers(one.type),
                        format_quantity(one.nimbus, "m"));
  if (!config.occluders.empty())
    text += fmt::format("; {} boxes hide entities behind them", config.occluders.size());
  return text;
}

/// "to 50 m 30 Hz full", "beyond 1 Hz rigid".
std::string tier_of(const peer::TierConfig& tier, bool own_groups) {
  if (!is_by_distance(tier)) return "peers that can touch";
  const aoim::Channel& row = tier.channel;
  const bool ends = std::isfinite(row.farthest);
  std::string text =
      fmt::format("{} {} Hz {}", ends ? "to " + format_quantity(row.farthest, "m") : "beyond",
                  row.active_hz, peer::word_of(row.body));
  if (own_groups && row.coarser > 1.0) text += fmt::format(" {} x as coarse", row.coarser);
  return text;
}

/// "to 1 m 1000 Hz, ..; what is held back is counted (updates_held_back)".
std::string tiers_of(const peer::AoimConfig& aoim) {
  const bool own_groups = own_group_count(aoim.tiers) > 0;
  std::string text;
  for (const peer::TierConfig& tier : aoim.tiers)
    text += (text.empty() ? "" : ", ") + tier_of(tier, own_groups);
  if (!has_distance_tiers(aoim.tiers))
    return text.empty() ? "one: all updates to all peers"
                        : text + ", then all updates to all peers";
  text += own_groups ? "" : " of the nearest receiver";
  text += "; delayed updates are counted (updates_held_back)";
  if (aoim.awareness.budget > 0)
    text += fmt::format("; accepts {} a second", format_quantity(aoim.awareness.budget, "B"));
  return text;
}

}  // namespace

SettingRows scene_settings(const peer::SceneFile& file) {
  const auto& thresholds = file.dead_reckoning.thresholds;
  SettingRows rows = {
      {"sends when off by",
       fmt::format("{}, {} or {}; else every {}", format_quantity(thresholds.position, "m"),
                   format_quantity(thresholds.angle, "rad"), format_quantity(thresholds.force, "N"),
                   duration_of(file.dead_reckoning.heartbeat))},
      {"model", fmt::format("{}; rule {}; acceleration of rvb: {}",
                            peer::word_of(file.dead_reckoning.algorithm),
                            peer::word_of(file.dead_reckoning.rule),
                            peer::word_of(file.dead_reckoning.acceleration))},
      {"shown", shown_as(file.convergence)},
      {"cells",
       fmt::format("{}; senses {}", cells_text(file.aoim), format_quantity(file.aoim.radius, "m"))},
      {"of others", awareness_of(file.aoim.awareness)},
      {"tiers", tiers_of(file.aoim)},
      {"groups", groups_text(file)},
      {"by", way_of(file.network)},
      {"datagrams", fmt::format("up to {} octets, a pose waits {}", file.network.bundle_max,
                                wait_of(file.network.bundle))},
      {"hand",
       fmt::format("sphere of {}, {}, {}; feels objects with {}",
                   format_quantity(file.hand.radius, "m"), format_quantity(file.hand.k1, "N/m"),
                   format_quantity(file.hand.damping, "N s/m"),
                   file.hand.contact_radius > 0
                       ? "a ball of " + format_quantity(file.hand.contact_radius, "m")
                       : "a point")},
      {"impairment", file.impairment.law.is_perfect() ? "none" : "on: see [impairment]"},
  };
  if (const std::string delivery = over_delivery_text(file.aoim); !delivery.empty())
    rows.emplace_back("heard", delivery);
  add_group_rows(file, rows);
  for (const peer::BundleClass& one : file.network.bundle_classes) {
    rows.emplace_back(
        "", fmt::format("of type {} {}", peer::entity_type_numbers(one.type), wait_of(one.policy)));
  }
  for (std::string& note : scene_notes(file)) rows.emplace_back("note", std::move(note));
  for (std::string& warning : group_warnings(file))
    rows.emplace_back("warning", std::move(warning));
  for (const peer::OperatorConfig& hand : file.operators) {
    rows.emplace_back("operator", hand.kind == peer::OperatorKind::trace
                                      ? fmt::format("trace {}", hand.trace.string())
                                      : std::string(peer::word_of(hand.kind)));
  }
  return rows;
}

SettingRows scene_limits(const peer::SceneFile& file) {
  const peer::PeerOptions options;
  const bool adaptive = file.convergence.prediction == peer::Prediction::adaptive;
  // A row, its sender's clock, its history, and its entries in indices and columns.
  constexpr std::size_t kPlaces = 64;
  const std::size_t row = sizeof(peer::RemoteEntity) + sizeof(peer::SenderClock) + kPlaces +
                          (adaptive ? sizeof(deadreckon::AdaptiveOrder) : 0);
  const std::size_t entities = file.network.entities;
  constexpr double kMebi = 1024.0 * 1024.0;
  return {
      {"remote entities",
       fmt::format("{} rows of {} octets, {:.0f} MiB when full; memory is used as it fills; "
                   "further ones are counted (table_full) and not shown; [network] entities",
                   entities, row, static_cast<double>(entities * row) / kMebi)},
      {"rings of datagrams",
       fmt::format(
           "{:.3g} MiB each way; memory is used as they fill; when full, received datagrams wait "
           "in the kernel (read_waits), and sent ones are dropped (write_overflow)",
           static_cast<double>(options.datagram_ring) / kMebi)},
      {"felt by a hand",
       fmt::format("the {1} nearest bodies within {0}; further ones are counted (hands_unfelt)",
                   format_quantity(peer::kContactReach, "m"), haptics::kMaxRemoteHands)},
      {"moving objects",
       fmt::format(
           "{0} at most, {1} of them awake; while {1} are awake, no other one wakes (not_woken)",
           peer::kMostOwnable, haptics::BodyWorld::kMostActive)},
      {"devices of a peer", fmt::format("{} at most", peer::kMaxDevices)},
      {"peers known", fmt::format("{}; further ones are counted (peers_not_joined)",
                                  aoim::PresenceConfig{}.capacity)},
      {"rows of a picture",
       fmt::format("the {} remote entities nearest to the first hand; all are counted",
                   peer::PeerView::kRows)},
  };
}

}  // namespace reckon::tools
