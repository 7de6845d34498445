// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/hand_config.hpp"

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

deadreckon::ForceModel to_force_model(const HandModel& hand) {
  deadreckon::ForceModel model;
  model.kind = pdu::ForceModelKind::sphere;
  model.radius = hand.radius;
  model.k1 = hand.k1;
  model.k3 = hand.k3;
  model.damping = hand.damping;
  model.static_friction = hand.static_friction;
  model.kinetic_friction = hand.kinetic_friction;
  model.validity = pdu::to_seconds(hand.validity);
  return model;
}

}  // namespace reckon::peer
