// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a servo step shows of itself: its snapshot, and the tally of its contacts.
#include <algorithm>

#include "reckon/haptics/servo/servo_step.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {

// What has a mass and is carried moves as its owner has it.
template <int axes>
bool ServoStepOf<axes>::touches_others_body() const noexcept {
  for (std::size_t probe = 0; probe < tool_.size(); ++probe) {
    for (const std::uint32_t index : static_.walls(probe).result().touched) {
      const PlannedObject& object = plan_->objects()[index];
      if (object.carried && object.matter.mass > 0) return true;
    }
  }
  return false;
}

template <int axes>
void ServoStepOf<axes>::publish(bool enabled) noexcept {
  const ContactResult& mesh = static_.result();
  if (mesh.in_contact) tally_.scene += step_.dt;
  if (touches_others_body()) tally_.bodies += step_.dt;
  const bool grabs = static_.grabs();
  if (grabs) tally_.grabbed += step_.dt;
  // Others feel the hand at the first probe.
  const ContactResult& first = axes == 3 ? mesh : static_.walls().result();
  const Eigen::Vector3d scp = first.in_contact ? first.scp : step_.probe;
  scp_motion_.add(scp, pdu::to_seconds(step_.now));
  ServoSnapshot& out = snapshots_.write_slot();
  out.time = step_.now;
  out.step = count_;
  out.device = step_.probe;
  out.scp = scp;
  out.velocity = first.in_contact ? scp_motion_.velocity() : step_.velocity;
  out.acceleration = scp_motion_.acceleration();
  out.device_velocity = step_.velocity;
  out.device_acceleration = device_motion_.acceleration();
  out.force = tool_.force(written_);
  if constexpr (axes == 6) {
    const Wrench wrench = tool_.wrench(written_);
    out.tool.turns = true;
    out.tool.handle = tool_.pose().position;
    out.tool.orientation = tool_.pose().orientation;
    out.tool.turn_rate = tool_.twist().template tail<3>();
    out.tool.torque = wrench.tail<3>();
    out.tool.count = tool_.size();
    for (std::size_t i = 0; i < tool_.size(); ++i) out.tool.probes[i] = tool_.place(i);
  }
  out.mesh_force = static_.force();
  out.mesh_normal = mesh.normal;
  out.mesh_patch = mesh.in_contact ? mesh.objects[mesh.deepest].patch : 0;
  out.in_mesh_contact = mesh.in_contact;
  out.grabs = grabs;
  out.spring_share = held_.springs;
  out.crowd_share = crowd_share_;
  out.extra_share = held_.extra;
  out.limit_share = limit_share_;
  out.enabled = enabled;
  out.stopped = stopped_;
  out.mesh_ledger = port_.free();
  out.trips = safety_.trips();
  out.count = 0;
  bool refused = false;
  for (const RemoteContact* remote : hands_.all()) {
    out.contacts[out.count++] = remote->account(step_, held_.extra);
    refused |= remote->refused();
  }
  if (refused) tally_.refused += step_.dt;
  out.tally = tally_;
  out.left_out = hands_.left_out();
  out.port_energy = port_.absorbed() + hands_.transferred() + static_.carried() - pressed_.work();
  out.encoder_allowance = port_.encoder_allowance();
  out.softening = crowd_share_ * softening_.share();
  out.loan = port_.owed();
  out.region_loan = port_.region_loan().owed();
  out.region_loan_most = region_loan_most_ = std::max(region_loan_most_, out.region_loan);
  out.oscillation_energy = port_.oscillations().spent() + port_.shakes_under_way(period_);
  port_min_ = std::min(port_min_, out.port_energy + out.loan + out.source_energy());
  out.port_energy_min = port_min_;
  out.late_cost = port_.late_cost();
  out.loan_most = loan_most_ = std::max(loan_most_, out.loan);
  if (trace_ != nullptr) trace_->push(out);
  snapshots_.publish();
}

template void ServoStepOf<3>::publish(bool) noexcept;
template void ServoStepOf<6>::publish(bool) noexcept;

}  // namespace reckon::haptics
