// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/peer.hpp"

#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kShownRing = 8192;

haptics::ServoConfig servo_config(const SceneFile& scene, const PeerOptions& options) {
  haptics::ServoConfig config;
  config.period = options.servo_period;
  config.probe_radius = scene.hand.radius;
  config.transfer = options.transfer;
  return config;
}

}  // namespace

Peer::Peer(const SceneFile& scene, const PeerOptions& options, Link& link,
           haptics::HapticDevice& device)
    : scene_(scene),
      link_(link),
      frame_(scene.origin.latitude, scene.origin.longitude, scene.origin.height),
      pool_(scene.network.group, scene.aoim.pool),
      commands_(4 * scene.aoim.pool + 16),
      inbound_(options.datagram_ring),
      outbound_(options.datagram_ring),
      shown_(options.record_shown ? kShownRing : 2),
      servo_(device, haptics::EffectPlan(scene.scene), servo_config(scene, options)),
      read_(link, commands_, inbound_, counters_),
      write_(link, outbound_, counters_),
      model_(
          {scene_, frame_, pool_, servo_.snapshots(), servo_.contacts(), inbound_, outbound_,
           commands_, options.record_shown ? &shown_ : nullptr, counters_},
          {{options.site, options.application, 1}, options.name, options.epoch, options.started}) {}

Peer::~Peer() = default;

void Peer::start(std::chrono::nanoseconds now) {
  model_.start(now);
  read_.step(now);  // the base group is joined before the first word is said
}

void Peer::stop(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept {
  model_.stop(now, utc);
  write_.step();
}

}  // namespace reckon::peer
