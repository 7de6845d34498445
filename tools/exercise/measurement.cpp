// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/haptics/passivity/contact_potential.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kHistory = 8192;                      // recorded steps kept per hand
constexpr nanoseconds kPatience = std::chrono::seconds(1);  // for a stopped peer
constexpr double kLargestError = 1e3;                       // replaces anything larger

double own_energy(const haptics::ServoSnapshot& step) {
  double energy = step.port_energy + step.loan + step.source_energy();
  for (std::size_t i = 0; i < step.count; ++i) {
    energy += step.contacts[i].given - step.contacts[i].received;
  }
  return energy;
}

// [N] on the hand, as rendered.
Eigen::Vector3d force_of(const haptics::ContactAccount& contact) {
  return contact.force + contact.damper_force;
}

bool is_felt(const haptics::ContactAccount& contact) { return !force_of(contact).isZero(0.0); }

}  // namespace

DemoMeasurement::DemoMeasurement(std::vector<std::size_t> peers, const peer::HandModel& hand)
    : hand_(hand),
      peers_(std::move(peers)),
      ids_(peers_.size()),
      devices_(peers_.size()),
      last_(peers_.size()),
      late_costs_(peers_.size(), 0.0),
      history_(peers_.size()),
      steps_(peers_.size()) {}

void DemoMeasurement::add_step(std::size_t index, const haptics::ServoSnapshot& step) {
  history_[index].push_back(
      {step.time, step.device, step.scp, step.device_velocity, own_energy(step)});
  if (history_[index].size() > kHistory) history_[index].pop_front();
  steps_[index].push_back(step);
}

void DemoMeasurement::add_shown(std::size_t owner, const peer::ShownSample& sample) {
  shown_.push_back({owner, sample});
}

void DemoMeasurement::add_shown_entity(const peer::ShownSample& sample,
                                       const Eigen::Vector3d& position) {
  pose_error_.add((sample.position - position).norm());
}

std::optional<std::size_t> DemoMeasurement::index_of(const pdu::EntityId& id) const {
  const auto found = std::find(ids_.begin(), ids_.end(), id);
  if (found == ids_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - ids_.begin());
}

std::optional<DemoMeasurement::Truth> DemoMeasurement::truth(std::size_t hand,
                                                             nanoseconds time) const {
  const std::deque<Truth>& history = history_[hand];
  const auto after = std::lower_bound(history.begin(), history.end(), time,
                                      [](const Truth& t, nanoseconds at) { return t.time < at; });
  if (after == history.end()) return std::nullopt;
  if (after->time == time) return *after;
  if (after == history.begin()) return std::nullopt;

  // A hand moves less than a micrometre off the straight line within a servo period.
  const Truth& before = *std::prev(after);
  const double share = pdu::to_seconds(time - before.time) /
                       std::max(1e-9, pdu::to_seconds(after->time - before.time));
  Truth result = before;
  result.time = time;
  result.device += share * (after->device - before.device);
  result.scp += share * (after->scp - before.scp);
  result.velocity += share * (after->velocity - before.velocity);
  return result;
}

double DemoMeasurement::force_error_rms() const {
  const auto samples = static_cast<double>(force_error_.spread().count);
  return samples > 0 ? std::sqrt(force_error_squares_ / samples) : 0;
}

nanoseconds DemoMeasurement::covered_until() const {
  nanoseconds until = nanoseconds::max();
  for (const auto& history : history_) {
    if (history.empty()) return nanoseconds::min();
    until = std::min(until, history.back().time);
  }
  return until;
}

void DemoMeasurement::evaluate() {
  nanoseconds newest{0};
  for (const auto& history : history_) {
    if (!history.empty()) newest = std::max(newest, history.back().time);
  }
  const nanoseconds covered = covered_until();
  const auto ready = [&](nanoseconds time) { return time <= covered || newest - time > kPatience; };

  for (std::size_t i = 0; i < steps_.size(); ++i) {
    while (!steps_[i].empty() && ready(steps_[i].front().time)) {
      compare_forces(i, steps_[i].front());
      add_energy(i, steps_[i].front());
      steps_[i].pop_front();
    }
  }
  while (!shown_.empty() && ready(shown_.front().sample.time)) {
    const Shown& shown = shown_.front();
    if (const auto owner = truth(shown.owner, shown.sample.time)) {
      pose_error_.add((shown.sample.position - owner->scp).norm());
    }
    shown_.pop_front();
  }
}

// [N], along the normal; `closing` [m/s] is how fast the hands come together.
double DemoMeasurement::possible(std::size_t observer, std::size_t owner, double depth,
                                 double closing) const {
  const peer::DeviceStiffness& device = devices_[observer];
  const double k1 = std::min(hand_.k1, devices_[owner].hands);
  const double spring =
      haptics::bounded_spring(k1, hand_.k3, device.hand_limit(), device.force, depth).force;
  return spring + std::max(device.damper_shown(hand_.damping) * closing, -spring);
}

// Hands that cannot have touched at the step, by the owner's last position and the greatest speed
// of any hand. Skips nearly all pairs of many hands.
bool DemoMeasurement::is_far(std::size_t owner, const haptics::ServoSnapshot& step) const {
  constexpr double kFastest = 20.0;  // [m/s]
  if (history_[owner].empty()) return true;
  const Truth& last = history_[owner].back();
  const double since = std::abs(pdu::to_seconds(last.time - step.time));
  return (last.device - step.device).norm() > 2.0 * hand_.radius + kFastest * since;
}

// [s] since the last step, divided by the number of steps. 0 for the first one.
double DemoMeasurement::length_of(std::size_t index, const haptics::ServoSnapshot& step) {
  const Place before = std::exchange(last_[index], {step.step, step.time, true});
  if (!before.known || step.step <= before.step) return 0.0;
  return pdu::to_seconds(step.time - before.time) / static_cast<double>(step.step - before.step);
}

void DemoMeasurement::compare_forces(std::size_t observer, const haptics::ServoSnapshot& step) {
  const double length = length_of(observer, step);
  if (step.in_mesh_contact) touching_scene_ += length;
  peak_force_ = std::max(peak_force_, step.force.norm());
  trips_ = std::max(trips_, step.trips);

  bool touching = false;
  for (std::size_t owner = 0; owner < ids_.size(); ++owner) {
    if (peers_[owner] == peers_[observer] || (is_far(owner, step) && step.count == 0)) continue;
    touching |= compare_force(observer, owner, step);
  }
  if (touching) touching_hands_ += length;
  for (std::size_t c = 0; c < step.count; ++c) {
    if (index_of(step.contacts[c].id) || !is_felt(step.contacts[c])) continue;
    touching_entities_ += length;
    break;
  }
}

// @return whether the two touch, by the rendered force or by their positions
bool DemoMeasurement::compare_force(std::size_t observer, std::size_t owner,
                                    const haptics::ServoSnapshot& step) {
  const auto other = truth(owner, step.time);
  if (!other) return false;
  // The owner's full model: its sphere at the true position of its device.
  deadreckon::Pose pose;
  pose.position = other->device;
  pose.velocity = other->velocity;
  const Eigen::Vector3d wanted = deadreckon::evaluate(to_force_model(hand_), pose, step.device,
                                                      step.device_velocity, hand_.radius);

  Eigen::Vector3d rendered = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < step.count; ++c) {
    if (index_of(step.contacts[c].id) == owner) rendered = force_of(step.contacts[c]);
  }
  if (wanted.isZero() && rendered.isZero()) return false;
  // Friction depends on the path, so the comparison is along the true normal.
  const Eigen::Vector3d between = step.device - other->device;
  const Eigen::Vector3d normal =
      between.norm() > 0.0 ? Eigen::Vector3d(between.normalized()) : Eigen::Vector3d::UnitZ();
  const double felt = normal.dot(rendered), asked = normal.dot(wanted);
  const double error = std::abs(asked - felt);
  force_error_.add(error);
  force_error_squares_ += error * error;
  const double depth = 2.0 * hand_.radius - between.norm();
  const double closing = -normal.dot(step.device_velocity - other->velocity);
  possible_error_.add(std::abs(possible(observer, owner, depth, closing) - felt));
  return true;
}

void DemoMeasurement::add_energy(std::size_t index, const haptics::ServoSnapshot& step) {
  energy_min_ = std::min(energy_min_, step.port_energy_min);
  late_costs_[index] = step.late_cost;
  loan_most_ = std::max(loan_most_, step.loan_most);
  // With many hands, the steps of one hand sample the sum of all often enough.
  constexpr std::size_t kFew = 8;
  if (history_.size() > kFew && index != 0) return;
  double sum = own_energy(step);
  for (std::size_t i = 0; i < history_.size(); ++i) {
    if (i == index) continue;
    const auto other = truth(i, step.time);
    if (!other) return;
    sum += other->energy;
  }
  energy_min_ = std::min(energy_min_, sum);
}

double DemoMeasurement::late_cost() const {
  return std::accumulate(late_costs_.begin(), late_costs_.end(), 0.0);
}

}  // namespace reckon::tools
