// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers of one scene over a simulated network, which own its cubes and give them to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/world/shared_bodies.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {

/// A floor and `count` cubes of 50 g in a row along x, 0.1 m apart, `height` [m] above it; two
/// devices.
[[nodiscard]] inline std::string cubes_scene(std::size_t count, double height = 0.02,
                                             std::string_view network = "") {
  std::string text = R"(
[[object]]
name = "floor"
plane = [0, 0, 1]
surface = {stiffness = "400 N/m"}

[[operator]]
passive = true

[[device]]
peer = 1
operator = 1

[[device]]
peer = 2
operator = 1
)";
  text += "[network]\n" + std::string(network) + "\n";
  for (std::size_t i = 0; i < count; ++i) {
    text += "[[object]]\nname = \"cube" + std::to_string(i) +
            "\"\nbox = \"40 40 40 mm\"\nposition = [" +
            std::to_string(0.1 * static_cast<double>(i)) + ", 0, " + std::to_string(height) +
            "]\nmass = \"50 g\"\nbody_friction = 0.4\nsurface = {stiffness = \"400 N/m\"}\n";
  }
  return text;
}

/// Peers without hands, at first; one millisecond a step.
class OwnersExercise {
 public:
  OwnersExercise(std::size_t links, const std::string& scene)
      : clock_(seconds(1), std::chrono::hours(1)),
        network_({.links = links}, clock_),
        scene_(scene_of(scene)),
        peers_(links),
        hands_(links),
        stopped_(links, false) {}

  /// @param scene_peer its number in the scene; 0: it owns no body
  peer::Peer& start(std::size_t link, std::uint8_t scene_peer) {
    return start(link, scene_peer, {});
  }
  peer::Peer& start_with_hand(std::size_t link, std::uint8_t scene_peer, haptics::HandScript law) {
    haptics::SimulatedDeviceConfig config;
    config.hand_stiffness = 300;
    config.start = law(0).position;
    hands_[link] = std::make_unique<haptics::SimulatedDevice>(config, std::move(law));
    peer::PeerDevice device;
    device.device = hands_[link].get();
    return start(link, scene_peer, std::span(&device, 1));
  }
  void start_all() {
    for (std::size_t i = 0; i < peers_.size(); ++i) start(i, static_cast<std::uint8_t>(i + 1));
  }
  void kill(std::size_t link) { peers_[link].reset(); }
  /// The process gets no processor time until resume().
  void stop(std::size_t link) { stopped_[link] = true; }
  void resume(std::size_t link) { stopped_[link] = false; }

  void step() {
    clock_.advance(milliseconds(1));
    for (std::size_t i = 0; i < peers_.size(); ++i) {
      if (!peers_[i] || stopped_[i]) continue;
      peers_[i]->servo_step(clock_.now());
      peers_[i]->read_step(clock_.now());
      peers_[i]->model_step(clock_.now(), clock_.utc_now());
      peers_[i]->write_step();
    }
  }
  void run(std::size_t steps) {
    for (std::size_t i = 0; i < steps; ++i) step();
  }
  /// Steps until it holds.  @return the steps, or `most`
  std::size_t run_until(auto&& holds, std::size_t most) {
    for (std::size_t i = 0; i < most; ++i) {
      if (holds()) return i;
      step();
    }
    return most;
  }

  [[nodiscard]] peer::Peer& peer(std::size_t link) { return *peers_[link]; }
  [[nodiscard]] bool lives(std::size_t link) const { return peers_[link] != nullptr; }
  [[nodiscard]] std::size_t size() const { return peers_.size(); }
  [[nodiscard]] peer::SimulatedNetwork& network() { return network_; }
  [[nodiscard]] nanoseconds now() const { return clock_.now(); }
  [[nodiscard]] nanoseconds utc_now() const { return clock_.utc_now(); }
  [[nodiscard]] const peer::SceneFile& scene() const { return scene_; }
  [[nodiscard]] peer::OwnershipStage& owners(std::size_t link) {
    return peers_[link]->model().ownership();
  }
  /// Whether this peer's world simulates the body now.
  [[nodiscard]] bool simulates(std::size_t link, std::size_t body) {
    return !peers_[link]->bodies()->states()[body].carried;
  }
  /// Peers whose world simulates the body now.
  [[nodiscard]] std::size_t simulating(std::size_t body) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < peers_.size(); ++i)
      count += peers_[i] && simulates(i, body) ? 1 : 0;
    return count;
  }
  [[nodiscard]] const haptics::BodyState& body(std::size_t link, std::size_t body) {
    return peers_[link]->bodies()->states()[body];
  }
  /// Its motion as this peer simulates or shows it.
  [[nodiscard]] haptics::ObjectMotion shown(std::size_t link, std::size_t number) {
    const peer::RemoteEntity* row = peers_[link]->model().remote().find(peer::body_id(number));
    if (simulates(link, number) || row == nullptr) return body(link, number);
    return peer::motion_of(row->shown(clock_.now()));
  }
  /// The epoch that this peer names as the owner.
  [[nodiscard]] std::uint32_t owner(std::size_t link, std::size_t body) {
    return owners(link).owner_of(body).owner;
  }
  [[nodiscard]] std::uint32_t epoch(std::size_t link) const { return epochs_[link]; }
  [[nodiscard]] std::uint64_t count(std::size_t link, std::string_view counter) {
    const peer::Counter* found = peers_[link]->counters().find(counter);
    EXPECT_NE(found, nullptr) << counter;
    return found == nullptr ? 0 : found->value();
  }
  std::vector<std::string> notices(std::size_t link) {
    std::vector<std::string> texts;
    while (const peer::Notice* notice = peers_[link]->notices().front()) {
      texts.emplace_back(notice->text.data());
      peers_[link]->notices().pop();
    }
    return texts;
  }

 private:
  peer::Peer& start(std::size_t link, std::uint8_t scene_peer,
                    std::span<const peer::PeerDevice> devices) {
    peer::PeerOptions own;
    own.application = static_cast<std::uint16_t>(link + 1);
    own.epoch = epochs_[link] = ++lives_;
    own.started =
        static_cast<std::uint32_t>(std::chrono::duration_cast<seconds>(clock_.utc_now()).count());
    own.scene_peer = scene_peer;
    peers_[link] = std::make_unique<peer::Peer>(scene_, own, network_.link(link), devices);
    peers_[link]->start(clock_.now());
    return *peers_[link];
  }

  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  peer::SceneFile scene_;
  std::vector<std::unique_ptr<peer::Peer>> peers_;
  std::vector<std::unique_ptr<haptics::SimulatedDevice>> hands_;
  std::vector<bool> stopped_;
  std::array<std::uint32_t, 16> epochs_{};
  std::uint32_t lives_ = 0;
};

[[nodiscard]] inline peer::ImpairmentLaw line_of(nanoseconds delay, nanoseconds jitter,
                                                 double loss) {
  peer::ImpairmentLaw law;
  law.delay = delay;
  law.jitter = jitter;
  law.loss = loss;
  return law;
}

}  // namespace reckon::test
