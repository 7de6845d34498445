// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/received_entity.hpp"

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/state_age.hpp"

namespace reckon::tools {

using std::chrono::nanoseconds;

double ReceivedEntity::age(nanoseconds now) const noexcept {
  return pdu::to_seconds(now - arrival);
}

bool ReceivedEntity::is_silent(nanoseconds now) const noexcept {
  return has_state && !gone && age(now) > deadreckon::timeout(heartbeat);
}

deadreckon::Pose ReceivedEntity::pose_at(nanoseconds time) const noexcept {
  const peer::StateAge age(time - state_time, hold_after, false);
  deadreckon::Pose pose = deadreckon::extrapolate(state, age.tau);
  age.hold(pose);
  return pose;
}

pdu::EntityState ReceivedEntity::entity_state() const noexcept {
  pdu::EntityState pdu;
  if (has_state) (void)decode(octets, pdu);
  return pdu;
}

nanoseconds ReceivedModel::valid_until() const noexcept {
  return since + pdu::from_seconds(model.validity);
}

bool ReceivedModel::is_probe() const noexcept {
  return model.kind == pdu::ForceModelKind::sphere || model.kind == pdu::ForceModelKind::field;
}

deadreckon::ProbeState ReceivedModel::probe_at(const deadreckon::Pose& pose) const noexcept {
  const bool is_ball = model.kind == pdu::ForceModelKind::sphere;
  return {pose.position + pose.orientation * model.point, pose.velocity,
          is_ball ? model.radius : 0.0};
}

}  // namespace reckon::tools
