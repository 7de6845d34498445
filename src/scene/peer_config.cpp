// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/peer_config.hpp"

#include <numbers>

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

namespace {

/// Whether `type` matches `pattern`, in which 0 matches any number.
bool is_of(const pdu::EntityType& type, const pdu::EntityType& pattern) noexcept {
  const auto fits = [](auto value, auto wanted) {
    return wanted == decltype(wanted){} || value == wanted;
  };
  return fits(type.kind, pattern.kind) && fits(type.domain, pattern.domain) &&
         fits(type.country, pattern.country) && fits(type.category, pattern.category) &&
         fits(type.subcategory, pattern.subcategory) && fits(type.specific, pattern.specific) &&
         fits(type.extra, pattern.extra);
}

}  // namespace

const BundlePolicy& bundle_policy_of(const NetworkConfig& network,
                                     const pdu::EntityType& type) noexcept {
  for (const BundleClass& one : network.bundle_classes) {
    if (is_of(type, one.type)) return one.policy;
  }
  return network.bundle;
}

double nimbus_of(const std::vector<NimbusClass>& classes, const pdu::EntityType& type) noexcept {
  for (const NimbusClass& one : classes) {
    if (is_of(type, one.type)) return one.nimbus;
  }
  return 0.0;
}

namespace {

/// From north, east and down to S; its own inverse.
Eigen::Quaterniond from_north_east_down() {
  return {0.0, std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2, 0.0};
}

}  // namespace

Eigen::Quaterniond orientation_of(const Attitude& attitude) noexcept {
  const auto turn = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
  };
  return (from_north_east_down() * turn(attitude.heading, Eigen::Vector3d::UnitZ()) *
          turn(attitude.pitch, Eigen::Vector3d::UnitY()) *
          turn(attitude.roll, Eigen::Vector3d::UnitX()))
      .normalized();
}

Eigen::Quaterniond device_orientation_of(const Attitude& attitude) noexcept {
  return (orientation_of(attitude) * from_north_east_down().conjugate()).normalized();
}

}  // namespace reckon::peer
