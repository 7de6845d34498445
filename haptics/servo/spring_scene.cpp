// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/spring_scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>

namespace reckon::haptics {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kAlong = 1e-6;  // [rad], angle between a face's normal and an axis

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw std::invalid_argument("'" + name + "' " + what);
}

// The axis parallel to a unit vector; std::nullopt: none.
std::optional<Index> axis_of(const Vector3d& direction) noexcept {
  Index axis = 0;
  const double most = direction.cwiseAbs().maxCoeff(&axis);
  return (direction - std::copysign(1.0, direction[axis]) * Vector3d::Unit(axis)).norm() <=
                     kAlong &&
                 most > 0
             ? std::optional(axis)
             : std::nullopt;
}

void check_effects(const PlannedObject& object) {
  if (object.moves())
    refuse(object.name, "moves: a device that renders springs needs fixed surfaces");
  if (object.patches != nullptr)
    refuse(object.name, "has patches: a device that renders springs needs one stiffness an object");
  object.effects.for_each([&]<class Effect>(const Effect& effect) {
    if constexpr (!std::is_same_v<Effect, SpringDamper>) {
      refuse(object.name,
             "has an effect besides its surface: a device that renders springs has stiffness only; "
             "remove the effect, or use a device that takes forces");
    } else if (effect.damping() > 0) {
      refuse(object.name,
             "has damping: a device that renders springs has stiffness only; remove the damping of "
             "its surface");
    }
  });
}

}  // namespace

SpringScene::SpringScene(const EffectPlan& plan, const ServoConfig& config, int axes,
                         double most_stiffness)
    : axes_(static_cast<std::size_t>(axes)), most_stiffness_(most_stiffness) {
  if (!plan.regions().empty()) {
    refuse(plan.regions().front().name,
           "is a region: a device that renders springs has surfaces only; remove it, or use a "
           "device that takes forces");
  }
  for (const PlannedObject& object : plan.objects()) {
    check_effects(object);
    if (auto solid = solid_of(object, config)) solids_.push_back(*solid);
  }
}

// std::nullopt: the handle cannot be inside it.
std::optional<SpringScene::Solid> SpringScene::solid_of(const PlannedObject& object,
                                                        const ServoConfig& config) const {
  const char* const oblique =
      "has faces that are not perpendicular to the device's axes, along which it renders springs: "
      "rotate the object or the device";
  const Matrix3d turn =
      config.device_orientation.conjugate().toRotationMatrix() * object.orientation;
  const Vector3d at =
      config.device_orientation.conjugate() * (object.position - config.device_origin);
  std::array<double, 3> from{-kFar, -kFar, -kFar}, to{kFar, kFar, kFar};
  if (const auto* plane = std::get_if<HalfSpace>(&object.shape)) {
    const Vector3d normal = turn * plane->normal();
    const auto axis = axis_of(normal);
    if (!axis) refuse(object.name, oblique);
    const auto i = static_cast<std::size_t>(*axis);
    (normal[*axis] > 0 ? to : from)[i] = at[*axis];
  } else if (const auto* box = std::get_if<Block>(&object.shape)) {
    const Vector3d half = box->bounds().max();
    for (Index edge = 0; edge < 3; ++edge) {
      const auto axis = axis_of(turn.col(edge));
      if (!axis) refuse(object.name, oblique);
      const auto i = static_cast<std::size_t>(*axis);
      from[i] = at[*axis] - half[edge];
      to[i] = at[*axis] + half[edge];
    }
  } else {
    refuse(object.name,
           "is neither a plane nor a box: a device that renders springs needs one of them; use a "
           "device that takes forces");
  }
  Solid solid;
  solid.stiffness = std::min(object.stiffness(), most_stiffness_);
  bool is_walled = false;  // it has a face perpendicular to an axis of the device
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] -= config.contact_radius;
    to[i] += config.contact_radius;
    if (i < axes_) {
      solid.from[i] = from[i];
      solid.to[i] = to[i];
      is_walled = is_walled || std::isfinite(from[i]) || std::isfinite(to[i]);
    } else if (from[i] > 0 || to[i] < 0) {
      return std::nullopt;
    }
  }
  if (!is_walled) {
    refuse(object.name,
           "encloses the handle, and no axis of the device crosses its faces: place the device "
           "outside of it, or rotate it");
  }
  return solid;
}

bool SpringScene::has(const Solid& solid, std::size_t axis, const Vector3d& place) const noexcept {
  const double x = place[static_cast<Index>(axis)];
  return x > solid.from[axis] && x < solid.to[axis];
}

// The nearest face of a solid that contains the position.
std::optional<SpringScene::Face> SpringScene::nearest_face(const Solid& solid,
                                                           const Vector3d& place) const noexcept {
  std::optional<Face> nearest;
  double least = kFar;
  for (std::size_t axis = 0; axis < axes_; ++axis) {
    const double x = place[static_cast<Index>(axis)];
    if (x - solid.from[axis] < least) {
      least = x - solid.from[axis];
      nearest = Face{axis, WallSide::above};
    }
    if (solid.to[axis] - x < least) {
      least = solid.to[axis] - x;
      nearest = Face{axis, WallSide::below};
    }
  }
  return nearest;
}

// Of two walls on one side, the nearer one counts.
void SpringScene::add(const Solid& solid, Face face, double most_force,
                      SpringModel& model) const noexcept {
  const bool is_below = face.side == WallSide::below;
  const double at = is_below ? solid.to[face.axis] : solid.from[face.axis];
  SpringWall& wall = model.wall(face.axis, face.side);
  if (wall.stiffness > 0 && (is_below ? wall.at >= at : wall.at <= at)) return;
  wall = {at, solid.stiffness, most_force};
}

SpringModel SpringScene::walls_at(const Vector3d& place, double most_force) noexcept {
  SpringModel model;
  for (Solid& solid : solids_) {
    std::size_t outside = 0;  // axes on which the handle is outside
    std::size_t across = 0;   // the last of these axes
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      if (has(solid, axis, place)) continue;
      ++outside;
      across = axis;
    }
    if (outside == 1) {
      const bool is_past = place[static_cast<Index>(across)] >= solid.to[across];
      solid.entered = Face{across, is_past ? WallSide::below : WallSide::above};
    } else if (outside > 1) {
      solid.entered.reset();  // diagonally off an edge, no face is ahead along an axis
    } else if (!solid.entered) {
      solid.entered = nearest_face(solid, place);
    }
    if (solid.entered) add(solid, *solid.entered, most_force, model);
  }
  return model;
}

}  // namespace reckon::haptics
