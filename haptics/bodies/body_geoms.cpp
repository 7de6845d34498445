// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_geoms.hpp"

#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

#include "reckon/haptics/geometry/solid_mesh.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int kCells = 20;  // cells along a solid
constexpr std::size_t kMostTriangles = 20'000;

dGeomID placed(const PlannedObject& object, dGeomID geom) {
  if (object.moves()) return geom;
  const Quaterniond q(object.orientation);
  const dQuaternion turned{q.w(), q.x(), q.y(), q.z()};
  dGeomSetPosition(geom, object.position.x(), object.position.y(), object.position.z());
  dGeomSetQuaternion(geom, turned);
  return geom;
}

bool is_mesh(dGeomID geom) { return dGeomGetClass(geom) == dTriMeshClass; }

void check_body(const PlannedObject& object, const SurfaceMesh& mesh) {
  if (!mesh.report().closed) refuse_body(object, "has a mass, but its mesh is open: close it");
  if (mesh.triangles().size() > kMostTriangles) {
    refuse_body(object, "has a mass and " + std::to_string(mesh.triangles().size()) +
                            " triangles, but a body has at most " + std::to_string(kMostTriangles) +
                            ": simplify it");
  }
  if (!mesh.origin().isZero(0.0))
    refuse_body(object,
                "has a mass, but its mesh is far from the origin of its file: add centre = true");
}

}  // namespace

const CylinderShape* cylinder_of(const PlannedObject& object) {
  const auto* solid = std::get_if<std::shared_ptr<const ImplicitSolid>>(&object.shape);
  return solid != nullptr && (*solid)->cylinder() ? &*(*solid)->cylinder() : nullptr;
}

void refuse_body(const PlannedObject& object, const std::string& why) {
  throw std::invalid_argument("object '" + object.name + "' " + why);
}

BodyGeoms::BodyGeoms(std::span<const PlannedObject> objects) : space_(dSimpleSpaceCreate(nullptr)) {
  for (const PlannedObject& object : objects) {
    has_bodies_ |= object.is_body();
    meshes_meet_ |= object.is_body() && !std::holds_alternative<Block>(object.shape) &&
                    !std::holds_alternative<Ball>(object.shape);
  }
}

BodyGeoms::~BodyGeoms() {
  dSpaceDestroy(space_);
  for (const dTriMeshDataID mesh : meshes_) dGeomTriMeshDataDestroy(mesh);
}

dGeomID BodyGeoms::add(const PlannedObject& object) {
  const std::shared_ptr<const SurfaceMesh> mesh = mesh_for(object);
  if (mesh && object.is_body()) check_body(object, *mesh);
  const dGeomID geom = make(object, mesh.get());
  if (geom == nullptr) return nullptr;
  GeomMatter& matter = matters_.emplace_back();
  matter.matter = object.matter;
  if (has_bodies_ && (!mesh || cylinder_of(object) != nullptr)) {
    matter.swept.emplace(object.shape);
    matter.turned = object.orientation;
  }
  if (mesh && meshes_meet_) {
    auto& probed = probed_[mesh.get()];
    if (!probed) probed = std::make_unique<const ProbedMesh>(mesh);
    matter.mesh = probed.get();
  }
  dGeomSetData(geom, &matter);
  return geom;
}

// The mesh of a mesh object or of a bounded solid; null for others.
std::shared_ptr<const SurfaceMesh> BodyGeoms::mesh_for(const PlannedObject& object) {
  if (const auto* mesh = std::get_if<std::shared_ptr<const SurfaceMesh>>(&object.shape))
    return *mesh;
  const auto* solid = std::get_if<std::shared_ptr<const ImplicitSolid>>(&object.shape);
  if (solid == nullptr || !has_bodies_) return nullptr;
  if (!(*solid)->bounds().sizes().allFinite()) {
    if (object.is_body())
      refuse_body(object, "has a mass, but is infinite: intersect it with a finite part");
    return nullptr;
  }
  std::shared_ptr<const SurfaceMesh>& mesh = solids_[solid->get()];
  try {
    if (!mesh) mesh = std::make_shared<const SurfaceMesh>(mesh_of(**solid, kCells));
  } catch (const std::invalid_argument&) {
    refuse_body(object, "has walls too thin to stop bodies: make them thicker than 1/" +
                            std::to_string(kCells) + " of its length");
  }
  return mesh;
}

std::span<dContactGeom> BodyGeoms::meet(dGeomID a, dGeomID b,
                                        std::span<dContactGeom> room) noexcept {
  const ProbedMesh *one = matter_of(a).mesh, *other = matter_of(b).mesh;
  if (one != nullptr && other != nullptr) {
    room = room.first(haptics::meet(*one, a, *other, b, room));
  } else if (is_mesh(a) && one != nullptr && dGeomGetClass(b) == dPlaneClass) {
    room = room.first(meet_plane(*one, a, b, true, room));
  } else if (is_mesh(b) && other != nullptr && dGeomGetClass(a) == dPlaneClass) {
    room = room.first(meet_plane(*other, b, a, false, room));
  } else {
    const int most = one != nullptr || other != nullptr ? static_cast<int>(room.size()) : 4;
    const int count = dCollide(a, b, most, room.data(), sizeof(dContactGeom));
    room = room.first(static_cast<std::size_t>(count));
  }
  return room.first(keep_widest(room));
}

dGeomID BodyGeoms::make(const PlannedObject& object, const SurfaceMesh* mesh) {
  // As a mesh, a cylinder would roll over facets.
  if (const CylinderShape* cylinder = cylinder_of(object); mesh != nullptr && cylinder != nullptr)
    return placed(object, dCreateCylinder(space_, cylinder->radius, cylinder->height));
  if (mesh != nullptr) return placed(object, make_mesh(*mesh));
  if (const auto* plane = std::get_if<HalfSpace>(&object.shape)) {
    if (object.moves()) refuse_body(object, "is a plane, which cannot move: use a box");
    const Vector3d normal = object.orientation * plane->normal();
    return dCreatePlane(space_, normal.x(), normal.y(), normal.z(), normal.dot(object.position));
  }
  if (const auto* ball = std::get_if<Ball>(&object.shape))
    return placed(object, dCreateSphere(space_, 0.5 * ball->bounds().sizes().x()));
  if (const auto* block = std::get_if<Block>(&object.shape)) {
    const Vector3d size = block->bounds().sizes();
    return placed(object, dCreateBox(space_, size.x(), size.y(), size.z()));
  }
  return nullptr;
}

dGeomID BodyGeoms::make_mesh(const SurfaceMesh& mesh) {
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
