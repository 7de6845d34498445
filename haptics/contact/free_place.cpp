// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/free_place.hpp"

#include "reckon/haptics/geometry/surface_contact_point.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

// Number of overlapping objects that the search leaves one by one before it moves straight out, and
// the lengths [m] that it tries.
constexpr int kPushes = 32;
constexpr double kSearchFrom = 1e-4;
constexpr double kSearchTo = 1e5;

}  // namespace

std::uint32_t FreePlace::overlapped(const Vector3d& p) const noexcept {
  std::uint32_t found = kNobody;
  const Vector3d room = Vector3d::Constant(radius_);
  const SurfaceContactPoint probe(radius_);
  const auto see = [&](std::uint32_t index) {
    if (found != kNobody) return;
    const PlannedObject& object = *objects_[index];
    if (probe.overlaps(object.shape, object.to_object(p))) found = index;
  };
  plan_.visit_near({p - room, p + room}, see);
  for (std::uint32_t i = 0; i < objects_.size(); ++i)
    if (objects_[i]->moves()) see(i);
  return found;
}

bool FreePlace::push_out(Vector3d& p) const noexcept {
  for (int round = 0; round < kPushes; ++round) {
    const std::uint32_t index = overlapped(p);
    if (index == kNobody) return true;
    const PlannedObject& object = *objects_[index];
    SurfaceContactPoint point(radius_);
    point.reset(object.shape, object.to_object(p));
    p = object.to_scene(point.scp());
  }
  return overlapped(p) == kNobody;
}

Vector3d FreePlace::search(const Vector3d& device) const noexcept {
  for (double reach = kSearchFrom; reach < kSearchTo; reach *= 2.0) {
    for (int way = 0; way < 27; ++way) {
      const Vector3d p =
          device + reach * Vector3d(way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1).stableNormalized();
      if (overlapped(p) == kNobody) return p;
    }
  }
  return device;
}

}  // namespace reckon::haptics
