// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_geoms.hpp"

#include <memory>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr const char* kYet =
    "has a mass, but only boxes, spheres and closed meshes move by theirs: give one of them";
constexpr std::size_t kMostTriangles = 20'000;

dGeomID placed(const PlannedObject& object, dGeomID geom) {
  if (object.moves()) return geom;
  const Quaterniond q(object.orientation);
  const dQuaternion turned{q.w(), q.x(), q.y(), q.z()};
  dGeomSetPosition(geom, object.position.x(), object.position.y(), object.position.z());
  dGeomSetQuaternion(geom, turned);
  return geom;
}

void check_body(const PlannedObject& object, const SurfaceMesh& mesh) {
  if (!mesh.report().closed)
    refuse_body(object, "has a mass, but its mesh is open and encloses nothing: close it");
  if (mesh.triangles().size() > kMostTriangles) {
    refuse_body(object, "has a mass and " + std::to_string(mesh.triangles().size()) +
                            " triangles, a body has at most " + std::to_string(kMostTriangles) +
                            ": thin it");
  }
  if (!mesh.origin().isZero(0.0))
    refuse_body(object, "has a mass, and a mesh far from its file's origin: add centre = true");
}

}  // namespace

void refuse_body(const PlannedObject& object, const std::string& why) {
  throw std::invalid_argument("object '" + object.name + "' " + why);
}

BodyGeoms::BodyGeoms(bool meshes_meet)
    : space_(dSimpleSpaceCreate(nullptr)), meshes_meet_(meshes_meet) {}

BodyGeoms::~BodyGeoms() {
  dSpaceDestroy(space_);
  for (const dTriMeshDataID mesh : meshes_) dGeomTriMeshDataDestroy(mesh);
}

dGeomID BodyGeoms::add(const PlannedObject& object) {
  const dGeomID geom = make(object);
  if (geom == nullptr) return nullptr;
  GeomMatter& matter = matters_.emplace_back(GeomMatter{object.matter});
  const auto* mesh = std::get_if<std::shared_ptr<const SurfaceMesh>>(&object.shape);
  if (mesh != nullptr && meshes_meet_) {
    auto& probed = probed_[mesh->get()];
    if (!probed) probed = std::make_unique<const ProbedMesh>(*mesh);
    matter.mesh = probed.get();
  }
  dGeomSetData(geom, &matter);
  return geom;
}

std::span<dContactGeom> BodyGeoms::meet(dGeomID a, dGeomID b,
                                        std::span<dContactGeom> room) noexcept {
  const ProbedMesh *one = matter_of(a).mesh, *other = matter_of(b).mesh;
  if (one != nullptr && other != nullptr) {
    room = room.first(haptics::meet(*one, a, *other, b, room));
  } else {
    const int most = one != nullptr || other != nullptr ? static_cast<int>(room.size()) : 4;
    const int count = dCollide(a, b, most, room.data(), sizeof(dContactGeom));
    room = room.first(static_cast<std::size_t>(count));
  }
  return room.first(keep_widest(room));
}

dGeomID BodyGeoms::make(const PlannedObject& object) {
  return std::visit(
      [&](const auto& shape) -> dGeomID {
        using S = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<S, HalfSpace>) {
          if (object.moves()) refuse_body(object, "is a plane, which cannot move: give a box");
          const Vector3d normal = object.orientation * shape.normal();
          return dCreatePlane(space_, normal.x(), normal.y(), normal.z(),
                              normal.dot(object.position));
        } else if constexpr (std::is_same_v<S, Ball>) {
          return placed(object, dCreateSphere(space_, 0.5 * shape.bounds().sizes().x()));
        } else if constexpr (std::is_same_v<S, Block>) {
          const Vector3d size = shape.bounds().sizes();
          return placed(object, dCreateBox(space_, size.x(), size.y(), size.z()));
        } else if constexpr (std::is_same_v<S, std::shared_ptr<const SurfaceMesh>>) {
          if (object.is_body()) check_body(object, *shape);
          return placed(object, make_mesh(shape));
        } else {
          if (object.is_body()) refuse_body(object, kYet);
          return nullptr;
        }
      },
      object.shape);
}

dGeomID BodyGeoms::make_mesh(const std::shared_ptr<const SurfaceMesh>& shape) {
  const SurfaceMesh& mesh = *shape;
  std::vector<double>& corners = corners_.emplace_back();
  std::vector<dTriIndex>& indices = indices_.emplace_back();
  for (const Triangle& triangle : mesh.triangles()) {
    for (const Vector3d* corner : {&triangle.a, &triangle.b, &triangle.c}) {
      indices.push_back(static_cast<dTriIndex>(indices.size()));
      corners.insert(corners.end(), {corner->x(), corner->y(), corner->z()});
    }
  }
  const dTriMeshDataID data = dGeomTriMeshDataCreate();
  meshes_.push_back(data);
  dGeomTriMeshDataBuildDouble(data, corners.data(), 3 * sizeof(double),
                              static_cast<int>(corners.size() / 3), indices.data(),
                              static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
  return dCreateTriMesh(space_, data, nullptr, nullptr, nullptr);
}

}  // namespace reckon::haptics
