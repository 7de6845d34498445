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
#include "reckon/peer/tracks/hand_trace_file.hpp"

namespace reckon::tools {
namespace {

using haptics::HandTarget;

constexpr double kMeshSize =
    0.2;                        // [m], bounding diagonal of a mesh that takes another shape's place
constexpr double kDip = 0.015;  // [m], how far a fitted trace goes above and below the top
constexpr double kSideBySide = 1.9;  // radii between hands on the same trace: they press a little

constexpr double kAside = 6.0;  // radii that hands with the same operator are apart, upwards

// Starts late, plays faster, stands elsewhere.
haptics::HandScript follow(haptics::HandTrace trace, const peer::OperatorConfig& config) {
  return [trace = std::move(trace), config](double time) {
    const double at = std::max(0.0, time - pdu::to_seconds(config.start)) * config.speed;
    HandTarget target = trace.at(at);
    target.position += config.position;
    target.velocity *= at > 0.0 ? config.speed : 0.0;
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
    return target;
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

haptics::SceneObject& first_object(peer::SceneFile& scene) {
  if (scene.scene.objects.empty()) {
    throw std::runtime_error("the scene has no object whose place another shape could take");
  }
  return scene.scene.objects.front();
}

}  // namespace

std::unique_ptr<haptics::SimulatedDevice> make_simulated_hand(const peer::SceneFile& scene,
                                                              std::size_t index) {
  peer::OperatorConfig config;
  config.position = Eigen::Vector3d(0.05 * static_cast<double>(index), 0.0, 0.2);
  if (!scene.operators.empty()) {
    config = scene.operators[index % scene.operators.size()];
    // A second hand with the same operator stands beside the first.
    const auto round = static_cast<double>(index / scene.operators.size());
    const Eigen::Vector3d aside(0.0, 0.0, kAside * scene.hand.radius * round);
    config.position += aside;
    config.from += aside;
    config.to += aside;
  }

  haptics::HandScript script = script_of(config);
  haptics::SimulatedDeviceConfig device;
  device.hand_stiffness = config.stiffness;
  device.hand_damping = config.damping;
  device.start = script(0.0).position;
  return std::make_unique<haptics::SimulatedDevice>(device, std::move(script));
}

void check_files(const peer::SceneFile& scene, std::size_t hands) {
  static_cast<void>(haptics::EffectPlan(scene.scene));
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
    // A plane goes on for ever: take a patch of it.
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
    config.start = std::chrono::nanoseconds(0);
    config.speed = 1.0;
  }
}

}  // namespace reckon::tools
