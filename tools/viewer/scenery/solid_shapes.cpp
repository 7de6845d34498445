// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/scenery/solid_shapes.hpp"

#include <cmath>
#include <exception>
#include <map>
#include <numbers>
#include <span>

#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::tools {
namespace {

using haptics::ObjectPose;

constexpr std::uint32_t kAround = 48;  // corners of a circle

/// A point of a profile: its distance from the axis z, and its height [m].
struct ProfilePoint {
  double radius, height;
};

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

/// Corners that triangles share are one.
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

/// Draws the shape of one solid.
struct Drawing {
  DrawnSolid& out;
  std::size_t most;

  void operator()(const haptics::PlaneShape& plane) const {
    out.shape = "plane";
    out.pose.orientation *=
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), plane.normal);
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
    try {
      const auto mesh = haptics::SurfaceMesh::load(shape);
      if (mesh.triangles().size() <= most) return draw_mesh(mesh, out);
      draw_box(mesh.bounds().sizes(), out);
      out.pose.position += out.pose.orientation * (mesh.origin() + mesh.bounds().center());
    } catch (const std::exception&) {
      // Who runs the scene has said so already.
      draw_box(Eigen::Vector3d::Constant(shape.scale_to), out);
    }
  }
  void operator()(const haptics::CsgShape&) const {}
};

ObjectPose placed(const ObjectPose& object, const haptics::CsgPart& part) {
  return {object.position + object.orientation.normalized() * part.position,
          object.orientation.normalized() * part.orientation.normalized()};
}

}  // namespace

std::vector<DrawnSolid> drawn_solids(const haptics::Scene& scene, std::size_t most) {
  std::vector<DrawnSolid> solids;
  for (const haptics::SceneObject& object : scene.objects) {
    const auto add = [&](const ObjectPose& pose, const auto& shape) {
      DrawnSolid& solid = solids.emplace_back();
      solid.name = object.name;
      solid.pose = pose;
      solid.pose.orientation.normalize();
      solid.stiffness = object.effects.of<haptics::SpringDamper>().stiffness;
      if (const auto* friction = object.effects.find<haptics::StickSlipFriction>())
        solid.friction = friction->static_coefficient;
      std::visit(Drawing{solid, most}, shape);
    };
    const auto* parts = std::get_if<haptics::CsgShape>(&object.shape);
    if (parts == nullptr) {
      add(object.pose, object.shape);
      continue;
    }
    for (const haptics::CsgPart& part : parts->parts)
      if (part.operation == haptics::CsgOperation::add) add(placed(object.pose, part), part.shape);
  }
  return solids;
}

}  // namespace reckon::tools
