// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// N operators in a row press one another along x through N servos and a line with delay and loss:
// grips of 300 N/m, spheres that touch at rest.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/network/impairment.hpp"

namespace reckon::haptics {

struct RowLine {
  double delay = 0;            ///< [s], +-30 % each
  double loss = 0;             ///< probability
  double rate_hz = 0;          ///< fixed rate; 0 = by threshold
  double threshold_n = 0.015;  ///< [N], of the force error at the peer
  double longest = 0.06;       ///< [s], between two updates by threshold
};

struct RowHands {
  std::size_t count = 2;
  double stiffness = 500;  ///< [N/m], between hands
  double grip = 300, grip_damping = 3, mass = 0.1, damping = 1;
  int delay_samples = 0;  ///< of each device
  double resolution = 0;  ///< [m], of each device
  Scene scene = {};       ///< of walls, for each hand
  double friction = 0;
  double radius = 0.02;  ///< [m]
  /// Goal of the grip of hand i from its place [m], at t [s].
  std::function<double(std::size_t, double)> target;
  double start = 0;  ///< [m], of the first hand's device from its place
  /// Makes the device of hand i, instead of one that follows `target`; none: the latter.
  std::function<std::unique_ptr<SimulatedDevice>(std::size_t, const SimulatedDeviceConfig&)> make =
      {};
  ForceStop* stop = nullptr;  ///< of all servos
  /// Falsifies the state of hand i before it is sent.
  std::function<void(std::size_t, RemoteHand&)> lie = {};
};

/// Rises smoothly from 0 to 1 within [0, 1].
inline double smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Greatest force on each hand from a neighbour when the first grip is `press` [m] beyond the first
/// touch: springs in a row.
inline std::vector<double> row_truth(std::size_t count, double grip, double stiffness,
                                     double press) {
  const auto n = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  b(0) = grip * press;
  for (Eigen::Index i = 0; i < n; ++i) a(i, i) += grip;
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    a(i, i) += stiffness;
    a(i + 1, i + 1) += stiffness;
    a(i, i + 1) -= stiffness;
    a(i + 1, i) -= stiffness;
  }
  const Eigen::VectorXd x = a.partialPivLu().solve(b);
  std::vector<double> forces;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double left = i > 0 ? stiffness * (x(i - 1) - x(i)) : 0;
    const double right = i + 1 < n ? stiffness * (x(i) - x(i + 1)) : 0;
    forces.push_back(std::max(left, right));
  }
  return forces;
}

class HandsInARow {
 public:
  HandsInARow(const RowHands& hands, const RowLine& line, unsigned seed)
      : hands_(hands), line_(line), network_(peer::delayed_by(line.delay, 0.3, line.loss), seed) {
    for (std::size_t i = 0; i < hands.count; ++i) {
      const double place = static_cast<double>(i) * (2 * hands_.radius + 1e-6);  // from outside
      SimulatedDeviceConfig device;
      device.mass = hands.mass;
      device.damping = hands.damping;
      device.hand_stiffness = hands.grip;
      device.hand_damping = hands.grip_damping;
      device.delay_samples = hands.delay_samples;
      device.resolution = hands.resolution;
      device.start.x() = place + (i == 0 ? hands.start : 0.0);
      auto script = [this, i, place](double t) {
        HandTarget target;
        target.position.x() = place + hands_.target(i, t);
        return target;
      };
      devices_.push_back(hands_.make ? hands_.make(i, device) : nullptr);
      if (!devices_.back()) devices_.back() = std::make_unique<SimulatedDevice>(device, script);
      ServoConfig servo;
      servo.probe_radius = hands_.radius;
      servo.stop = hands_.stop;
      servos_.push_back(
          std::make_unique<ServoLoop>(*devices_.back(), EffectPlan(hands.scene), servo));
    }
    queues_.resize(hands.count);
    sent_.resize(hands.count);
    known_.resize(hands.count, std::vector<RemoteHand>(hands.count));
    most_loan_.resize(hands.count, 0.0);
  }

  /// One millisecond. @param connected whether datagrams arrive
  void step(bool connected = true) {
    const double t = time();
    for (std::size_t i = 0; i < servos_.size(); ++i) {
      deliver(i, t);
      servos_[i]->step(pdu::from_seconds(t) + std::chrono::milliseconds(1));
      servos_[i]->snapshots().update();
    }
    for (std::size_t i = 0; i < servos_.size(); ++i) {
      if (due(i, t)) send(i, t, connected);
    }
    measure();
    ++steps_;
  }

  [[nodiscard]] double time() const { return static_cast<double>(steps_) * 1e-3; }
  [[nodiscard]] const ServoSnapshot& snapshot(std::size_t hand) const {
    return servos_[hand]->snapshots().read();
  }
  [[nodiscard]] const SimulatedDevice& device(std::size_t hand) const { return *devices_[hand]; }
  [[nodiscard]] SimulatedDevice& device(std::size_t hand) { return *devices_[hand]; }
  /// Greatest force from one neighbour [N].
  [[nodiscard]] double felt(std::size_t hand) const {
    const ServoSnapshot& s = snapshot(hand);
    double most = 0;
    for (std::size_t i = 0; i < s.count; ++i) most = std::max(most, s.contacts[i].force.norm());
    return most;
  }
  /// True overlap of this hand and the next one [m].
  [[nodiscard]] double depth(std::size_t hand) const {
    return 2 * hands_.radius - (devices_[hand + 1]->position() - devices_[hand]->position()).norm();
  }
  /// Stiffness with which this hand and the next one render each other [N/m].
  [[nodiscard]] double shown_stiffness(std::size_t hand) const {
    return hands_.stiffness * snapshot(hand).softening * snapshot(hand + 1).softening;
  }
  /// Of all ports, including their loans [J].
  [[nodiscard]] double least_sum() const { return least_sum_; }
  [[nodiscard]] double least_port() const { return least_port_; }
  /// Least of port and loan together [J]: by guarantee no port owes more than its loan.
  [[nodiscard]] double least_unlent() const { return least_unlent_; }
  [[nodiscard]] double most_loan(std::size_t hand) const { return most_loan_[hand]; }
  [[nodiscard]] double peak() const { return peak_; }
  [[nodiscard]] std::uint64_t updates() const { return updates_; }

 private:
  struct Sent {
    double arrival;
    std::size_t from;
    RemoteHand hand;
  };
  struct Last {
    double time = -1, x = 0, v = 0;
    std::vector<double> given, need;
  };

  void deliver(std::size_t side, double t) {
    bool news = false;
    auto& queue = queues_[side];
    for (auto it = queue.begin(); it != queue.end();) {
      if (it->arrival > t) {
        ++it;
        continue;
      }
      RemoteHand& known = known_[side][it->from];
      if (it->hand.version > known.version) {
        known = it->hand;
        news = true;
      }
      it = queue.erase(it);
    }
    if (!news) return;
    ContactSet set;
    for (std::size_t i = 0; i < known_[side].size(); ++i) {
      const bool neighbour = i + 1 == side || i == side + 1;
      if (neighbour && known_[side][i].version > 0) set.hands[set.count++] = known_[side][i];
    }
    servos_[side]->contacts().write(set);
  }

  bool due(std::size_t side, double t) {
    if (line_.rate_hz > 0) return steps_ % static_cast<std::uint64_t>(1000 / line_.rate_hz) == 0;
    const ServoSnapshot& s = snapshot(side);
    const Last& last = sent_[side];
    const double since = t - last.time;
    const double error = std::abs(s.device.x() - last.x - last.v * since);
    return last.time < 0 || error * hands_.stiffness > line_.threshold_n || since > line_.longest;
  }

  void send(std::size_t side, double t, bool connected) {
    const ServoSnapshot& s = snapshot(side);
    ++updates_;
    sent_[side].time = t;
    sent_[side].x = s.device.x();
    sent_[side].v = s.device_velocity.x();
    for (std::size_t to = 0; to < servos_.size(); ++to) {
      if (to + 1 != side && to != side + 1) continue;
      RemoteHand hand;
      hand.id = {1, 1, static_cast<std::uint16_t>(side + 1)};
      hand.state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
      hand.state.position = s.scp;  // the displayed position of the hand
      hand.model.point = s.device - s.scp;
      hand.state.velocity = s.device_velocity;
      hand.state_time = pdu::from_seconds(t) + std::chrono::milliseconds(1);
      hand.model.kind = pdu::ForceModelKind::sphere;
      hand.model.k1 = hands_.stiffness * s.softening;
      hand.model.radius = hands_.radius;
      hand.model.static_friction = hand.model.kinetic_friction = hands_.friction;
      hand.valid_until = pdu::from_seconds(t + 12 * 0.06);
      hand.version = ++version_;
      for (std::size_t i = 0; i < s.count; ++i) {
        const ContactAccount& told = s.contacts[i];
        if (told.given > 0 || told.need > 0 || told.spring_need > 0) ++hand.neighbours;
        if (told.id.entity != to + 1) continue;
        hand.given_to_us = s.contacts[i].given;
        hand.need = s.contacts[i].need;
        hand.spring_need = s.contacts[i].spring_need;
      }
      if (hands_.lie) hands_.lie(side, hand);
      const peer::Fate fate = network_.decide(side, version_, pdu::from_seconds(t));
      if (!connected || fate.copies == 0) continue;
      queues_[to].push_back({t + pdu::to_seconds(fate.delay[0]), side, hand});
    }
  }

  void measure() {
    double sum = 0;
    for (std::size_t i = 0; i < servos_.size(); ++i) {
      const ServoSnapshot& s = snapshot(i);
      const double port = devices_[i]->port_work() + devices_[i]->damping_loss();
      sum += port + s.loan;
      least_port_ = std::min(least_port_, s.port_energy_min);
      least_unlent_ = std::min(least_unlent_, s.port_energy + s.loan);
      most_loan_[i] = std::max(most_loan_[i], s.loan);
      peak_ = std::max(peak_, s.force.norm());
    }
    least_sum_ = std::min(least_sum_, sum);
  }

  RowHands hands_;
  RowLine line_;
  peer::Impairment network_;
  std::vector<std::unique_ptr<SimulatedDevice>> devices_;
  std::vector<std::unique_ptr<ServoLoop>> servos_;
  std::vector<std::deque<Sent>> queues_;
  std::vector<Last> sent_;
  std::vector<std::vector<RemoteHand>> known_;
  std::uint64_t steps_ = 0, updates_ = 0;
  std::uint32_t version_ = 0;
  std::vector<double> most_loan_;
  double least_sum_ = 0, least_port_ = 0, least_unlent_ = 0, peak_ = 0;
};

}  // namespace reckon::haptics
