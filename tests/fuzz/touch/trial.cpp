// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/touch/hand.hpp"
#include "reckon/tests/fuzz/touch/line.hpp"
#include "reckon/tests/fuzz/touch/rest.hpp"

namespace reckon::fuzz {
namespace {

using haptics::ContactAccount;
using haptics::ContactSet;
using haptics::RemoteHand;

constexpr double kLongest = 0.06;  // [s], between two updates by threshold
constexpr double kLeast = 0.2;     // [N], least force that counts as felt
constexpr double kTold = 0.1;      // [s] of kWatched, for which a servo reports a reduced force
constexpr double kArm = 1.8;       // [m/s]

class Trial {
 public:
  /// @param twin the motion that the liar showed; an honest hand is led along it in the liar's
  ///     place; may be null
  explicit Trial(const Scenario& scenario, const Track* twin = nullptr)
      : scenario_(scenario),
        random_(scenario.seed),
        line_(scenario_),
        honest_(twin != nullptr || scenario[Shared::liar] == 0),
        told_(scenario.hands()) {
    for (std::size_t i = 0; i < scenario.hands(); ++i) {
      hands_.push_back(std::make_unique<Hand>(scenario_, i, lies(i) ? twin : nullptr, begin_));
      if (i == 0 && hands_[0]->model() != nullptr) begin_ = hands_[0]->model()->begin();
    }
    shown_.period = 1 / scenario.of_device(liar(), Shared::servo_rate, Shared::other_rate);
  }

  /// Runs until the next servo step.
  void step();
  void run_until(double seconds);
  void run(double seconds);
  /// The first hand.
  [[nodiscard]] const Hand& first() const { return *hands_.front(); }

  [[nodiscard]] double time() const { return pdu::to_seconds(now_ - begin_); }
  [[nodiscard]] Outcome outcome() const;
  /// Energy that forces put into the first hand and the device's damping did not take [J], every
  /// kSampled.
  [[nodiscard]] const std::vector<double>& put_in() const { return put_in_; }
  /// The positions that the liar showed.
  [[nodiscard]] const Track& shown() const { return shown_; }

 private:
  struct Told {
    double time = -1;
    Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();
  };

  double drawn() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  [[nodiscard]] std::size_t liar() const {
    return static_cast<std::size_t>(std::max(1.0, scenario_[Shared::liar])) - 1;
  }
  [[nodiscard]] bool lies(std::size_t hand) const {
    return scenario_[Shared::liar] == static_cast<double>(hand + 1);
  }
  [[nodiscard]] std::chrono::nanoseconds next() const;
  void deliver(std::size_t to);
  [[nodiscard]] bool due(std::size_t from) const;
  void send(std::size_t from);
  [[nodiscard]] RemoteHand record_of(std::size_t from, std::size_t to);
  void show_elsewhere(deadreckon::KinematicState& state) const;
  void lie(RemoteHand& hand, std::size_t from);
  void measure();
  void judge_rest(Outcome& out) const;

  Scenario scenario_;
  std::mt19937 random_;
  Line line_;
  bool honest_;
  std::vector<std::unique_ptr<Hand>> hands_;
  std::vector<Told> told_;
  std::chrono::nanoseconds begin_{0}, now_{0};
  std::vector<double> put_in_;
  Track shown_;
  double least_sum_ = 0, sum_short_ = 0;
};

std::chrono::nanoseconds Trial::next() const {
  std::chrono::nanoseconds first = hands_[0]->next();
  for (const auto& hand : hands_) first = std::min(first, hand->next());
  return first;
}

void Trial::step() {
  now_ = next();
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    if (hands_[i]->next() <= now_) deliver(i);
    hands_[i]->step(now_, random_);
  }
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    if (hands_[i]->stepped() && due(i)) send(i);
  }
  measure();
}

void Trial::run(double seconds) {
  run_until(seconds - kWatched);
  for (const auto& hand : hands_) hand->watch();
  run_until(seconds);
}

// All use the clock of the first hand's model, if it has one.
void Trial::run_until(double seconds) {
  ModelHandle* const model = hands_[0]->model();
  if (model == nullptr) {
    while (time() < seconds) step();
    return;
  }
  model->run(begin_ + pdu::from_seconds(seconds), [this](std::chrono::nanoseconds now) {
    while (next() <= now) step();
  });
}

void Trial::deliver(std::size_t to) {
  ContactSet set;
  if (line_.deliver(time(), to, set)) hands_[to]->servo().contacts().write(set);
}

bool Trial::due(std::size_t from) const {
  const double rate = scenario_[Shared::rate];
  const Told& told = told_[from];
  const double since = time() - told.time;
  if (told.time < 0) return true;
  if (rate >= 10) return since * rate > 1 - 1e-9;
  const Eigen::Vector3d predicted = told.position + since * told.velocity;
  const double error = (hands_[from]->snapshot().device - predicted).norm();
  return since > kLongest || error * scenario_[Shared::stiffness] > scenario_[Shared::threshold];
}

void Trial::send(std::size_t from) {
  const haptics::ServoSnapshot& s = hands_[from]->snapshot();
  told_[from] = {time(), s.device, s.device_velocity};
  for (std::size_t to = 0; to < hands_.size(); ++to) {
    if (to + 1 != from && to != from + 1) continue;
    RemoteHand hand = record_of(from, to);
    if (lies(from) && !honest_) lie(hand, from);
    line_.send(time(), from, to, hand);
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

// A false swing and an alternating false displacement at the frequency of its lies.
void Trial::show_elsewhere(deadreckon::KinematicState& state) const {
  const double speed = 2 * std::numbers::pi * scenario_[Shared::lie_wave];
  const double sine = std::sin(speed * time());
  const double swing = scenario_[Shared::lie_swing];
  state.position.x() -= swing * sine + (sine < 0 ? scenario_[Shared::lie_jump] : 0.0);
  state.velocity.x() -= swing * speed * std::cos(speed * time());
}

void Trial::lie(RemoteHand& hand, std::size_t from) {
  const double t = time();
  const bool turn = std::sin(2 * std::numbers::pi * scenario_[Shared::lie_wave] * t) < 0;
  show_elsewhere(hand.state);
  hand.given_to_us += scenario_[Shared::lie_given] * t;
  hand.need += scenario_[Shared::lie_need];
  hand.spring_need += scenario_[Shared::lie_need];
  if (turn) hand.model.k1 *= scenario_[Shared::lie_softest];
  if (scenario_[Shared::lie_rename] > 0) {
    hand.id.entity = static_cast<std::uint16_t>(100 * (from + 1) + static_cast<int>(t / 0.05) % 60);
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

// Energy under way or discarded only adds to the sum.
void Trial::measure() {
  double sum = 0, open = 0;
  bool exact = true;
  for (const auto& hand : hands_) {
    sum += hand->work() + hand->snapshot().loan + hand->snapshot().source_energy() -
           hand->bodies().gained();
    open += hand->open() + hand->allowance();
    exact = exact && hand->bodies().are_exact();
  }
  if (exact) {
    least_sum_ = std::min(least_sum_, sum);
    sum_short_ = std::min(sum_short_, sum + open);
  }
  while (static_cast<double>(put_in_.size()) * kSampled <= time()) {
    put_in_.push_back(-hands_[0]->work());
  }
  if (honest_ || !hands_[liar()]->stepped()) return;
  deadreckon::KinematicState state;
  state.position = hands_[liar()]->snapshot().device;
  show_elsewhere(state);
  shown_.points.push_back(state.position);
}

void Trial::judge_rest(Outcome& out) const {
  std::vector<Shows> shows;
  for (const auto& hand : hands_) {
    const haptics::ServoLoop& servo = hand->servo();
    shows.push_back({servo.remote_stiffness_limit(), servo.static_stiffness_limit(),
                     servo.region_stiffness_limit()});
    out.told = out.told || hand->told() > kTold;
  }
  const std::vector<double> row = forces_in_a_row(scenario_, shows, time());
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    if (row[i] < kLeast) continue;
    out.rows = std::max(out.rows, std::abs(hands_[i]->felt() / row[i] - 1));
  }
  if (!is_promised(scenario_) || time() - kWatched - still_since(scenario_) < kStill - 1e-6) return;

  bool interrupted = is_interrupted(scenario_);
  for (const auto& hand : hands_) interrupted = interrupted || hand->snapshot().trips > 0;
  const std::vector<double> right = right_forces(scenario_, shows, time());
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const Rest rest = {right[i], hands_[i]->mean_force(), interrupted};
    if (interrupted) out.lacks = std::max(out.lacks, rest.lacks());
    const bool worst = rest.off() >= out.wrong;
    out.wrong = std::max(out.wrong, rest.off());
    if (!rest.is_wrong() || (!worst && !out.wrong_force.empty())) continue;
    out.wrong_force =
        fmt::format("hand {}: {:.3g} N where {:.3g} N are right, {} s {}, and {}told", i + 1,
                    rest.shown, rest.right, kStill,
                    interrupted ? "after all is well again" : "at rest", out.told ? "" : "not ");
  }
}

Outcome Trial::outcome() const {
  Outcome out;
  for (const auto& hand : hands_) hand->judge(out);
  if (honest_) out.least_sum = least_sum_;
  if (honest_ && sum_short_ < -kRoundOff && out.violation.empty()) {
    out.violation = fmt::format("all ports together lack {:.3g} J", -sum_short_);
  }
  judge_rest(out);
  return out;
}

}  // namespace

Outcome try_out(const Scenario& scenario, double seconds) {
  Trial trial(scenario);
  trial.run(seconds);
  return trial.outcome();
}

Outcome try_beside_heap(const Scenario& scenario, double seconds) {
  Scenario without = scenario;
  without[Shared::pile] = 0;
  without.tidy();
  Trial crowded(scenario), alone(without);
  double force = 0, place = 0;
  bool fits = true;  // the heap has taken no exact step from a body
  while (crowded.time() < seconds) {
    crowded.step();
    alone.step();
    const Hand &one = crowded.first(), &other = alone.first();
    force = std::max(force, (one.snapshot().force - other.snapshot().force).norm());
    const auto places = one.bodies().places(), others = other.bodies().places();
    fits &= one.bodies().approximated() == other.bodies().approximated();
    for (std::size_t i = 0; fits && i < others.size(); ++i)
      place = std::max(place, (places[i] - others[i]).norm());
  }
  Outcome out = crowded.outcome();
  out.heap_force = force;
  out.heap_place = place;
  return out;
}

Outcome try_beside_twin(const Scenario& scenario, double seconds) {
  Trial trial(scenario);
  trial.run(seconds);
  Outcome out = trial.outcome();
  if (trial.shown().points.empty()) return out;
  Track shown = trial.shown();
  shown.slow_down(kArm);
  Trial twin(scenario, &shown);
  twin.run(seconds);
  out.liar = excess_over(trial.put_in(), twin.put_in());
  return out;
}

}  // namespace reckon::fuzz
