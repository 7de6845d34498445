// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_extent.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <vector>

#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_sections.hpp"
#include "reckon/peer/tracks/entity_track.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;

constexpr int kLooks = 256;  // samples per track
// Limit of entities and devices that are compared in pairs.
constexpr std::size_t kMostCompared = 20'000;

/// An entity or device at the start.
struct Placed {
  std::uint32_t peer;
  Vector3d at;  ///< [m], S
  bool is_entity;
};

std::vector<Placed> placed_at_start(const SceneFile& scene) {
  std::vector<Placed> out;
  std::vector<EntityTrack> tracks = tracks_of(scene.entities);
  for (std::size_t i = 0; i < tracks.size(); ++i)
    out.push_back({scene.entities[i].peer, tracks[i].at(0).position, true});
  for (const DeviceConfig& device : scene.devices)
    out.push_back({device.peer, device.position, false});
  return out;
}

}  // namespace

double extent_of(const SceneFile& scene) {
  if (scene.entities.empty()) return 0;
  Eigen::AlignedBox3d box;
  std::vector<EntityTrack> tracks = tracks_of(scene.entities);
  for (std::size_t n = 0; n < tracks.size(); ++n) {
    EntityTrack& track = tracks[n];
    const TrackCurve* const curve = track.curve();
    const double step = curve ? curve->duration() / scene.entities[n].speed / kLooks : 0;
    for (int i = 0; i <= (step > 0 ? kLooks : 0); ++i) box.extend(track.at(i * step).position);
  }
  for (const DeviceConfig& device : scene.devices) box.extend(device.position);
  return box.diagonal().norm();
}

void set_reach_by_extent(SceneFile& scene, const StatedReach& stated) {
  if (stated.cell && stated.radius) return;
  AoimConfig& aoim = scene.aoim;
  double extent = 0;
  try {
    extent = extent_of(scene);
  } catch (const std::exception&) {
    return;  // reported at its key
  }
  if (!(extent > AoimConfig{}.radius)) return;
  const double radius = std::min(std::pow(10.0, std::ceil(std::log10(extent))), kWorld);
  if (!stated.cell) aoim.cell = radius / 2;
  if (!stated.radius) aoim.radius = radius;
}

std::string unsensed_note(const SceneFile& scene) {
  const std::vector<Placed> all = placed_at_start(scene);
  if (all.size() > kMostCompared) return {};
  std::size_t unsensed = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Placed& entity : all) {
    if (!entity.is_entity) continue;
    double distance = std::numeric_limits<double>::infinity();
    for (const Placed& other : all) {
      if (other.peer != entity.peer) distance = std::min(distance, (other.at - entity.at).norm());
      if (distance <= scene.aoim.radius) break;
    }
    if (!std::isfinite(distance) || distance <= scene.aoim.radius) continue;
    ++unsensed;
    nearest = std::min(nearest, distance);
  }
  if (unsensed == 0) return {};
  return fmt::format(
      "{} of {} entities {} farther than [aoim] radius = {:.4g} m from all entities of other peers "
      "at the start, the nearest {:.4g} m: no other peer shows {} at that distance; raise the "
      "radius",
      unsensed, scene.entities.size(), unsensed == 1 ? "is" : "are", scene.aoim.radius, nearest,
      unsensed == 1 ? "it" : "them");
}

}  // namespace reckon::peer
