// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A table on which bodies rest, fall and meet.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "reckon/haptics/bodies/body_world.hpp"

namespace reckon::haptics::tables {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

inline constexpr nanoseconds kStep = std::chrono::milliseconds(1);
inline constexpr double kG = 9.81;

/// Objects of a scene, and its world on a stepped clock.
class Table {
 public:
  /// The reference is valid until the next object is added.
  SceneObject& box(double edge, const Vector3d& at, Matter matter) {
    SceneObject& object = scene_.objects.emplace_back();
    object.name = "box " + std::to_string(scene_.objects.size());
    object.shape = BoxShape{Vector3d::Constant(edge)};
    object.pose.position = at;
    object.matter = matter;
    return object;
  }
  SceneObject& ball(double radius, const Vector3d& at, Matter matter) {
    SceneObject& object = box(1.0, at, matter);
    object.shape = SphereShape{radius};
    return object;
  }
  SceneObject& floor(Matter matter = {}) {
    SceneObject& object = box(1.0, Vector3d::Zero(), matter);
    object.shape = PlaneShape{Vector3d::UnitZ()};
    return object;
  }
  void without_gravity() { scene_.gravity.setZero(); }
  void within(const Vector3d& size, double restitution) {
    scene_.work_space.size = size;
    scene_.work_space.restitution = restitution;
  }
  BodyWorld& begin(std::shared_ptr<ObjectMover> mover = nullptr) {
    plan_.emplace(scene_);
    world_ =
        std::make_unique<BodyWorld>(*plan_, scene_.gravity, std::move(mover), scene_.work_space);
    world_->advance_to(now_);
    return *world_;
  }
  void run(double seconds, nanoseconds step = kStep) {
    const auto steps = std::llround(seconds / (1e-9 * static_cast<double>(step.count())));
    for (long i = 0; i < steps; ++i) world_->advance_to(now_ += step);
  }
  [[nodiscard]] nanoseconds now() const { return now_; }
  [[nodiscard]] BodyWorld& world() { return *world_; }
  [[nodiscard]] const BodyState& state(std::size_t body = 0) const {
    return world_->states()[body];
  }

 private:
  Scene scene_;
  std::optional<EffectPlan> plan_;
  std::unique_ptr<BodyWorld> world_;
  nanoseconds now_{1'000'000'000};
};

}  // namespace reckon::haptics::tables
