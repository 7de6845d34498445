// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Implicit solids of about 0.1 m for tests and benchmarks of touch: each primitive, and solids of
// several parts with sharp, rounded, concave and convex edges.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/geometry/implicit_solid.hpp"

namespace reckon::test {

struct NamedSolid {
  std::string name;
  std::shared_ptr<const haptics::ImplicitSolid> solid;
};

inline haptics::CsgPart part(haptics::CsgOperation operation,
                             decltype(haptics::CsgPart::shape) shape,
                             const Eigen::Vector3d& position = Eigen::Vector3d::Zero(),
                             double rounding = 0.0) {
  return {operation, shape, position, Eigen::Quaterniond::Identity(), rounding};
}

/// A step: two blocks that meet in a concave edge along y at x = 0, z = 0.
inline haptics::CsgShape step_shape(double rounding) {
  using enum haptics::CsgOperation;
  return {{part(add, haptics::BoxShape{{0.2, 0.1, 0.02}}, {0.0, 0.0, -0.01}),
           part(add, haptics::BoxShape{{0.1, 0.1, 0.06}}, {-0.05, 0.0, 0.01}, rounding)}};
}

/// A plate with a bore and a slot, a post with a bulb on it, and a foot: eight parts.
inline haptics::CsgShape bracket_shape(double rounding) {
  using enum haptics::CsgOperation;
  using namespace haptics;
  CsgShape shape{{part(add, BoxShape{{0.12, 0.08, 0.02}}),
                  part(subtract, CylinderShape{0.012, 0.1}, {0.03, 0.0, 0.0}, rounding),
                  part(subtract, BoxShape{{0.01, 0.05, 0.1}}, {-0.045, 0.0, 0.0}, rounding),
                  part(add, CylinderShape{0.012, 0.06}, {-0.01, 0.0, 0.03}, rounding),
                  part(add, SphereShape{0.018}, {-0.01, 0.0, 0.06}, rounding),
                  part(add, ConeShape{0.02, 0.005, 0.04}, {-0.01, 0.0, -0.02}, rounding),
                  part(subtract, TorusShape{0.02, 0.004}, {0.03, 0.0, 0.01}, 0.0),
                  part(intersect, SphereShape{0.09}, {0.0, 0.0, 0.02}, rounding)}};
  shape.parts[5].orientation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, 0.5).normalized());
  return shape;
}

inline std::vector<NamedSolid> implicit_solids() {
  using enum haptics::CsgOperation;
  using namespace haptics;
  const auto make = [](const auto& shape) { return std::make_shared<const ImplicitSolid>(shape); };
  return {{"half_space", make(CsgShape{{part(add, PlaneShape{})}})},
          {"sphere", make(CsgShape{{part(add, SphereShape{0.05})}})},
          {"box", make(CsgShape{{part(add, BoxShape{{0.1, 0.06, 0.08}})}})},
          {"cylinder", make(CylinderShape{0.03, 0.08})},
          {"cone", make(ConeShape{0.04, 0.0, 0.08})},
          {"frustum", make(ConeShape{0.02, 0.04, 0.05})},
          {"torus", make(TorusShape{0.04, 0.015})},
          {"ellipsoid", make(EllipsoidShape{{0.06, 0.04, 0.02}})},
          {"step", make(step_shape(0.0))},
          {"step_rounded", make(step_shape(0.01))},
          {"bracket", make(bracket_shape(0.0))},
          {"bracket_rounded", make(bracket_shape(0.004))}};
}

}  // namespace reckon::test
