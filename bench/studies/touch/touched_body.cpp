// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/touch/touched_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"

namespace reckon::bench {
namespace {

using haptics::HandTarget;

constexpr double kBodyMass = 1.0;       // [kg]
constexpr double kGripStiffness = 300;  // of a hand [N/m]
constexpr std::size_t kSettles = 3000;  // [ms], before the hands move
constexpr double kDelaySpread = 0.15;   // of the delay

constexpr std::array kOwnerRules{
    OwnerRuleRow{OwnerRule::fixed, "fixed"},
    OwnerRuleRow{OwnerRule::first_hand, "first hand"},
    OwnerRuleRow{OwnerRule::before_touch, "before touch"},
};

HandTarget target_at(double x, double y = 0) {
  HandTarget target;
  target.position = {x, y, 0};
  return target;
}

/// The first hand is far from the body, except in a squeeze.
HandTarget one_hand(std::size_t hand, double x) {
  return hand == 0 ? target_at(0, 1) : target_at(x);
}

/// From 0 to 1, smoothly.
double eased(double time, double from, double to) {
  const double u = std::clamp((time - from) / (to - from), 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

HandTarget pushing(std::size_t hand, double t) {
  return one_hand(hand, -0.16 + 0.15 * std::max(0.0, t - 0.3));
}

HandTarget holding(std::size_t hand, double t) {
  return one_hand(hand, -0.12 + 0.115 * eased(t, 0.3, 1.3));
}

HandTarget squeezing(std::size_t hand, double t) {
  const double side = hand == 0 ? -1 : 1;
  return target_at(side * (0.1 - 0.075 * eased(t, 0.3, 1.3)) + 0.04 * eased(t, 2, 3));
}

HandTarget catching(std::size_t hand, double) { return one_hand(hand, 0.1); }

constexpr std::array kBodyTouches{
    BodyTouch{"push", "a hand pushes the body at 0.15 m/s", 2.5, "", 0.2, 0, 0, pushing},
    BodyTouch{"hold", "a hand pushes the body 20 mm to a wall and holds it there with 2.8 N", 3.5,
              "[[object]]\nname = \"wall\"\nplane = [-1, 0, 0]\nposition = [0.06, 0, 0]\n", 0.2, 0,
              0, holding},
    BodyTouch{"squeeze", "two hands press the body from two sides and carry it 40 mm", 4, "", 2.0,
              0, 0, squeezing},
    BodyTouch{"catch", "a hand at rest stops the body, which comes at 0.5 m/s", 2.5, "", 0, -0.6,
              0.5, catching},
};

peer::SceneFile scene_of_touch(const BodyTouch& touch) {
  const std::string text = fmt::format(
      "[scene]\ngravity = \"0 0 0 m/s2\"\n{}[hand]\nk1 = \"300 N/m\"\npatch_radius = \"10 mm\"\n"
      "[[operator]]\npassive = true\n"
      "[[device]]\npeer = 1\noperator = 1\n[[device]]\npeer = 2\noperator = 1\n"
      "[[object]]\nname = \"cube\"\nbox = \"80 80 80 mm\"\nposition = [{}, 0, 0]\n"
      "mass = {}\nbody_friction = 0.6\nbody_drag = {}\nsurface = {{stiffness = \"500 N/m\"}}\n"
      "friction = {{static = 0.9, kinetic = 0.8}}\n",
      touch.objects, touch.from, kBodyMass, touch.drag);
  return peer::parse_scene_file(text, std::string(touch.name));
}

/// One run: the peers, their hands, and the network between them.
class TouchedBody {
 public:
  TouchedBody(const BodyTouch& touch, std::size_t peers, OwnerRule rule,
              const BodyTouchNetwork& network);
  BodyTouchRun run(OwnerRule rule);

 private:
  void add_peer(std::size_t number, std::size_t peers, OwnerRule rule);
  void prepare(OwnerRule rule);
  /// CPU time of the servo step of a peer, mean of the peers [ns].
  double step();

  const BodyTouch& touch_;
  peer::ManualClock clock_{std::chrono::seconds(1), std::chrono::hours(1)};
  peer::SimulatedNetwork network_;
  peer::SceneFile scene_;
  std::array<std::unique_ptr<haptics::SimulatedDevice>, 2> hands_;
  std::array<peer::PeerDevice, 2> devices_;
  std::vector<std::unique_ptr<peer::Peer>> peers_;
};

TouchedBody::TouchedBody(const BodyTouch& touch, std::size_t peers, OwnerRule rule,
                         const BodyTouchNetwork& network)
    : touch_(touch),
      network_({.links = 2, .seed = network.seed}, clock_),
      scene_(scene_of_touch(touch)) {
  network_.impair(peer::delayed_by(network.delay, kDelaySpread, network.loss));
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    haptics::SimulatedDeviceConfig config;
    config.hand_stiffness = kGripStiffness;
    config.max_force = 20;
    config.start = touch.hand(i, 0).position;
    hands_[i] = std::make_unique<haptics::SimulatedDevice>(
        config, [hand = touch.hand, i](double t) { return hand(i, t - 1e-3 * kSettles); });
    devices_[i].device = hands_[i].get();
  }
  for (std::size_t i = 0; i < peers; ++i) add_peer(i, peers, rule);
}

void TouchedBody::add_peer(std::size_t number, std::size_t peers, OwnerRule rule) {
  peer::PeerOptions own;
  own.application = static_cast<std::uint16_t>(number + 1);
  own.epoch = static_cast<std::uint32_t>(number + 1);
  own.started = static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::seconds>(clock_.utc_now()).count());
  own.scene_peer = static_cast<std::uint8_t>(number + 1);
  own.requests_at_touch = rule == OwnerRule::first_hand;
  const std::span<const peer::PeerDevice> all(devices_);
  peers_.push_back(std::make_unique<peer::Peer>(scene_, own, network_.link(number),
                                                peers == 1 ? all : all.subspan(number, 1)));
  peers_.back()->start(clock_.now());
}

double TouchedBody::step() {
  clock_.advance(std::chrono::milliseconds(1));
  double servo = 0;
  for (const auto& peer : peers_) {
    servo += cpu_ns_of([&] { peer->servo_step(clock_.now()); });
    peer->read_step(clock_.now());
    peer->model_step(clock_.now(), clock_.utc_now());
    peer->write_step();
  }
  return servo / static_cast<double>(peers_.size());
}

/// The first peer owns the body from the first step on.
void TouchedBody::prepare(OwnerRule rule) {
  step();
  peer::OwnershipStage& owner = peers_.front()->model().ownership();
  if (rule == OwnerRule::fixed) owner.acquire(0);
  for (std::size_t i = 1; i < kSettles; ++i) step();
  if (touch_.speed == 0) return;
  haptics::BodyOrder order{haptics::BodyAct::push, 0};
  order.impulse = {kBodyMass * touch_.speed, 0, 0};
  order.point = {touch_.from, 0, 0};
  owner.order(order);
}

BodyTouchRun TouchedBody::run(OwnerRule rule) {
  prepare(rule);
  BodyTouchRun run;
  std::vector<double> costs;
  for (std::size_t i = 0; i < static_cast<std::size_t>(1e3 * touch_.seconds); ++i) {
    const double cost = step();
    for (const auto& hand : hands_) run.forces.push_back(hand->force());
    if (!run.forces.back().isZero(0) || !run.forces.end()[-2].isZero(0)) costs.push_back(cost);
  }
  if (!costs.empty()) run.cost = {quantile(costs, 0.5), quantile(costs, 0.1), quantile(costs, 0.9)};
  return run;
}

}  // namespace

std::span<const OwnerRuleRow> owner_rules() { return kOwnerRules; }
std::span<const BodyTouch> body_touches() { return kBodyTouches; }

BodyTouchRun run_body_touch(const BodyTouch& touch, std::size_t peers, OwnerRule rule,
                            const BodyTouchNetwork& network) {
  return TouchedBody(touch, peers, rule, network).run(rule);
}

}  // namespace reckon::bench
