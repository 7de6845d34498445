// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two peers with a hand each, and one body: what the hands feel, beside a run of both hands at one
// peer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/servo/pressing_hands.hpp"
#include "reckon/tests/integration/owners_exercise.hpp"

namespace reckon::test {

/// A body and the laws of two hands, which begin at time 0.
struct OneBody {
  double mass = 1.0;       ///< [kg]
  double stiffness = 500;  ///< [N/m]
  double side = 0.08;      ///< [m], of the cube
  double length = 0.0;     ///< [m], along x; 0: the side
  double hand = 300;       ///< [N/m], of the people's hands
  double drag = 0.0;       ///< [N s/m]
  bool is_heavy = false;   ///< it lies on a floor; else there is no weight
  double seconds = 5.0;    ///< length of the run
  double grab = 0.0;       ///< [N/m], of hands that hold it
  double beside = 0.0;     ///< [m], along x: place of a second such body; 0: none
  std::array<haptics::HandScript, 2> laws{};

  [[nodiscard]] double half() const { return 0.5 * side; }
  [[nodiscard]] Eigen::Vector3d inertia() const {
    const double along = length > 0 ? length : side;
    return mass / 12 *
           Eigen::Vector3d(2 * side * side, along * along + side * side,
                           along * along + side * side);
  }
  [[nodiscard]] std::string scene() const;
};

/// One millisecond.
struct OneBodyStep {
  std::array<Eigen::Vector3d, 2> force{};  ///< on the hands [N]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
  int owner = -1;                  ///< peer that simulates it; -1: none
  int owners = 0;                  ///< peers that do
  std::array<double, 2> stated{};  ///< energy that a hand states to have put into bodies [J]
  /// Work of both hands, loss in their devices, and loans of their ports, minus the energy of the
  /// body [J].
  double energy = 0.0;
};

struct OneBodyLine {
  double delay = 0.0;  ///< [s], one way, +-15 %
  double loss = 0.0;
  std::uint64_t seed = 1;
  bool requests_at_touch = false;               ///< see PeerOptions
  double loan = haptics::PressingHands::kLoan;  ///< [J], see PeerOptions::body_loan
  double late = 0.0;                            ///< share of the servo steps that are left out
  std::array<double, 2> outage{};               ///< [s], from and to
  int failing = -1;                             ///< peer that is killed; -1: none
  double fails_at = 0.0;                        ///< [s]
  double alone_at = 1e9;                        ///< [s], when the user lets peer 1 go on alone
};

/// Target that moves smoothly from 0 to 1 between two times.
[[nodiscard]] inline double eased(double time, double from, double to) {
  const double u = std::clamp((time - from) / (to - from), 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

inline std::string OneBody::scene() const {
  const std::string weight = is_heavy ? "-9.81" : "0";
  std::string text = "[scene]\ngravity = \"0 0 " + weight + " m/s2\"\n[hand]\nk1 = \"300 N/m\"\n";
  text += "patch_radius = \"10 mm\"\n";
  if (grab > 0) text += "grab_viscosity = 2\ngrab_stiffness = " + std::to_string(grab) + "\n";
  text += "[[operator]]\npassive = true\n[[device]]\npeer = 1\noperator = 1\n";
  text += "[[device]]\npeer = 2\noperator = 1\n";
  if (is_heavy)
    text +=
        "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\nbody_friction = 0.6\n"
        "surface = {stiffness = \"500 N/m\"}\n";
  const std::string edge = std::to_string(1e3 * side);
  const std::string along = length > 0 ? std::to_string(1e3 * length) : edge;
  const auto add = [&](const std::string& name, double x) {
    text += "[[object]]\nname = \"" + name + "\"\nbox = \"" + along + " " + edge + " " + edge +
            " mm\"\nposition = [" + std::to_string(x) + ", 0, " +
            std::to_string(is_heavy ? half() : 0.0) + "]\nmass = " + std::to_string(mass) +
            "\nbody_friction = 0.6\nbody_drag = " + std::to_string(drag) +
            "\nsurface = {stiffness = " + std::to_string(stiffness) +
            "}\nfriction = {static = 0.9, kinetic = 0.8}\n";
  };
  add("cube", 0.0);
  if (beside > 0) add("other", beside);
  return text;
}

/// Runs it at one peer, which has both hands, or at two over a line.
class OneBodyRun {
 public:
  explicit OneBodyRun(const OneBody& body) : OneBodyRun(body, 1, {}) {}
  OneBodyRun(const OneBody& body, const OneBodyLine& line) : OneBodyRun(body, 2, line) {}

  [[nodiscard]] const std::vector<OneBodyStep>& steps() const { return steps_; }
  [[nodiscard]] peer::Peer& peer(std::size_t i) { return *peers_[i]; }
  /// Root mean square of the difference of both forces, over that of the true ones.
  [[nodiscard]] double error(const OneBodyRun& truth) const;
  /// The same of the mean forces of the last second, of the worse hand.
  [[nodiscard]] double steady_error(const OneBodyRun& truth) const;
  [[nodiscard]] double peak() const;
  /// Greatest change of the second hand's force within a millisecond [N], in the 50 ms after its
  /// peer gets the body.
  [[nodiscard]] double step_at_change() const;
  /// Way of the body within the second from `begin` [s] on, up and down [m].
  [[nodiscard]] double swing(double begin) const;
  /// Least energy of the hands, minus that of the body, plus what is on the line [J]: stated by the
  /// hand of the other peer within kStated, then taken back.
  [[nodiscard]] double least_energy() const;
  /// Least energy of the port of a hand, with what it may have lost by late steps [J].
  [[nodiscard]] double least_port(std::size_t hand);
  /// Time of the first force on a hand [ms], and since when its peer has owned the body then.
  [[nodiscard]] std::pair<std::size_t, std::size_t> touch_of(std::size_t hand) const;

 private:
  static constexpr double kBegin = 3.0;           // [s], of the laws
  static constexpr std::ptrdiff_t kStated = 600;  // [ms], age of a statement that counts, at most

  OneBodyRun(const OneBody& body, std::size_t peers, const OneBodyLine& line);
  void record(const OneBody& body);
  [[nodiscard]] const haptics::ServoSnapshot& servo_of(std::size_t hand);

  peer::ManualClock clock_{seconds(1), std::chrono::hours(1)};
  peer::SimulatedNetwork network_;
  peer::SceneFile scene_;
  std::array<std::unique_ptr<haptics::SimulatedDevice>, 2> hands_;
  std::vector<std::unique_ptr<peer::Peer>> peers_;
  std::vector<OneBodyStep> steps_;
};

inline OneBodyRun::OneBodyRun(const OneBody& body, std::size_t peers, const OneBodyLine& line)
    : network_({.links = 2, .seed = line.seed}, clock_), scene_(scene_of(body.scene())) {
  const auto delay = nanoseconds(std::llround(1e9 * line.delay));
  const auto impair = [&](double loss) {
    network_.impair(line_of(delay * 85 / 100, delay * 3 / 10, loss));
  };
  impair(line.loss);
  for (std::size_t i = 0; i < 2; ++i) {
    haptics::SimulatedDeviceConfig config;
    config.hand_stiffness = body.hand;
    config.max_force = 20;
    config.start = body.laws[i](0).position;
    const auto late = [law = body.laws[i]](double t) { return law(std::max(0.0, t - kBegin)); };
    hands_[i] = std::make_unique<haptics::SimulatedDevice>(config, late);
  }
  std::array<peer::PeerDevice, 2> devices;
  for (std::size_t i = 0; i < 2; ++i) devices[i].device = hands_[i].get();
  for (std::size_t i = 0; i < peers; ++i) {
    peer::PeerOptions own;
    own.application = static_cast<std::uint16_t>(i + 1);
    own.epoch = static_cast<std::uint32_t>(i + 1);
    own.started =
        static_cast<std::uint32_t>(std::chrono::duration_cast<seconds>(clock_.utc_now()).count());
    own.scene_peer = static_cast<std::uint8_t>(i + 1);
    own.requests_at_touch = line.requests_at_touch;
    own.body_loan = line.loan;
    const std::span<const peer::PeerDevice> all(devices);
    peers_.push_back(std::make_unique<peer::Peer>(scene_, own, network_.link(i),
                                                  peers == 1 ? all : all.subspan(i, 1)));
    peers_.back()->start(clock_.now());
  }
  const auto count = static_cast<std::size_t>(1000 * (kBegin + body.seconds));
  std::mt19937 random(static_cast<std::uint32_t>(line.seed));
  std::bernoulli_distribution is_late(line.late);
  for (std::size_t i = 0; i < count; ++i) {
    clock_.advance(milliseconds(1));
    const double time = 1e-3 * static_cast<double>(i) - kBegin;
    if (line.outage[1] > 0) {
      const bool is_cut = time >= line.outage[0] && time < line.outage[1];
      impair(is_cut ? 1.0 : line.loss);
    }
    if (line.failing >= 0 && time >= line.fails_at)
      peers_[static_cast<std::size_t>(line.failing)].reset();
    if (std::abs(time - line.alone_at) < 5e-4) peers_[1]->model().ownership().go_alone();
    for (const auto& peer : peers_) {
      if (!peer) continue;
      if (!is_late(random)) peer->servo_step(clock_.now());
      peer->read_step(clock_.now());
      peer->model_step(clock_.now(), clock_.utc_now());
      peer->write_step();
    }
    if (i >= static_cast<std::size_t>(1000 * kBegin)) record(body);
  }
}

inline void OneBodyRun::record(const OneBody& body) {
  OneBodyStep& step = steps_.emplace_back();
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    if (!peers_[i]) continue;
    const haptics::BodyState& state = peers_[i]->bodies()->states()[0];
    if (!state.is_owned()) continue;
    step.owner = static_cast<int>(i);
    ++step.owners;
    step.place = state.position;
    step.turned = state.orientation;
    step.energy = -0.5 * body.mass * state.velocity.squaredNorm();
    const Eigen::Vector3d turning = state.orientation.conjugate() * state.turn_rate;
    step.energy -= 0.5 * turning.cwiseAbs2().dot(body.inertia());
    if (body.is_heavy) step.energy -= body.mass * 9.81 * (state.position.z() - body.half());
  }
  for (std::size_t i = 0; i < 2; ++i) {
    step.force[i] = hands_[i]->force();
    step.energy += hands_[i]->port_work() + hands_[i]->damping_loss();
    if (i >= peers_.size() || !peers_[i]) continue;
    const haptics::ServoSnapshot& servo = servo_of(i);
    step.stated[i] = servo.tally.body_energy;
    step.energy += servo.loan + servo.source_energy() + servo.encoder_allowance + servo.late_cost;
  }
}

inline double OneBodyRun::error(const OneBodyRun& truth) const {
  double off = 0.0, all = 0.0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      off += (steps_[i].force[k] - truth.steps_[i].force[k]).squaredNorm();
      all += truth.steps_[i].force[k].squaredNorm();
    }
  }
  return std::sqrt(off / all);
}

inline double OneBodyRun::steady_error(const OneBodyRun& truth) const {
  double worst = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    Eigen::Vector3d off = Eigen::Vector3d::Zero(), all = off;
    for (std::size_t i = steps_.size() - 1000; i < steps_.size(); ++i) {
      off += steps_[i].force[k] - truth.steps_[i].force[k];
      all += truth.steps_[i].force[k];
    }
    worst = std::max(worst, off.norm() / all.norm());
  }
  return worst;
}

inline double OneBodyRun::peak() const {
  double most = 0.0;
  for (const OneBodyStep& step : steps_)
    for (const Eigen::Vector3d& force : step.force) most = std::max(most, force.norm());
  return most;
}

inline const haptics::ServoSnapshot& OneBodyRun::servo_of(std::size_t hand) {
  const bool is_alone = peers_.size() == 1;
  peer::Peer& peer = *peers_[is_alone ? 0 : hand];
  peer.views().update();
  return peer.views().read().hands[is_alone ? hand : 0].servo;
}

inline double OneBodyRun::least_port(std::size_t hand) {
  const haptics::ServoSnapshot& servo = servo_of(hand);
  return servo.port_energy_min + servo.late_cost;
}

inline double OneBodyRun::least_energy() const {
  double least = steps_.front().energy;
  for (auto step = steps_.begin(); step != steps_.end(); ++step) {
    if (step->energy > least || step->owner < 0) continue;
    const std::size_t other = step->owner == 0 ? 1 : 0;
    const auto from = step - std::min(step - steps_.begin(), kStated);
    const auto stated = [other](const OneBodyStep& one) { return one.stated[other]; };
    const double most = stated(std::ranges::max(std::ranges::subrange(from, step + 1), {}, stated));
    least = std::min(least, step->energy + most - step->stated[other]);
  }
  return least;
}

inline double OneBodyRun::step_at_change() const {
  const auto at = std::ranges::find(steps_, 1, &OneBodyStep::owner);
  double most = 0.0;
  for (auto step = at; step != steps_.end() && step < at + 50; ++step)
    most = std::max(most, (step->force[1] - (step - 1)->force[1]).norm());
  return most;
}

inline double OneBodyRun::swing(double begin) const {
  const auto from = steps_.begin() + std::lround(1000 * begin);
  const auto height = [](const OneBodyStep& step) { return step.place.z(); };
  const auto [least, most] = std::ranges::minmax(std::span(from, 1000), {}, height);
  return height(most) - height(least);
}

inline std::pair<std::size_t, std::size_t> OneBodyRun::touch_of(std::size_t hand) const {
  std::size_t touch = 0;
  while (touch < steps_.size() && steps_[touch].force[hand].isZero(0.0)) ++touch;
  std::size_t owned = touch;
  while (owned > 0 && owned < steps_.size() && steps_[owned].owner == static_cast<int>(hand))
    --owned;
  return {touch, touch - owned};
}

}  // namespace reckon::test
