// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/contact_forces.hpp"

#include <limits>

namespace reckon::tools {

using std::chrono::nanoseconds;

ContactForces::Placed ContactForces::place(const ReceivedEntity& entity, const ReceivedModel& model,
                                           nanoseconds time) {
  Placed placed{&entity.id,           &model.model,
                entity.pose_at(time), {},
                model.is_probe(),     time <= model.valid_until(),
                model.model.radius};
  if (!placed.is_probe) placed.reach = std::numeric_limits<double>::infinity();
  placed.probe = model.probe_at(placed.pose);
  return placed;
}

bool ContactForces::may_touch(const Placed& on, const Placed& by) {
  const double reach = by.reach + on.probe.radius;
  return on.is_probe && by.is_valid &&
         (on.probe.position - by.probe.position).squaredNorm() <= reach * reach;
}

ContactForce ContactForces::between(const Placed& on, const Placed& by) {
  ContactForce out{*on.id, *by.id, 0.0, Eigen::Vector3d::Zero()};
  if (!may_touch(on, by)) return out;
  out.depth = deadreckon::contact(*by.model, by.pose, on.probe.position, on.probe.radius).depth;
  out.force = deadreckon::evaluate(*by.model, by.pose, on.probe);
  return out;
}

std::span<const ContactForce> ContactForces::forces_at(const Listener& listener, nanoseconds time) {
  placed_.clear();
  forces_.clear();
  for (const ReceivedEntity& entity : listener.entities())
    if (const ReceivedModel* model = listener.model_of(entity))
      placed_.push_back(place(entity, *model, time));
  for (const Placed& on : placed_) {
    if (!on.is_probe) continue;
    for (const Placed& by : placed_) {
      if (&on == &by || !may_touch(on, by)) continue;
      const ContactForce force = between(on, by);
      if (force.depth > 0) forces_.push_back(force);
    }
  }
  return forces_;
}

Eigen::Vector3d ContactForces::force_on(const Listener& listener, const pdu::EntityId& id,
                                        nanoseconds time) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const ReceivedEntity* entity = listener.find_entity(id);
  if (entity == nullptr || !entity->is_haptic()) return sum;
  const Placed on = place(*entity, *listener.model_of(*entity), time);
  for (const ReceivedEntity& other : listener.entities())
    if (other.is_haptic() && &other != entity)
      sum += between(on, place(other, *listener.model_of(other), time)).force;
  return sum;
}

std::span<const ForceJump> ContactForces::jumps_of_datagram(const Listener& listener,
                                                            nanoseconds time) {
  jumps_.clear();
  for (const TouchedEntity& touched : listener.touched())
    if (touched.known && !touched.refused && touched.before.is_haptic())
      note_jumps(listener, touched, time);
  return jumps_;
}

void ContactForces::note_jumps(const Listener& listener, const TouchedEntity& touched,
                               nanoseconds time) {
  const ReceivedEntity* entity = listener.find_entity(touched.id);
  if (entity == nullptr || !entity->is_haptic()) return;
  const Placed before = place(touched.before, touched.model_before, time);
  const Placed after = place(*entity, *listener.model_of(*entity), time);
  const auto note = [&](const ContactForce& was, const ContactForce& is) {
    if (was.depth > 0 || is.depth > 0)
      jumps_.push_back({is.on, is.by, (is.force - was.force).norm()});
  };
  for (const ReceivedEntity& other : listener.entities()) {
    if (!other.is_haptic() || &other == entity) continue;
    const Placed there = place(other, *listener.model_of(other), time);
    note(between(before, there), between(after, there));
    note(between(there, before), between(there, after));
  }
}

}  // namespace reckon::tools
