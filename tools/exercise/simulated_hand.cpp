// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/simulated_hand.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/tracks/hand_trace_file.hpp"

namespace reckon::tools {
namespace {

using haptics::HandTarget;
using std::chrono::nanoseconds;

constexpr double kMeshSize = 0.2;    // [m], bounding diagonal of a mesh that replaces another shape
constexpr double kDip = 0.015;       // [m], amplitude of a fitted trace above and below the top
constexpr double kSideBySide = 1.9;  // radii between hands on the same trace: they press a
                                     // little

// Duration of an approach from the side: hands that appear inside each other feel nothing.
constexpr nanoseconds kComes = std::chrono::seconds(1);

constexpr double kAside = 6.0;  // radii between hands with the same operator, upwards

// State of a minimum-jerk approach.
struct Approach {
  double left = 1.0;  // 1 at its begin, 0 at its end
  double rate = 0.0;  // [1/s]
};
Approach approach(double time, double duration) {
  if (!(time < duration)) return {0.0, 0.0};
  const double u = std::max(0.0, time / duration);
  return {1.0 - u * u * u * (10.0 + u * (6.0 * u - 15.0)),
          -30.0 * u * u * (1.0 - u) * (1.0 - u) / duration};
}

// Applies approach, start time, speed, offset within the recording and offset of position.
haptics::HandScript follow(haptics::HandTrace trace, const peer::OperatorConfig& config) {
  return [trace = std::move(trace), config](double time) {
    const double start = pdu::to_seconds(config.start);
    const double played = std::max(0.0, time - start) * config.speed;
    HandTarget target = trace.at(pdu::to_seconds(config.begin) + played);
    target.position += config.position;
    target.velocity *= played > 0.0 ? config.speed : 0.0;
    const Approach way = approach(time, start);
    target.position += way.left * config.approach;
    target.velocity += way.rate * config.approach;
    return target;
  };
}

haptics::HandScript sweep(const peer::OperatorConfig& config) {
  return [config](double time) {
    const double period = pdu::to_seconds(config.period);
    const double rate = 2.0 * std::numbers::pi / period;
    const double phase = rate * std::max(0.0, time - pdu::to_seconds(config.start));
    const Eigen::Vector3d way = config.to - config.from;
    HandTarget target;
    target.position = config.from + 0.5 * (1.0 - std::cos(phase)) * way;
    target.velocity = 0.5 * rate * std::sin(phase) * way;
    target.buttons = config.grabs && std::sin(phase) > 0 ? 1 : 0;
    return target;
  };
}

haptics::TurnScript straight_turns_of(const peer::DeviceConfig& device,
                                      const peer::OperatorConfig& config) {
  const Eigen::Quaterniond from_S = device.orientation.conjugate();
  return [from_S, config](double time) {
    const double rate = 2.0 * std::numbers::pi / pdu::to_seconds(config.period);
    const double phase = rate * std::max(0.0, time - pdu::to_seconds(config.start));
    const double whole = config.turned.norm(), share = 0.5 * (1.0 - std::cos(phase));
    haptics::DeviceTurn turn{from_S, Eigen::Vector3d::Zero()};
    if (!(whole > 0)) return turn;
    turn.orientation = from_S * Eigen::AngleAxisd(share * whole, config.turned / whole);
    turn.rate = from_S * (0.5 * rate * std::sin(phase) * config.turned);
    return turn;
  };
}

/// In axes of the device, in phase with the sweep.
haptics::TurnScript turns_of(const peer::DeviceConfig& device, const peer::OperatorConfig& config) {
  haptics::TurnScript turns = straight_turns_of(device, config);
  if (!device.left_handed) return turns;
  return [turns = std::move(turns)](double time) {
    const haptics::DeviceTurn turn = turns(time);
    return haptics::DeviceTurn{haptics::mirrored(turn.orientation),
                               haptics::mirrored_turn(turn.rate)};
  };
}

haptics::HandScript script_of(const peer::OperatorConfig& config) {
  switch (config.kind) {
    case peer::OperatorKind::trace: {
      haptics::HandTraceOptions options;
      options.fit_to = config.fit_to;
      return follow(peer::read_hand_trace(config.trace, options), config);
    }
    case peer::OperatorKind::sweep:
      return sweep(config);
    case peer::OperatorKind::passive:
      break;
  }
  return [config](double) {
    HandTarget target;
    target.position = config.position;
    return target;
  };
}

/// Maps a target from frame S to the device.
haptics::HandScript in_axes_of(const peer::DeviceConfig& device, haptics::HandScript in_scene) {
  Eigen::Matrix3d R_DS = device.orientation.conjugate().toRotationMatrix();
  if (device.left_handed) R_DS.row(0) *= -1.0;
  return [R_DS, ways = 1.0 / device.scale, origin = device.position,
          in_scene = std::move(in_scene)](double time) {
    HandTarget target = in_scene(time);
    target.position = ways * (R_DS * (target.position - origin));
    target.velocity = ways * (R_DS * target.velocity);
    target.push = R_DS * target.push;
    return target;
  };
}

// A force that is held while the servo is late acts on the hand with outdated values.
nanoseconds hold_of(nanoseconds period) {
  return std::min<nanoseconds>(3 * period / 2, haptics::HapticDevice::kWatchdog);
}

/// A device and the operator's hand on it.
struct Held {
  haptics::SimulatedDeviceConfig config;
  haptics::HandScript script;
  haptics::TurnScript turns;
};

Held hold(const peer::SceneFile& scene, const peer::DeviceConfig& device,
          const haptics::HandScript& path) {
  const peer::OperatorConfig config = operator_of(scene, device.operator_number);
  Held held{{}, in_axes_of(device, path ? path : script_of(config)), turns_of(device, config)};
  haptics::SimulatedDeviceConfig& made = held.config;
  made.hand_stiffness = config.stiffness;
  made.hand_damping = config.damping;
  made.start = held.script(0.0).position;
  made.max_force = device.max_force;
  made.damping = device.damping;
  made.max_stiffness = device.max_stiffness;
  made.max_speed = device.max_speed;
  made.delay_samples = device.delay_samples;
  made.resolution = device.resolution;
  made.mass = device.described.mass;
  made.friction = device.described.friction;
  made.workspace = device.described.work_space;
  made.hold = hold_of(device.period);
  if (device.axes != 6) return held;
  haptics::SimulatedTurnConfig& turn = made.turn.emplace();
  turn.damping = device.turn_damping;
  turn.inertia = device.described.inertia;
  turn.max_torque = device.max_torque;
  turn.resolution = device.turn_resolution;
  turn.hand_stiffness = config.turn_stiffness;
  turn.hand_damping = config.turn_damping;
  turn.start = held.turns(0.0).orientation;
  return held;
}

haptics::SceneObject& first_object(peer::SceneFile& scene) {
  if (scene.scene.objects.empty()) {
    throw std::runtime_error("the scene has no object that another shape could replace");
  }
  return scene.scene.objects.front();
}

}  // namespace

peer::OperatorConfig operator_of(const peer::SceneFile& scene, std::uint32_t number) {
  const std::size_t index = std::max<std::size_t>(number, 1) - 1;
  peer::OperatorConfig config;
  config.position = Eigen::Vector3d(0.05 * static_cast<double>(index), 0.0, 0.2);
  if (scene.operators.empty()) return config;
  config = scene.operators[index % scene.operators.size()];
  // A second hand with the same operator is placed beside the first.
  const auto round = static_cast<double>(index / scene.operators.size());
  const Eigen::Vector3d aside(0.0, 0.0, kAside * scene.hand.radius * round);
  config.position += aside;
  config.from += aside;
  config.to += aside;
  return config;
}

Eigen::Vector3d begin_of(const peer::SceneFile& scene, std::uint32_t number) {
  const peer::OperatorConfig config = operator_of(scene, number);
  if (config.kind == peer::OperatorKind::sweep) return 0.5 * (config.from + config.to);
  return script_of(config)(pdu::to_seconds(config.start)).position;
}

std::vector<Eigen::Vector3d> probes_of(const peer::DeviceConfig& device) {
  std::vector<Eigen::Vector3d> places;
  for (const peer::ProbeConfig& probe : device.probes) places.push_back(probe.position);
  return places;
}

haptics::HandMapping mapping_of(const peer::DeviceConfig& device) {
  haptics::HandMapping mapping{device.scale, device.left_handed, {}};
  if (device.clutch_button >= 0) mapping.clutch_button = device.clutch_button;
  return mapping;
}

std::unique_ptr<haptics::PointerDevice> make_pointer_device(const peer::SceneFile& scene,
                                                            const peer::DeviceConfig& device) {
  Held held = hold(scene, device, nullptr);
  const bool moves = operator_of(scene, device.operator_number).kind != peer::OperatorKind::passive;
  return std::make_unique<haptics::PointerDevice>(held.config, device.reach,
                                                  moves ? std::move(held.script) : nullptr);
}

std::unique_ptr<haptics::SimulatedDevice> make_simulated_device(const peer::SceneFile& scene,
                                                                const peer::DeviceConfig& device,
                                                                const haptics::HandScript& path) {
  if (device.source == peer::DeviceSource::pointer && !path) {
    return make_pointer_device(scene, device);
  }
  Held held = hold(scene, device, path);
  return std::make_unique<haptics::SimulatedDevice>(held.config, std::move(held.script),
                                                    std::move(held.turns));
}

std::unique_ptr<AdmittanceHand> make_admittance_hand(const peer::SceneFile& scene,
                                                     const peer::DeviceConfig& device,
                                                     const haptics::HandScript& path) {
  Held held = hold(scene, device, path);
  haptics::SimulatedMotionConfig motion;
  motion.loop = device.admittance.loop;
  motion.bandwidth = device.admittance.bandwidth;
  motion.sensor_stiffness = device.admittance.sensor_stiffness;
  motion.hand_stiffness = held.config.hand_stiffness;
  motion.hand_damping = held.config.hand_damping;
  motion.max_force = device.max_force;
  motion.max_speed = device.max_speed;
  motion.delay_samples = device.delay_samples;
  motion.start = held.config.start;
  motion.workspace = held.config.workspace;
  haptics::VirtualHandleConfig handle;
  handle.mass = device.admittance.mass;
  handle.damping = device.damping;
  handle.hold = held.config.hold;
  return std::make_unique<AdmittanceHand>(motion, std::move(held.script), handle);
}

std::unique_ptr<haptics::HapticDevice> make_held_device(const peer::SceneFile& scene,
                                                        const peer::DeviceConfig& device) {
  if (device.admittance.mass > 0) return make_admittance_hand(scene, device);
  return make_simulated_device(scene, device);
}

std::vector<std::string> SimulatedHands::take_notices() {
  std::vector<std::string> all;
  for (const auto& hand : admittance)
    if (std::string sentence = hand->take_notice(); !sentence.empty())
      all.push_back(std::move(sentence));
  return all;
}

std::unique_ptr<haptics::SimulatedDevice> make_simulated_hand(const peer::SceneFile& scene,
                                                              std::size_t index,
                                                              const haptics::HandScript& path) {
  peer::DeviceConfig device;
  device.operator_number = static_cast<std::uint32_t>(index + 1);
  return make_simulated_device(scene, device, path);
}

SimulatedHands make_simulated_hands(const peer::SceneFile& scene, std::uint32_t peer,
                                    const haptics::HandScript& script) {
  SimulatedHands hands;
  for (const peer::DeviceConfig& config : peer::devices_of(scene, peer)) {
    haptics::HapticDevice* wired = nullptr;
    if (config.admittance.mass > 0) {
      wired = hands.admittance.emplace_back(make_admittance_hand(scene, config, script)).get();
    } else if (config.source == peer::DeviceSource::pointer && !script) {
      auto device = make_pointer_device(scene, config);
      hands.pointers.push_back({hands.wired.size(), &device->inbox(), config.position,
                                config.orientation, nullptr, hands.devices.size()});
      wired = hands.devices.emplace_back(std::move(device)).get();
    } else {
      wired = hands.devices.emplace_back(make_simulated_device(scene, config, script)).get();
    }
    if (const haptics::HandMapping mapping = mapping_of(config); !mapping.is_plain())
      wired =
          hands.mapped.emplace_back(std::make_unique<haptics::MappedDevice>(*wired, mapping)).get();
    hands.wired.push_back({wired, config.marking, config.position, config.orientation,
                           config.period, config.continuous_force / config.scale,
                           config.thermal_time, config.max_force_rate, config.received_power,
                           config.regions.loan, config.regions.oscillation_power,
                           config.regions.oscillation_energy, config.grab_button,
                           config.stop_button, probes_of(config)});
  }
  return hands;
}

void check_files(const peer::SceneFile& scene, std::size_t hands) {
  static_cast<void>(haptics::EffectPlan(scene.scene));
  for (const peer::DeviceConfig& device : scene.devices) {
    static_cast<void>(make_held_device(scene, device));
  }
  if (!scene.devices.empty()) return;
  const std::size_t different = std::min(hands, scene.operators.size());
  for (std::size_t i = 0; i < different; ++i) static_cast<void>(make_simulated_hand(scene, i));
}

void put_mesh(peer::SceneFile& scene, const std::filesystem::path& file) {
  haptics::SceneObject& object = first_object(scene);
  haptics::MeshShape mesh;
  mesh.file = std::filesystem::absolute(file);
  mesh.centre = true;
  mesh.scale_to = kMeshSize;
  if (const auto* old = std::get_if<haptics::MeshShape>(&object.shape)) {
    if (old->scale_to > 0.0) mesh.scale_to = old->scale_to;
  }
  object.shape = mesh;
  object.name = file.stem().string();
  scene.hash = peer::scene_hash(scene);
}

void put_trace(peer::SceneFile& scene, const std::filesystem::path& file) {
  static_cast<void>(first_object(scene));
  const haptics::EffectPlan plan(scene.scene);
  Eigen::AlignedBox3d bounds = plan.objects().front().bounds;
  if (!bounds.sizes().allFinite() || bounds.sizes().norm() > 10.0) {
    // A plane is unbounded: use a patch of it.
    const Eigen::Vector3d centre = plan.objects().front().position;
    bounds = Eigen::AlignedBox3d(centre - Eigen::Vector3d(0.05, 0.05, 0.1),
                                 centre + Eigen::Vector3d(0.05, 0.05, 0.0));
  }
  const double top = bounds.max().z();
  const Eigen::Vector3d half(0.4 * bounds.sizes().x(), 0.4 * bounds.sizes().y(), kDip);
  const Eigen::Vector3d centre(bounds.center().x(), bounds.center().y(), top);

  const std::size_t hands = std::max<std::size_t>(2, scene.operators.size());
  scene.operators.resize(hands);
  for (std::size_t i = 0; i < hands; ++i) {
    peer::OperatorConfig& config = scene.operators[i];
    config.kind = peer::OperatorKind::trace;
    config.trace = std::filesystem::absolute(file);
    config.fit_to = Eigen::AlignedBox3d(centre - half, centre + half);
    config.position =
        Eigen::Vector3d(kSideBySide * scene.hand.radius * static_cast<double>(i), 0, 0);
    config.start = kComes;
    config.begin = nanoseconds(0);
    config.approach = {static_cast<double>(i) * scene.hand.radius, 0, 0};
    config.speed = 1.0;
  }
}

}  // namespace reckon::tools
