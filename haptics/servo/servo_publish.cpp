// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo publishes the outcome of a step.
#include <algorithm>
#include <chrono>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {

// Energy received from all remote hands since the start, less the energy given to them [J].
double ServoLoop::transferred() const noexcept {
  double sum = resting_;
  for (const RemoteContact* remote : near()) {
    sum += remote->pair().received - remote->pair().given;
  }
  return sum;
}

bool ServoLoop::take_news(double moved) noexcept {
  constexpr std::chrono::milliseconds kStillFor{100}, kAtLeast{10};
  const bool moves = has_near() || !((step_.probe - seen_at_).norm() <= moved);
  if (moves) {
    seen_at_ = step_.probe;
    moved_ = step_.now;
  }
  const bool is_new = step_.now - moved_ < kStillFor || step_.now - seen_ >= kAtLeast;
  if (is_new) seen_ = step_.now;
  return is_new;
}

void ServoLoop::publish(const Eigen::Vector3d& force, bool enabled) noexcept {
  const ContactResult& mesh = static_.result();
  if (mesh.in_contact) tally_.scene += step_.dt;
  scp_motion_.add(mesh.in_contact ? mesh.scp : step_.probe, pdu::to_seconds(step_.now));
  ServoSnapshot& out = snapshots_.write_slot();
  out.time = step_.now;
  out.step = count_;
  out.device = step_.probe;
  out.scp = mesh.in_contact ? mesh.scp : step_.probe;
  out.velocity = mesh.in_contact ? scp_motion_.velocity() : step_.velocity;
  out.acceleration = scp_motion_.acceleration();
  out.device_velocity = step_.velocity;
  out.device_acceleration = device_motion_.acceleration();
  out.force = force;
  out.mesh_force = static_.force();
  out.mesh_normal = mesh.normal;
  out.mesh_patch = mesh.in_contact ? mesh.objects[mesh.deepest].patch : 0;
  out.in_mesh_contact = mesh.in_contact;
  out.spring_share = held_.springs;
  out.crowd_share = crowd_share_;
  out.extra_share = held_.extra;
  out.limit_share = limit_share_;
  out.enabled = enabled;
  out.mesh_ledger = port_.free();
  out.trips = safety_.trips();
  out.count = 0;
  bool refused = false;
  for (const RemoteContact* remote : near()) {
    out.contacts[out.count++] = remote->account(step_, held_.extra);
    refused |= remote->refused();
  }
  if (refused) tally_.refused += step_.dt;
  out.tally = tally_;
  out.left_out = left_out_;
  out.port_energy = port_.absorbed() + transferred();
  out.encoder_allowance = port_.encoder_allowance();
  out.softening = crowd_share_ * softening_.share();
  out.loan = port_.owed();
  port_min_ = std::min(port_min_, out.port_energy + out.loan);
  out.port_energy_min = port_min_;
  out.late_cost = port_.late_cost();
  out.loan_most = loan_most_ = std::max(loan_most_, out.loan);
  if (trace_ != nullptr) trace_->push(out);
  snapshots_.publish();
}

}  // namespace reckon::haptics
