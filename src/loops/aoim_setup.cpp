// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/aoim_setup.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/life_proof.hpp"
#include "reckon/peer/loops/tier_foci.hpp"
#include "reckon/peer/notation/beacon_names.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {

namespace {

// ::ffff:0.0.0.0
constexpr std::array<std::uint8_t, 16> kIpv4Mapped{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF};

void add_awareness(const AwarenessConfig& awareness, aoim::AreaOfInterestConfig& config) {
  config.interest.kinds = awareness.kinds_wanted;
  if (awareness.aura > 0.0) config.interest.aura = awareness.aura;
  for (const OccluderConfig& box : awareness.occluders)
    config.interest.occluders.push_back({to_position(box.from), to_position(box.to)});
  for (const NimbusClass& one : awareness.nimbus)
    config.farthest_nimbus = std::max(config.farthest_nimbus, one.nimbus);
}

aoim::TierTable tiers_of(const SceneFile& scene) { return {tier_kinds_of(scene), scene.aoim.pool}; }

// [s]. All members have the same scene, so none of them states a longer one.
double longest_validity(const SceneFile& scene) {
  double longest = pdu::to_seconds(scene.hand.validity);
  for (const EntityConfig& entity : scene.entities) {
    if (entity.model) longest = std::max(longest, entity.model->validity);
  }
  return longest;
}

}  // namespace

aoim::AreaOfInterestConfig aoim_config(const SceneFile& scene) {
  aoim::AreaOfInterestConfig config;
  config.grid.scheme = scene.aoim.scheme;
  config.grid.cell_size = scene.aoim.cell;
  config.grid.pool = scene.aoim.pool;
  config.cells = uneven_cells(scene.aoim);
  if (scene.aoim.scheme == aoim::CellScheme::quad_tree)
    config.subscription.leave_factor = config.interest.leave_factor = kTreeLeave;
  config.subscription.maximum_groups = scene.aoim.groups;
  config.aggregator.payload_limit = scene.network.bundle_max + config.aggregator.reserved;
  config.aggregator.exercise_id = scene.network.exercise;
  config.interop = scene.network.interop;
  config.presence.one_way = follow_chain;
  config.presence.keyed_hash = hash_with_key;
  add_awareness(scene.aoim.awareness, config);
  config.radius = scene.aoim.radius;
  config.channels = channels_of(scene.aoim.tiers);
  config.tiers = tier_kinds_of(scene);
  config.leader.on = scene.aoim.leaders;
  config.leader.hand_out = scene.aoim.hand_out;
  for (const std::string& name : beacon_names(scene.aoim.follow))
    config.follow.push_back(aoim::beacon_tag(name));
  return config;
}

aoim::AreaOfInterestConfig aoim_config(const SceneFile& scene, const deadreckon::LocalFrame& frame,
                                       const Link& link) {
  aoim::AreaOfInterestConfig config = aoim_config(scene);
  aoim::AggregatorConfig& bundles = config.aggregator;
  const std::size_t fits = std::max(link.max_payload(), aoim::kLeastPayload) + bundles.reserved;
  if (link.max_payload() > 0)  // else unknown
    bundles.payload_limit = std::min(bundles.payload_limit, fits);
  config.locate = [&frame](const pdu::WorldCoordinates& at) {
    return to_position(frame.scene_from_world(Eigen::Vector3d(at.x, at.y, at.z)));
  };
  return config;
}

std::vector<aoim::Channel> audience_rows_of(const AoimConfig& aoim) {
  if (own_group_count(aoim.tiers) == 0) return {};
  std::vector<aoim::Channel> rows = channels_of(aoim.tiers);
  std::erase_if(rows, [](const aoim::Channel& row) { return row.kept; });
  return rows;
}

OwnerSettings owner_settings(const SceneFile& scene, const ModelIdentity& identity) {
  return {identity.simulation,
          scene.network.exercise,
          scene.convergence.settings.teleport_distance,
          scene.network.compression,
          tiers_of(scene).urgent().size(),
          audience_rows_of(scene.aoim)};
}

RemoteSettings remote_settings(const SceneFile& scene) {
  RemoteSettings settings;
  settings.probe_radius = scene.hand.radius;
  settings.convergence = scene.convergence;
  settings.convergence.settings.threshold = scene.dead_reckoning.thresholds.position;
  settings.convergence.settings.threshold_angle = scene.dead_reckoning.thresholds.angle;
  settings.acceleration = scene.dead_reckoning.acceleration;
  settings.bodies_in_part = has_distance_tiers(scene.aoim.tiers);
  settings.nimbus = scene.aoim.awareness.nimbus;
  settings.capacity = scene.network.entities;
  settings.strangers_memory = scene.network.strangers_memory;
  settings.near_rows = own_group_count(scene.aoim.tiers);
  settings.touch = scene.network.touch_rule();
  settings.longest_validity = longest_validity(scene);
  return settings;
}

aoim::SourceAddress source_of(const IpEndpoint& sender, std::uint64_t boot) noexcept {
  aoim::SourceAddress source{sender.octets, sender.port, boot};
  if (sender.is_v6) return source;
  source.octets = kIpv4Mapped;
  std::copy_n(sender.octets.begin(), 4, source.octets.begin() + 12);
  return source;
}

IpEndpoint endpoint_of(const aoim::SourceAddress& source) noexcept {
  IpEndpoint sender{source.octets, true, source.port};
  if (!std::equal(kIpv4Mapped.begin(), kIpv4Mapped.begin() + 12, source.octets.begin()))
    return sender;
  sender = {{}, false, source.port};
  std::copy_n(source.octets.begin() + 12, 4, sender.octets.begin());
  return sender;
}

GroupPool pool_of(const SceneFile& scene) { return {scene.network.group, scene.aoim.all_groups()}; }

std::optional<GroupPool> urgent_pool_of(const SceneFile& scene) {
  const aoim::TierTable tiers = tiers_of(scene);
  if (tiers.urgent().empty()) return {};
  const std::size_t before = tiers.urgent().front() * scene.aoim.pool;
  return GroupPool(pool_of(scene).address(before - 1), scene.aoim.all_groups() - before);
}

GroupNeeds group_needs(const SceneFile& scene) {
  const aoim::AreaOfInterestConfig config = aoim_config(scene);
  if (scene.network.interop) return {};
  // Assigned groups: one for each cell, as long as there are free ones.
  const aoim::CellPartition cells = cells_of(scene.aoim);
  std::vector<std::size_t> within_tiers;
  for (const TierConfig& tier : scene.aoim.tiers) {
    within_tiers.push_back(has_group(tier) ? cells.groups_bound(tier_radius(scene, tier)) : 0);
  }
  return {cells.groups_bound(scene.aoim.radius + config.farthest_nimbus), cells.groups_in_use(),
          config.subscription.maximum_groups, std::move(within_tiers)};
}

pdu::Presence presence(const SceneFile& scene, const deadreckon::LocalFrame& frame,
                       const GroupPool& pool, const ModelIdentity& identity) {
  pdu::Presence own;
  own.header.exercise_id = scene.network.exercise;
  own.simulation = identity.simulation;
  own.epoch = identity.epoch;
  own.started = identity.started;
  own.port = pool.base().port;
  own.scene_hash = scene.hash;
  own.scene_peer = identity.scene_peer;
  own.base_group = pool.base().octets;
  if (!pool.base().is_v6) {
    const auto& v4 = pool.base().octets;
    own.base_group = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, v4[0], v4[1], v4[2], v4[3]};
  }
  if (identity.haptic) own.flags = pdu::kPresenceHaptic;
  own.scene_origin = {frame.origin().x(), frame.origin().y(), frame.origin().z()};
  own.interest_radius = static_cast<float>(scene.aoim.radius);
  own.set_name(identity.name);
  return own;
}

}  // namespace reckon::peer
