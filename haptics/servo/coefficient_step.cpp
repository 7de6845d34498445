// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/coefficient_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr int kHoldSteps = 100;  // steps without walls after a trip
constexpr double kRises = 10.0;  // number of increments of the greatest force: each is an upload

constexpr std::array kSides{WallSide::below, WallSide::above};

// Effect of a model on the handle.
struct Rendered {
  Vector3d force = Vector3d::Zero();    // [N], frame D
  Vector3d surface = Vector3d::Zero();  // [m], position of the handle outside of all walls
  double stored = 0.0;                  // [J]
};

Rendered rendered(const SpringModel& model, const Vector3d& place) noexcept {
  Rendered out;
  out.surface = place;
  for (std::size_t axis = 0; axis < SpringModel::kAxes; ++axis) {
    const auto i = static_cast<Index>(axis);
    for (const WallSide side : kSides) {
      const SpringWall& wall = model.wall(axis, side);
      out.force[i] += force_of(wall, side, place[i]);
      out.stored += stored_in(wall, side, place[i]);
      if (depth_in(wall, side, place[i]) > 0) out.surface[i] = wall.at;
    }
  }
  return out;
}

}  // namespace

CoefficientStep::CoefficientStep(CoefficientDevice& device, std::shared_ptr<const EffectPlan> plan,
                                 const ServoConfig& config, std::shared_ptr<BodyWorld> bodies)
    : ServoCore(device, std::move(plan), config, std::move(bodies)),
      springs_(device),
      scene_(*plan_, config_, limits_.axes, limits_.max_stiffness),
      others_(config_.max_contacts),
      safety_(step_.force_limit, config_.max_power, limits_.max_speed, kHoldSteps) {
  static_cap_ = remote_cap_ = body_cap_ = limits_.max_stiffness;
  step_.stiffness_limit = step_.body_stiffness_limit = limits_.max_stiffness;
}

void CoefficientStep::step(nanoseconds now) noexcept {
  DeviceSample reading = springs_.read(now);
  step_.now = now;
  note_time();
  obey_stop(reading);
  sample(reading);
  others_.advance(contacts_.update() ? &contacts_.read() : nullptr, step_, count_);
  const bool enabled = safety_.admit(reading, step_.velocity) == Admission::shown;
  // Two axes together stay within the limit.
  const double most = step_.force_limit / std::sqrt(limits_.axes);
  const double share = safety_.scale(Vector3d(step_.force_limit, 0, 0), Vector3d::Zero());
  const double risen = std::floor(kRises * share + 1e-9) / kRises;
  const SpringModel wanted = enabled ? walls(risen * most) : SpringModel();
  asked_ = rendered(wanted, place_).force;
  springs_.state(wanted, now);
  publish(enabled);
  ++count_;
}

bool CoefficientStep::sample(const DeviceSample& reading) noexcept {
  step_.dt = period_;
  if (!reading.ok || !reading.position.allFinite()) {
    ++tally_.failed;
    return false;
  }
  step_.dt = started_ ? std::max(pdu::to_seconds(step_.now - sampled_at_), 0.1 * period_) : period_;
  sampled_at_ = step_.now;
  placed_at_ = started_ && reading.took ? placed_at_ + *reading.took : step_.now;
  started_ = true;
  place_ = reading.position;
  step_.probe = config_.device_origin + config_.device_orientation * place_;
  motion_.add(step_.probe, pdu::to_seconds(placed_at_));
  step_.velocity = motion_.velocity();
  return true;
}

SpringModel CoefficientStep::walls(double most_force) noexcept {
  SpringModel model = scene_.walls_at(place_, most_force);
  others_.add(config_, place_, static_cast<std::size_t>(limits_.axes), most_force, model);
  return model;
}

bool CoefficientStep::has_near() noexcept {
  return !others_.empty() || plan_->has_within(step_.probe, kSoonFelt + config_.probe_radius);
}

void CoefficientStep::publish(bool enabled) noexcept {
  const ShownModel shown = springs_.shown();
  const Rendered now = rendered(shown.model, place_);
  const auto to_scene = [&](const Vector3d& v) -> Vector3d {
    return config_.device_orientation * v;
  };
  ServoSnapshot& out = snapshots_.write_slot();
  out = {};
  out.time = step_.now;
  out.step = count_;
  out.device = step_.probe;
  out.scp = config_.device_origin + to_scene(now.surface);
  scp_motion_.add(out.scp, pdu::to_seconds(placed_at_));
  const bool touches = now.surface != place_;
  const bool of_others = touches && others_.touching();
  out.in_mesh_contact = touches && !of_others;
  if (out.in_mesh_contact) tally_.scene += step_.dt;
  if (of_others) tally_.hands += step_.dt;
  out.velocity = touches ? scp_motion_.velocity() : step_.velocity;
  out.acceleration = scp_motion_.acceleration();
  out.device_velocity = step_.velocity;
  out.device_acceleration = motion_.acceleration();
  out.force = to_scene(now.force);
  if (out.in_mesh_contact) {
    out.mesh_force = out.force;
    out.mesh_normal = to_scene((now.surface - place_).normalized());
  }
  const double asked = asked_.norm();
  others_.publish(step_, asked > 0 ? std::min(1.0, now.force.norm() / asked) : 0.0, out);
  out.left_out = others_.left_out();
  out.enabled = enabled;
  out.stopped = stopped_;
  out.mesh_ledger = shown.energy;
  out.trips = safety_.trips();
  out.tally = tally_;
  out.port_energy = shown.energy + now.stored;
  port_min_ = std::min(port_min_, out.port_energy);
  out.port_energy_min = port_min_;
  if (trace_ != nullptr) trace_->push(out);
  snapshots_.publish();
}

}  // namespace reckon::haptics
