// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Precision of a contact: an exact torus and its triangles, and the nearest point by a search that
// ends early.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "reckon/bench/studies/contact/contact_measures.hpp"
#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/haptics/geometry/implicit_solid.hpp"
#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::bench {
namespace {

using Eigen::Vector3d;
using haptics::ContactShape;
using haptics::SurfaceMesh;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRing = 0.05, kTube = 0.02;  // radii [m]
constexpr double kDepth = 0.002;              // [m]
constexpr double kStiffness = 800;            // [N/m]
constexpr std::size_t kSteps = 4000;          // [ms]

/// Twice `around` x `across` triangles, with corners on the surface.
std::shared_ptr<const SurfaceMesh> torus(std::uint32_t around, std::uint32_t across) {
  std::vector<Vector3d> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = kTurn * i / around, v = kTurn * j / across;
      const double ring = kRing + kTube * std::cos(v);
      corners.emplace_back(ring * std::cos(u), ring * std::sin(u), kTube * std::sin(v));
      const std::uint32_t i1 = (i + 1) % around, j1 = (j + 1) % across;
      const std::uint32_t a = i * across + j, b = i1 * across + j, c = i1 * across + j1,
                          d = i * across + j1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return std::make_shared<const SurfaceMesh>(std::move(corners), std::move(triangles));
}

/// A position of the hand, and the outward normal of the torus there.
struct Place {
  Vector3d device, outward;
};

/// Around the ring at about 0.1 m/s, with swings across the tube.
std::vector<Place> stroke(std::uint64_t seed) {
  std::vector<Place> places;
  const double begin = phase_of(seed, 1), turn = phase_of(seed, 2);
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    const double u = begin + kTurn * 0.3 * t, v = 1.2 * std::sin(kTurn * 0.7 * t + turn);
    const Vector3d ring(std::cos(u), std::sin(u), 0);
    const Vector3d outward = std::cos(v) * ring + std::sin(v) * Vector3d::UnitZ();
    places.push_back({kRing * ring + (kTube - kDepth) * outward, outward});
  }
  return places;
}

using Places = std::shared_ptr<const std::vector<Place>>;

/// Follows the places; the first one starts a new contact from outside.
template <typename Force>
TouchSetting setting_of(std::string name, const Places& places, Force force) {
  TouchSetting setting{std::move(name), {}, {}};
  for (std::size_t i = 0; i < places->size(); ++i)
    setting.forces.push_back(force((*places)[i], i == 0));
  setting.run = [force, places, at = std::size_t{0}](std::size_t steps) mutable {
    double sum = 0;
    for (std::size_t i = 0; i < steps; ++i, at = at + 1 == places->size() ? 0 : at + 1)
      sum += force((*places)[at], at == 0).x();
    return sum;
  };
  return setting;
}

/// The surface contact point, as in the servo.
auto contact_with(ContactShape shape) {
  return [shape = std::move(shape), point = haptics::SurfaceContactPoint()](
             const Place& place, bool anew) mutable -> Vector3d {
    if (anew) point.reset(shape, place.device + 2 * kDepth * place.outward);
    point.update(shape, place.device, nullptr);
    return kStiffness * (point.scp() - place.device);
  };
}

/// The nearest point of the whole mesh, searched again each time; the search ends when no other
/// point can be nearer by `precision` [m].
auto nearest_on(std::shared_ptr<const SurfaceMesh> mesh, double precision) {
  return [mesh = std::move(mesh), precision](const Place& place, bool) -> Vector3d {
    haptics::ClosestPoint nearest;
    if (!mesh->closest(place.device, mesh->size(), nearest, precision)) return Vector3d::Zero();
    return kStiffness * (nearest.point - place.device);
  };
}

}  // namespace

TouchCase precision_case(const TouchConditions& conditions) {
  const auto places = std::make_shared<const std::vector<Place>>(stroke(conditions.seed));
  TouchCase made;
  made.truth =
      fmt::format("torus of {} and {} mm, {} N/m, stroked {} mm deep without friction: closed form",
                  1e3 * kRing, 1e3 * kTube, kStiffness, 1e3 * kDepth);
  made.remark =
      "Triangles have their corners on the torus; the error is mostly in the direction, because "
      "facets are flat. Searches: nearest point of the finest mesh, searched in each step to the "
      "stated distance: the tolerance applies to the distance, not to the direction.";
  for (const Place& place : *places) made.force.push_back(kStiffness * kDepth * place.outward);
  std::shared_ptr<const SurfaceMesh> finest;
  for (const std::uint32_t across : {8U, 16U, 32U, 64U, 128U, 256U}) {
    const std::uint32_t around = across * 5 / 2;
    finest = torus(around, across);
    made.settings.push_back(
        setting_of(fmt::format("{} triangles", 2 * around * across), places, contact_with(finest)));
  }
  made.settings.push_back(setting_of("implicit surface", places,
                                     contact_with(std::make_shared<const haptics::ImplicitSolid>(
                                         haptics::TorusShape{kRing, kTube}))));
  for (const double precision : {0.0, 1e-5, 1e-4, 5e-4, 2e-3})
    made.settings.push_back(setting_of(fmt::format("search to {:g} mm", 1e3 * precision), places,
                                       nearest_on(finest, precision)));
  return made;
}

}  // namespace reckon::bench
