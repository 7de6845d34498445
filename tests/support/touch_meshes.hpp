// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Meshes made by formula, a hand that strokes them, and an inside test that shares no code with the
// library, for the tests and the benchmark of contact.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <vector>

#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::test {

using Eigen::Vector3d;

struct MeshData {
  std::vector<Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
};

/// A cone of slivers that all meet at its tip and at the centre of its base: a ball there is near
/// each of them.
inline MeshData sliver_cone(std::uint32_t sides) {
  MeshData cone{{Vector3d::Zero(), {0, 0, -0.02}}, {}};
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    cone.vertices.emplace_back(0.05 * std::cos(angle), 0.05 * std::sin(angle), -0.02);
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % sides;
    cone.triangles.push_back({0, a, b});
    cone.triangles.push_back({1, b, a});
  }
  return cone;
}

/// Writes it as an OBJ file that a scene can name.
inline void write_obj(const MeshData& mesh, const std::filesystem::path& file) {
  std::ofstream out(file);
  out.precision(17);
  for (const Vector3d& v : mesh.vertices) {
    out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  }
  for (const auto& t : mesh.triangles) {
    out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
}

/// Scaled to a bounding-box diagonal [m], about the centre of the box.
inline haptics::SurfaceMesh make_mesh(MeshData data, double size) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : data.vertices) box.extend(v);
  for (Vector3d& v : data.vertices) v = (v - box.center()) * (size / box.sizes().norm());
  return haptics::SurfaceMesh(std::move(data.vertices), std::move(data.triangles));
}

/// 2 nu nv triangles, radii 1 and 0.4.
inline MeshData torus(std::uint32_t nu, std::uint32_t nv) {
  MeshData mesh;
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      const double u = 2.0 * std::numbers::pi * i / nu;
      const double v = 2.0 * std::numbers::pi * j / nv;
      const double ring = 1.0 + 0.4 * std::cos(v);
      mesh.vertices.emplace_back(ring * std::cos(u), ring * std::sin(u), 0.4 * std::sin(v));
      const std::uint32_t next_i = (i + 1) % nu;
      const std::uint32_t next_j = (j + 1) % nv;
      mesh.quad(i * nv + j, next_i * nv + j, next_i * nv + next_j, i * nv + next_j);
    }
  }
  return mesh;
}

/// A polygon in the x-z plane (counter-clockwise with x to the right, z up) extruded along y from 0
/// to 1, its ends closed by fans about the polygon's first corner: it must be star-shaped about
/// that corner.
inline MeshData prism(const std::vector<Eigen::Vector2d>& outline, std::uint32_t slices = 1) {
  MeshData mesh;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (std::uint32_t slice = 0; slice <= slices; ++slice) {
    for (const Eigen::Vector2d& p : outline) {
      mesh.vertices.emplace_back(p.x(), static_cast<double>(slice) / slices, p.y());
    }
  }
  for (std::uint32_t slice = 0; slice < slices; ++slice) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t next = (i + 1) % n;
      mesh.quad(slice * n + i, (slice + 1) * n + i, (slice + 1) * n + next, slice * n + next);
    }
  }
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i, i + 1});
    mesh.triangles.push_back({slices * n, slices * n + i + 1, slices * n + i});
  }
  return mesh;
}

inline MeshData cube() { return prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}); }

/// A block with a V-shaped groove along y in its top; the groove's floor is a concave crease.
inline MeshData groove(std::uint32_t slices = 8) {
  return prism({{1.0, -0.4},
                {2.0, 0.0},
                {2.0, 1.0},
                {1.4, 1.0},
                {1.0, 0.3},
                {0.6, 1.0},
                {0.0, 1.0},
                {0.0, 0.0}},
               slices);
}

/// A wall of 1 x 1 and the given thickness, tapering to a sharp edge at the top.
inline MeshData fin(double thickness, std::uint32_t slices = 8) {
  return prism({{0, 0}, {0.5 * thickness, 0.0}, {0.0, 1.0}, {-0.5 * thickness, 0.0}}, slices);
}

/// Solid angle of the whole surface seen from p over 4 pi: 1 inside, 0 outside of a closed surface
/// whose triangles face outwards (Van Oosterom and Strackee 1983). Linear in the triangles.
inline double winding_number(const haptics::SurfaceMesh& mesh, const Vector3d& p) {
  double sum = 0.0;
  for (const haptics::Triangle& t : mesh.triangles()) {
    const Vector3d a = t.a - p;
    const Vector3d b = t.b - p;
    const Vector3d c = t.c - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2.0 * std::numbers::pi);
}

/// A hand that strokes a surface: it walks on it at constant speed with a slowly turning heading;
/// the device is some depth below.
class Stroke {
 public:
  /// @param step [m] walked per tick  @param depth [m] of the device below the surface
  Stroke(const haptics::SurfaceMesh& mesh, double step, double depth, std::uint32_t seed)
      : mesh_(mesh), step_(step), depth_(depth), random_(seed) {
    std::uniform_int_distribution<std::size_t> pick(0, mesh.triangles().size() - 1);
    const haptics::Triangle& t = mesh.triangles()[pick(random_)];
    foot_ = (t.a + t.b + t.c) / 3.0;
    normal_ = t.normal;
    std::normal_distribution<double> gauss;
    heading_ = {gauss(random_), gauss(random_), gauss(random_)};
  }

  /// The start of the stroke, outside.
  [[nodiscard]] Vector3d start() const { return foot_ + depth_ * normal_; }

  [[nodiscard]] Vector3d next() {
    std::normal_distribution<double> gauss;
    heading_ += 0.1 * Vector3d(gauss(random_), gauss(random_), gauss(random_));
    heading_ -= heading_.dot(normal_) * normal_;
    heading_.normalize();
    haptics::ClosestPoint nearest;
    if (mesh_.closest(foot_ + step_ * heading_, mesh_.size(), nearest)) {
      foot_ = nearest.point;
      normal_ = mesh_.triangles()[nearest.triangle].normal;
    }
    return foot_ - depth_ * normal_;
  }

 private:
  const haptics::SurfaceMesh& mesh_;
  double step_;
  double depth_;
  std::mt19937 random_;
  Vector3d foot_;
  Vector3d normal_;
  Vector3d heading_;
};

}  // namespace reckon::test
