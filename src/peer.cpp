// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/peer.hpp"

#include <array>

#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kShownRing = 8192;

haptics::ServoConfig servo_config(const SceneFile& scene, const PeerOptions& options,
                                  const PeerDevice& device) {
  haptics::ServoConfig config;
  config.period = options.servo_period;
  config.device_origin = device.origin;
  config.device_orientation = device.orientation;
  config.probe_radius = scene.hand.radius;
  config.transfer = options.transfer;
  return config;
}

std::vector<std::unique_ptr<haptics::ServoLoop>> make_servos(const SceneFile& scene,
                                                             const PeerOptions& options,
                                                             std::span<const PeerDevice> devices) {
  std::vector<std::unique_ptr<haptics::ServoLoop>> servos;
  for (const PeerDevice& device : devices) {
    servos.push_back(std::make_unique<haptics::ServoLoop>(
        *device.device, haptics::EffectPlan(scene.scene), servo_config(scene, options, device)));
  }
  return servos;
}

std::string marking_of(const PeerOptions& options, const PeerDevice& device, std::size_t index) {
  if (!device.marking.empty()) return device.marking;
  return index == 0 ? options.name : options.name + std::to_string(index + 1);
}

}  // namespace

Peer::Peer(const SceneFile& scene, const PeerOptions& options, Link& link,
           std::span<const PeerDevice> devices)
    : scene_(scene),
      link_(link),
      frame_(scene.origin.latitude, scene.origin.longitude, scene.origin.height),
      pool_(scene.network.group, scene.aoim.pool),
      commands_(4 * scene.aoim.pool + 16),
      inbound_(options.datagram_ring),
      outbound_(options.datagram_ring),
      shown_(options.record_shown ? kShownRing : 2),
      servos_(make_servos(scene, options, devices)),
      read_(link, commands_, inbound_, counters_),
      write_(link, outbound_, counters_),
      model_({scene_, frame_, pool_, inbound_, outbound_, commands_,
              options.record_shown ? &shown_ : nullptr, counters_, options.capacity,
              options.record_changes},
             {{options.site, options.application},
              options.name,
              options.epoch,
              options.started,
              !devices.empty()}) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    model_.add_hand(marking_of(options, devices[i], i), servos_[i]->snapshots(),
                    servos_[i]->contacts());
  }
}

Peer::Peer(const SceneFile& scene, const PeerOptions& options, Link& link,
           haptics::HapticDevice& device)
    : Peer(scene, options, link, std::array<PeerDevice, 1>{PeerDevice{&device, {}}}) {}

Peer::~Peer() = default;

void Peer::start(std::chrono::nanoseconds now) {
  model_.start(now);
  read_.step(now);  // the base group is joined before the first word is said
}

void Peer::stop(std::chrono::nanoseconds now, std::chrono::nanoseconds utc) noexcept {
  bool done = false;
  while (!done) {
    done = model_.stop(now, utc);
    write_.step();
  }
}

}  // namespace reckon::peer
