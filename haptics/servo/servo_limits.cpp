// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/servo_limits.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

constexpr double kFarthestProbe = 1.0;     // [m]
constexpr double kMostRegionShare = 0.25;  // of the stiffness limit of objects
constexpr double kMostStaticShare = 0.75;  // of b; the rest is reserved for remote hands

void require(bool good, const std::string& text) {
  if (!good) throw std::invalid_argument("servo: " + text);
}

}  // namespace

ServoConfig checked_config(const ServoConfig& c, const DeviceLimits& limits) {
  const double period = pdu::to_seconds(c.period);
  require(period >= 1e-4 && period <= 1e-2,
          "period is " + std::to_string(period) + " s, but must be 0.0001 to 0.01 s");
  require(c.probe_radius >= 0 && c.probe_radius <= 1, "probe radius must be 0 to 1 m");
  require(c.contact_radius >= 0 && c.contact_radius <= 1, "contact radius must be 0 to 1 m");
  require(c.max_force > 0, "largest force must be above 0 N");
  require(c.continuous_force >= 0, "the continuous force must be 0 N (no limit) or more");
  require(c.thermal_time >= 1, "the thermal time constant of motors must be 1 s or more");
  require(c.max_force_rate > 0, "largest rate of the force must be above 0 N/s");
  require(c.max_power > 0, "largest power of the force must be above 0 W");
  require(c.max_received_power > 0, "largest received power must be above 0 W");
  require(c.region_loan >= 0 && c.oscillation_power >= 0 && c.oscillation_energy >= 0,
          "region_loan, oscillation_power and oscillation_energy must be 0 or more");
  require(c.stiffness_share > 0 && c.stiffness_share <= 1,
          "stiffness share of the passive limit must be above 0 and at most 1");
  require(c.grab.stiffness >= 0 && c.grab.viscosity >= 0 && c.grab.most > 0,
          "the grab spring needs a stiffness and a viscosity of 0 or more, and a force limit above "
          "0 N");
  require(c.max_contacts <= kMaxRemoteHands,
          "at most " + std::to_string(kMaxRemoteHands) + " remote hands are possible");
  require(c.device_origin.allFinite() && std::abs(c.device_orientation.norm() - 1.0) < 1e-6,
          "device pose must be finite, its orientation a unit quaternion");
  require(c.probes.empty() || limits.axes == 6,
          "a tool with probes needs a device of 6 axes, with torque; this one has " +
              std::to_string(limits.axes));
  require(c.probes.size() <= kMostProbes,
          "a tool has at most " + std::to_string(kMostProbes) + " probes");
  require(!c.stop_button || (*c.stop_button >= 0 && *c.stop_button < 32),
          "the stop button must be 0 to 31");
  for (const Eigen::Vector3d& probe : c.probes)
    require(probe.norm() <= kFarthestProbe, "a probe must be within 1 m of the handle");
  return c;
}

DeviceLimits checked_limits(const DeviceLimits& limits) {
  require(limits.kind != DeviceKind::admittance, "admittance devices are not supported");
  require(limits.max_force > 0 && std::isfinite(limits.max_force),
          "the device states no largest force");
  require(limits.damping >= 0 && std::isfinite(limits.damping),
          "the device's damping must be 0 or more N s/m");
  require(limits.max_speed > 0, "the device's largest speed must be above 0 m/s");
  if (limits.kind == DeviceKind::coefficients) {
    require(limits.axes == 1 || limits.axes == 2,
            "a device that renders springs must have 1 or 2 axes");
    require(limits.max_stiffness > 0 && std::isfinite(limits.max_stiffness),
            "a device that renders springs must state its greatest stiffness");
  } else {
    require(limits.axes == 3 || limits.axes == 6, "a device must have 3 or 6 axes");
  }
  if (limits.axes == 6) {
    require(limits.max_torque > 0 && std::isfinite(limits.max_torque),
            "the device states no largest torque");
    require(limits.damping > 0 && limits.turn_damping > 0 && std::isfinite(limits.turn_damping),
            "a device of 6 axes needs damping and turn_damping above 0");
    require(limits.turn_resolution >= 0 && std::isfinite(limits.turn_resolution),
            "the device's angular resolution must be 0 or more rad");
  }
  require(limits.delay_samples >= 0, "the device's delay must be 0 or more samples");
  require(limits.resolution >= 0 && std::isfinite(limits.resolution),
          "the device's resolution must be 0 or more m");
  return limits;
}

std::shared_ptr<const EffectPlan> checked_plan(std::shared_ptr<const EffectPlan> plan) {
  require(plan != nullptr, "a plan is needed; it may be empty");
  return plan;
}

std::shared_ptr<BodyWorld> checked_bodies(std::shared_ptr<BodyWorld> bodies, const EffectPlan& plan,
                                          const ServoConfig& config) {
  if (!plan.has_moving()) return nullptr;
  require(bodies != nullptr, "a scene with moving objects needs a BodyWorld");
  std::size_t next = 0;
  for (const PlannedObject& object : plan.objects()) {
    const std::size_t body = next;
    next += object.moves() ? 1 : 0;
    if (!object.is_body()) continue;
    const double most = stiffest_push(object.matter.mass, pdu::to_seconds(config.period));
    if (object.carried && object.stiffness() > most) bodies->keep_carried(body);
    require(object.carried || object.stiffness() <= most,
            "body '" + object.name + "' of " + std::to_string(object.matter.mass) +
                " kg is too light for its stiffness of " + std::to_string(object.stiffness()) +
                " N/m at this rate: at most " + std::to_string(most) +
                " N/m are stable; raise the mass or the rate");
  }
  return bodies;
}

namespace {

// Greatest stiffness and viscosity of all grab springs.
GrabSpring greatest_hold(const EffectPlan& plan, const ServoConfig& config) {
  GrabSpring out;
  for (const PlannedObject& object : plan.objects()) {
    if (!object.is_body()) continue;
    for (const GrabSpring& one : {config.grab, object.grab}) {
      out.stiffness = std::max(out.stiffness, one.stiffness);
      out.viscosity = std::max(out.viscosity, one.viscosity);
    }
  }
  return out;
}

}  // namespace

// K <= share * 2 (b - |B|) / (T (1 + 2 d)), thesis eq (3.8) with the delay of d samples added.
double stiffness_per_damping(const ServoConfig& config, const DeviceLimits& limits) {
  return config.stiffness_share * 2.0 /
         (pdu::to_seconds(config.period) * (1 + 2 * limits.delay_samples));
}

double static_cap(const EffectPlan& plan, const ServoConfig& config, const DeviceLimits& limits,
                  double damping, double per_damping) {
  const double share = kMostStaticShare * damping;
  double objects = 0.0;
  for (const PlannedObject& object : plan.objects()) {
    objects = std::max(objects, object.damping());
  }
  double stiffness = 0.0;
  for (const PlannedRegion& region : plan.regions()) {
    stiffness += region.stiffness();
  }
  const GrabSpring held = greatest_hold(plan, config);
  const double dampers = objects + held.viscosity;
  const double whole = per_damping * (share - std::min(dampers, 0.5 * share));
  const double cap = whole - std::min(stiffness, kMostRegionShare * whole) -
                     std::min(held.stiffness, kMostRegionShare * whole);
  return limits.max_stiffness > 0 ? std::min(cap, limits.max_stiffness) : cap;
}

}  // namespace reckon::haptics
