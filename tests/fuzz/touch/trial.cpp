// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/trial.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/touch/hand.hpp"

namespace reckon::fuzz {
namespace {

using haptics::ContactAccount;
using haptics::ContactSet;
using haptics::RemoteHand;

constexpr double kLongest = 0.06;  // [s], between two updates by threshold

class Trial {
 public:
  explicit Trial(const Scenario& scenario) : scenario_(scenario), random_(scenario.seed) {
    for (std::size_t i = 0; i < scenario.hands(); ++i) {
      hands_.push_back(std::make_unique<Hand>(scenario_, i));
    }
    queues_.resize(hands_.size());
    told_.resize(hands_.size());
    known_.resize(hands_.size(), std::vector<RemoteHand>(hands_.size()));
  }

  void step() {
    for (std::size_t i = 0; i < hands_.size(); ++i) {
      deliver(i);
      hands_[i]->step(pdu::from_seconds(time()), random_);
    }
    for (std::size_t i = 0; i < hands_.size(); ++i) {
      if (hands_[i]->stepped() && due(i)) send(i);
    }
    measure();
    ++steps_;
  }

  [[nodiscard]] double time() const { return static_cast<double>(steps_) * 1e-3; }
  [[nodiscard]] Outcome outcome() const;

 private:
  struct Sent {
    double arrival;
    std::size_t from;
    RemoteHand hand;
  };
  struct Told {
    double time = -1;
    Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();
  };

  double drawn() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  [[nodiscard]] bool connected() const {
    const double since = time() - scenario_[Shared::outage_at];
    return since < 0 || since > scenario_[Shared::outage_for];
  }
  void deliver(std::size_t to);
  [[nodiscard]] bool due(std::size_t from) const;
  void send(std::size_t from);
  [[nodiscard]] RemoteHand record_of(std::size_t from, std::size_t to);
  void lie(RemoteHand& hand, std::size_t from);
  void measure();

  Scenario scenario_;
  std::mt19937 random_;
  std::vector<std::unique_ptr<Hand>> hands_;
  std::vector<std::deque<Sent>> queues_;
  std::vector<Told> told_;
  std::vector<std::vector<RemoteHand>> known_;
  std::uint64_t steps_ = 0;
  std::uint32_t version_ = 0;
  double least_sum_ = 0, sum_short_ = 0;
};

void Trial::deliver(std::size_t to) {
  bool news = false;
  std::deque<Sent>& queue = queues_[to];
  for (auto it = queue.begin(); it != queue.end();) {
    if (it->arrival > time()) {
      ++it;
      continue;
    }
    RemoteHand& known = known_[to][it->from];
    if (it->hand.version > known.version) {
      known = it->hand;
      news = true;
    }
    it = queue.erase(it);
  }
  if (!news) return;
  ContactSet set;
  for (const RemoteHand& known : known_[to]) {
    if (known.version > 0) set.hands[set.count++] = known;
  }
  hands_[to]->servo().contacts().write(set);
}

bool Trial::due(std::size_t from) const {
  const double rate = scenario_[Shared::rate];
  if (rate >= 10) return steps_ % static_cast<std::uint64_t>(1000 / rate) == 0;
  const Told& told = told_[from];
  const double since = time() - told.time;
  const Eigen::Vector3d predicted = told.position + since * told.velocity;
  const double error = (hands_[from]->snapshot().device - predicted).norm();
  return told.time < 0 || since > kLongest ||
         error * scenario_[Shared::stiffness] > scenario_[Shared::threshold];
}

void Trial::send(std::size_t from) {
  const haptics::ServoSnapshot& s = hands_[from]->snapshot();
  told_[from] = {time(), s.device, s.device_velocity};
  for (std::size_t to = 0; to < hands_.size(); ++to) {
    if (to + 1 != from && to != from + 1) continue;
    RemoteHand hand = record_of(from, to);
    if (scenario_[Shared::liar] == static_cast<double>(from + 1)) lie(hand, from);
    const double jitter = scenario_[Shared::jitter] * (2 * drawn() - 1);
    const double late = scenario_[Shared::delay] * (1 + jitter);
    if (drawn() < scenario_[Shared::loss] || !connected()) continue;
    queues_[to].push_back({time() + late, from, hand});
  }
}

RemoteHand Trial::record_of(std::size_t from, std::size_t to) {
  const haptics::ServoSnapshot& s = hands_[from]->snapshot();
  RemoteHand hand;
  hand.id = {1, 1, static_cast<std::uint16_t>(from + 1)};
  hand.state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  hand.state.position = s.device;
  hand.state.velocity = s.device_velocity;
  hand.state_time = s.time;
  hand.model.kind = pdu::ForceModelKind::sphere;
  const double stiffest = hands_[from]->servo().remote_stiffness_limit();
  hand.model.k1 = std::min(scenario_[Shared::stiffness], stiffest) * s.softening;
  hand.model.k3 = scenario_[Shared::hardening];
  hand.model.damping = scenario_[Shared::record_damping];
  hand.model.radius = kRadius;
  hand.model.static_friction = hand.model.kinetic_friction = scenario_[Shared::friction];
  hand.valid_until = s.time + pdu::from_seconds(12 * kLongest);
  hand.version = ++version_;
  for (std::size_t i = 0; i < s.count; ++i) {
    const ContactAccount& account = s.contacts[i];
    if (account.given > 0 || account.need > 0 || account.spring_need > 0) ++hand.neighbours;
    if (account.id.entity != to + 1) continue;
    hand.given_to_us = account.given;
    hand.need = account.need;
    hand.spring_need = account.spring_need;
  }
  return hand;
}

void Trial::lie(RemoteHand& hand, std::size_t from) {
  const double t = time();
  const bool turn = std::sin(2 * std::numbers::pi * scenario_[Shared::lie_wave] * t) < 0;
  hand.given_to_us += scenario_[Shared::lie_given] * t;
  hand.need += scenario_[Shared::lie_need];
  hand.spring_need += scenario_[Shared::lie_need];
  if (turn) {
    hand.model.k1 *= scenario_[Shared::lie_softest];
    hand.state.position.x() -= scenario_[Shared::lie_jump];
  }
  if (scenario_[Shared::lie_rename] > 0) {
    hand.id.entity = static_cast<std::uint16_t>(100 * (from + 1) + steps_ / 50 % 60);
  }
  if (drawn() >= scenario_[Shared::lie_odd]) return;
  constexpr double kOdd[] = {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(),
                             1e300,
                             1e9,
                             -1.0,
                             0.0};
  const double odd = kOdd[random_() % std::size(kOdd)];
  double* fields[] = {&hand.given_to_us,
                      &hand.need,
                      &hand.spring_need,
                      &hand.model.k1,
                      &hand.model.k3,
                      &hand.model.damping,
                      &hand.model.radius,
                      &hand.model.static_friction,
                      &hand.state.position.x(),
                      &hand.state.velocity.x(),
                      &hand.state.acceleration.x()};
  *fields[random_() % std::size(fields)] = odd;
}

// Energy under way or thrown away only adds to what is there.
void Trial::measure() {
  double sum = 0, open = 0;
  for (const auto& hand : hands_) {
    sum += hand->work() + hand->snapshot().loan;
    open += hand->open();
  }
  least_sum_ = std::min(least_sum_, sum);
  sum_short_ = std::min(sum_short_, sum + open);
}

// What each hand would feel at most from a neighbour without any delay: springs in a row between
// grips, of which those are there that are pressed.
std::vector<double> springs_in_a_row(const Scenario& s, const std::vector<double>& goals) {
  const std::size_t n = goals.size();
  std::vector<double> best(n, 0.0);
  for (std::size_t pressed = 0; pressed < (std::size_t{1} << (n - 1)); ++pressed) {
    const auto size = static_cast<Eigen::Index>(n);
    Eigen::MatrixXd a = s[Shared::grip] * Eigen::MatrixXd::Identity(size, size);
    Eigen::VectorXd b(size);
    for (Eigen::Index i = 0; i < size; ++i)
      b(i) = s[Shared::grip] * goals[static_cast<std::size_t>(i)];
    for (Eigen::Index i = 0; i + 1 < size; ++i) {
      if (((pressed >> i) & 1) == 0) continue;
      const double k = s[Shared::stiffness];
      a.block<2, 2>(i, i) += k * Eigen::Matrix2d{{1, -1}, {-1, 1}};
      b(i) -= k * 2 * kRadius;
      b(i + 1) += k * 2 * kRadius;
    }
    const Eigen::VectorXd x = a.partialPivLu().solve(b);
    bool true_to_it = true;
    std::vector<double> forces(n, 0.0);
    for (Eigen::Index i = 0; i + 1 < size; ++i) {
      const double depth = 2 * kRadius - (x(i + 1) - x(i));
      true_to_it = true_to_it && (depth > 0) == (((pressed >> i) & 1) != 0);
      const double force = s[Shared::stiffness] * std::max(0.0, depth);
      for (const auto at : {static_cast<std::size_t>(i), static_cast<std::size_t>(i) + 1}) {
        forces[at] = std::max(forces[at], force);
      }
    }
    if (true_to_it) best = forces;
  }
  return best;
}

Outcome Trial::outcome() const {
  constexpr double kLeast = 0.2;  // [N], that counts as felt
  Outcome out;
  for (const auto& hand : hands_) hand->judge(out);
  const bool honest = scenario_[Shared::liar] == 0;
  if (honest) out.least_sum = least_sum_;
  if (honest && sum_short_ < -kRoundOff && out.violation.empty()) {
    out.violation = fmt::format("all ports together lack {:.3g} J", -sum_short_);
  }
  std::vector<double> goals;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    goals.push_back(home_of(scenario_, i) + way_of(scenario_, i, time()).x());
  }
  const std::vector<double> right = springs_in_a_row(scenario_, goals);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    if (right[i] < kLeast) continue;
    out.wrong = std::max(out.wrong, std::abs(hands_[i]->felt() / right[i] - 1));
  }
  return out;
}

}  // namespace

Outcome try_out(const Scenario& scenario, double seconds) {
  Trial trial(scenario);
  while (trial.time() < seconds) trial.step();
  return trial.outcome();
}

}  // namespace reckon::fuzz
