// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "reckon/haptics/queries/cell_grid.hpp"
#include "reckon/haptics/queries/way_out.hpp"

namespace reckon::tools {
namespace {

using Eigen::Vector3d;
using haptics::PlannedObject;

constexpr double kNearAxis = 1e-6;           // deviation of a direction from an axis of the scene
constexpr std::size_t kMostPairs = 100'000;  // limit of measured pairs
constexpr double kRoundedUp = 0.1e-6;        // [m]

// "+z", or "(0.6, 0, 0.8)"
std::string direction_text(const Vector3d& direction) {
  Eigen::Index axis = 0;
  if (direction.cwiseAbs().maxCoeff(&axis) > 1.0 - kNearAxis)
    return fmt::format("{}{}", direction[axis] > 0.0 ? '+' : '-', "xyz"[axis]);
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", direction.x(), direction.y(), direction.z());
}

// Rounded up to 0.1 um, with a tolerance of a thousandth of that, so that a translation by it
// suffices.
std::string length_text(double length) {
  return fmt::format("{:.6g} mm", std::ceil(length / kRoundedUp - 1e-3) * 1e3 * kRoundedUp);
}

// An unbounded implicit solid.
bool is_passed_through(const PlannedObject& object) {
  const auto* solid = std::get_if<std::shared_ptr<const haptics::ImplicitSolid>>(&object.shape);
  return solid != nullptr && !(*solid)->bounds().sizes().allFinite();
}

std::optional<peer::SceneProblem> problem_of(const PlannedObject& body,
                                             const PlannedObject& other) {
  const haptics::WayOut out =
      haptics::way_out(haptics::QueryShape(other.shape), {other.position, other.orientation},
                       haptics::QueryShape(body.shape), {body.position, body.orientation});
  if (!(out.way > kDepthAtRest)) return std::nullopt;
  return peer::SceneProblem{0, 0,
                            fmt::format("object '{}' starts {} deep in '{}', and contact will push "
                                        "them apart: move '{}' by {} along {}",
                                        body.name, length_text(out.way), other.name, body.name,
                                        length_text(out.way), direction_text(out.direction))};
}

}  // namespace

std::vector<peer::SceneProblem> crowded_bodies(const haptics::EffectPlan& plan) {
  const std::vector<PlannedObject>& objects = plan.objects();
  haptics::CellGrid grid(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    if (!is_passed_through(objects[i])) grid.place(i, objects[i].bounds);
  }
  std::vector<haptics::BoxPair> near;
  for (std::uint32_t i = 0; i < objects.size() && near.size() < kMostPairs; ++i) {
    if (!objects[i].moves() || is_passed_through(objects[i])) continue;
    grid.visit(objects[i].bounds, [&](std::uint32_t other) {
      if (other < i || (other > i && !objects[other].moves()))
        near.push_back({std::min(i, other), std::max(i, other)});
    });
  }
  std::sort(near.begin(), near.end(), [](const auto& one, const auto& other) {
    return one.second != other.second ? one.second < other.second : one.first < other.first;
  });
  std::vector<peer::SceneProblem> problems;
  for (const haptics::BoxPair& pair : near) {
    const PlannedObject& first = objects[pair.first];
    const PlannedObject& second = objects[pair.second];
    // If both are bodies, the later one is to be moved.
    auto problem = second.moves() ? problem_of(second, first) : problem_of(first, second);
    if (problem) problems.push_back(std::move(*problem));
  }
  return problems;
}

}  // namespace reckon::tools
