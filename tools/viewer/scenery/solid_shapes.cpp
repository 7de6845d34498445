// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/scenery/solid_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <numbers>
#include <span>

#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/haptics/scene/surface_patches.hpp"
#include "reckon/tools/viewer/protocol/picture.hpp"

namespace reckon::tools {
namespace {

using haptics::ObjectPose;

constexpr std::uint32_t kAround = 48;  // corners of a circle

/// A point of a profile: its distance from the axis z, and its height [m].
struct ProfilePoint {
  double radius, height;
};

/// The shortest rotation of the axis z to a direction; half a turn about x to the opposite one.
Eigen::Quaterniond turn_to(const Eigen::Vector3d& direction) {
  const double level = std::hypot(direction.x(), direction.y());
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  if (level > 0) axis = {-direction.y() / level, direction.x() / level, 0};
  return Eigen::Quaterniond(Eigen::AngleAxisd(std::atan2(level, direction.z()), axis));
}

void revolve(std::span<const ProfilePoint> profile, DrawnSolid& out) {
  out.shape = "mesh";
  for (const ProfilePoint& point : profile) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAround;
      out.vertices.emplace_back(point.radius * std::cos(angle), point.radius * std::sin(angle),
                                point.height);
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = ring * kAround + k, b = ring * kAround + (k + 1) % kAround;
      out.triangles.push_back({a, b, b + kAround});
      out.triangles.push_back({a, b + kAround, a + kAround});
    }
  }
}

/// A circle, or half of one from the lower pole to the upper, as a profile.
std::vector<ProfilePoint> arc(double middle, double radius, double from, double to) {
  std::vector<ProfilePoint> profile;
  constexpr int kSteps = 24;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = from + (to - from) * i / kSteps;
    profile.push_back({middle + radius * std::cos(angle), radius * std::sin(angle)});
  }
  return profile;
}

void draw_frustum(double base, double top, double height, DrawnSolid& out) {
  const double half = height / 2;
  revolve(std::array<ProfilePoint, 4>{{{0, -half}, {base, -half}, {top, half}, {0, half}}}, out);
}

void draw_box(const Eigen::Vector3d& size, DrawnSolid& out) {
  out.shape = "box";
  out.size = size;
}

/// Vertices that triangles share are stored once.
void draw_mesh(const haptics::SurfaceMesh& mesh, DrawnSolid& out) {
  struct Less {
    bool operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }
  };
  std::map<Eigen::Vector3d, std::uint32_t, Less> known;
  const auto index_of = [&](const Eigen::Vector3d& corner) {
    const auto [place, is_new] =
        known.try_emplace(corner, static_cast<std::uint32_t>(out.vertices.size()));
    if (is_new) out.vertices.emplace_back(corner + mesh.origin());
    return place->second;
  };
  out.shape = "mesh";
  for (const haptics::Triangle& triangle : mesh.triangles())
    out.triangles.push_back({index_of(triangle.a), index_of(triangle.b), index_of(triangle.c)});
}

void draw_patches(const haptics::SceneObject& object, const haptics::SurfaceMesh& mesh,
                  DrawnSolid& out) {
  const auto planned = haptics::plan_patches(object, mesh);
  if (!planned) return;
  out.patches = planned->of_triangle;
  for (std::size_t i = 1; i < planned->patches.size(); ++i)
    out.patch_names.push_back(planned->patches[i].name);
}

/// Draws the shape of one solid.
struct Drawing {
  DrawnSolid& out;
  std::size_t most;                              // limit of triangles
  const haptics::SceneObject* object = nullptr;  // set for a mesh, whose patches are drawn

  void operator()(const haptics::PlaneShape& plane) const {
    out.shape = "plane";
    out.pose.orientation *= turn_to(plane.normal);
  }
  void operator()(const haptics::SphereShape& sphere) const {
    out.shape = "sphere";
    out.radius = sphere.radius;
  }
  void operator()(const haptics::BoxShape& box) const { draw_box(box.size, out); }
  void operator()(const haptics::CylinderShape& solid) const {
    draw_frustum(solid.radius, solid.radius, solid.height, out);
  }
  void operator()(const haptics::ConeShape& solid) const {
    draw_frustum(solid.radius, solid.top_radius, solid.height, out);
  }
  void operator()(const haptics::TorusShape& solid) const {
    revolve(arc(solid.radius, solid.tube, 0, 2 * std::numbers::pi), out);
  }
  void operator()(const haptics::EllipsoidShape& solid) const {
    revolve(arc(0, 1, -std::numbers::pi / 2, std::numbers::pi / 2), out);
    for (Eigen::Vector3d& vertex : out.vertices) vertex = vertex.cwiseProduct(solid.semi_axes);
  }
  void operator()(const haptics::MeshShape& shape) const {
    draw_loaded([&] { return haptics::SurfaceMesh::load(shape); },
                Eigen::Vector3d::Constant(shape.scale_to));
  }
  void operator()(const haptics::HeightsShape& shape) const {
    // Two triangles per pixel, and three more per border pixel: at most five per pixel.
    draw_loaded([&] { return haptics::SurfaceMesh::load_heights(shape, most / 5); },
                {shape.width, shape.length, shape.height});
  }
  void operator()(const haptics::CsgShape&) const {}

 private:
  /// Draws its triangles; a box if there are too many, or if it cannot be read.
  void draw_loaded(auto load, const Eigen::Vector3d& unread) const {
    try {
      const haptics::SurfaceMesh mesh = load();
      if (mesh.triangles().size() <= most) {
        if (object != nullptr) draw_patches(*object, mesh, out);
        return draw_mesh(mesh, out);
      }
      draw_box(mesh.bounds().sizes(), out);
      out.pose.position += out.pose.orientation * (mesh.origin() + mesh.bounds().center());
    } catch (const std::exception&) {
      // The program that runs the scene has reported the error already.
      draw_box(unread, out);
    }
  }
};

/// Square of the distance to the nearest corner of this patch [m^2].
double distance_to_patch(const DrawnSolid& solid, std::uint32_t patch,
                         const Eigen::Vector3d& point) {
  const Eigen::Vector3d local = solid.pose.orientation.conjugate() * (point - solid.pose.position);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < solid.triangles.size(); ++i) {
    if (solid.patches[i] != patch) continue;
    for (const std::uint32_t corner : solid.triangles[i])
      least = std::min(least, (solid.vertices[corner] - local).squaredNorm());
  }
  return least;
}

ObjectPose placed(const ObjectPose& object, const haptics::CsgPart& part) {
  return {object.position + object.orientation.normalized() * part.position,
          object.orientation.normalized() * part.orientation.normalized()};
}

}  // namespace

std::vector<DrawnSolid> drawn_solids(const haptics::Scene& scene, std::size_t most) {
  std::vector<DrawnSolid> solids;
  std::uint16_t bodies = 0;
  for (const haptics::SceneObject& object : scene.objects) {
    const auto add = [&](const ObjectPose& pose, const auto& shape) {
      DrawnSolid& solid = solids.emplace_back();
      solid.name = object.name;
      solid.pose = pose;
      solid.pose.orientation.normalize();
      if (object.matter.mass > 0 || object.carried) solid.body = bodies++;
      solid.stiffness = object.effects.of<haptics::SpringDamper>().stiffness;
      if (const auto* friction = object.effects.find<haptics::StickSlipFriction>())
        solid.friction = friction->static_coefficient;
      std::visit(Drawing{solid, most, &object}, shape);
    };
    const auto* parts = std::get_if<haptics::CsgShape>(&object.shape);
    if (parts == nullptr) {
      add(object.pose, object.shape);
      continue;
    }
    for (const haptics::CsgPart& part : parts->parts)
      if (part.operation == haptics::CsgOperation::add) add(placed(object.pose, part), part.shape);
  }
  std::size_t next = 1;
  for (DrawnSolid& solid : solids) {
    const std::size_t count = solid.patches.empty() ? 0 : solid.patch_names.size() + 1;
    if (count == 0 || next + count > kNoNumber) continue;
    solid.first_patch = static_cast<std::uint16_t>(next);
    next += count;
  }
  return solids;
}

std::vector<DrawnSolid> drawn_regions(const haptics::Scene& scene) {
  std::vector<DrawnSolid> regions;
  for (const haptics::SceneRegion& region : scene.regions) {
    if (!region.shape) continue;
    DrawnSolid& drawn = regions.emplace_back();
    drawn.name = region.name;
    drawn.pose = region.pose;
    drawn.pose.orientation.normalize();
    std::visit(Drawing{drawn, 0}, *region.shape);
  }
  return regions;
}

std::uint16_t touched_patch(std::span<const DrawnSolid> solids, std::uint32_t patch,
                            const Eigen::Vector3d& point) {
  if (patch == 0) return 0;
  std::vector<const DrawnSolid*> having;
  for (const DrawnSolid& solid : solids)
    if (solid.first_patch > 0 && patch <= solid.patch_names.size()) having.push_back(&solid);
  if (having.empty()) return 0;
  const DrawnSolid* nearest = having.front();
  if (having.size() > 1) {
    nearest = *std::ranges::min_element(having, {}, [&](const DrawnSolid* solid) {
      return distance_to_patch(*solid, patch, point);
    });
  }
  return static_cast<std::uint16_t>(nearest->first_patch + patch);
}

}  // namespace reckon::tools
