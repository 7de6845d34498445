// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/solid_mesh.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace reckon::haptics {
namespace {

using Eigen::Array3i;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kHalvings = 40;   // bisections of an edge to its crossing
constexpr int kSteps = 3;       // Newton steps onto the surface
constexpr double kFlat = 0.02;  // of the greatest spread of normals; a smaller spread is no edge
// Further grids to try if two sheets of the surface share a cell.
constexpr std::array<int, 4> kMoreCells = {0, 3, 7, 12};

class Contour {
 public:
  Contour(const ImplicitSolid& solid, int cells) : solid_(solid) {
    const Eigen::AlignedBox3d& box = solid.bounds();
    edge_ = box.sizes().maxCoeff() / cells;
    // Keeps grid points off planes of the shape at its bounds.
    const Vector3d room = Vector3d::Constant(1.37 * edge_);
    low_ = box.min() - room;
    counts_ = ((box.sizes() + 2.0 * room) / edge_).array().ceil().cast<int>();
    values_.reserve(static_cast<std::size_t>((counts_ + 1).prod()));
    for (int z = 0; z <= counts_.z(); ++z)
      for (int y = 0; y <= counts_.y(); ++y)
        for (int x = 0; x <= counts_.x(); ++x)
          values_.push_back(solid.sample(place({x, y, z})).value);
    corner_of_.assign(values_.size(), kNone);
  }

  SurfaceMesh mesh() {
    for (int axis = 0; axis < 3; ++axis) each_place([&](const Array3i& at) { cross(at, axis); });
    if (triangles_.empty()) throw std::invalid_argument("is too thin");
    return {std::move(corners_), std::move(triangles_)};
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  void each_place(auto&& visit) const {
    for (int z = 1; z < counts_.z(); ++z)
      for (int y = 1; y < counts_.y(); ++y)
        for (int x = 1; x < counts_.x(); ++x) visit(Array3i(x, y, z));
  }
  [[nodiscard]] Vector3d place(const Array3i& at) const {
    return low_ + edge_ * at.cast<double>().matrix();
  }
  [[nodiscard]] std::size_t index(const Array3i& at) const {
    return static_cast<std::size_t>(at.x() +
                                    (counts_.x() + 1) * (at.y() + (counts_.y() + 1) * at.z()));
  }
  [[nodiscard]] bool is_inside(const Array3i& at) const { return values_[index(at)] < 0.0; }
  [[nodiscard]] static Array3i along(int axis) { return Eigen::Vector3i::Unit(axis).array(); }

  // Handles the edge from a grid point along an axis: if it crosses the surface, adds a square of
  // the corners in the four cells around it.
  void cross(const Array3i& at, int axis) {
    const bool from = is_inside(at);
    if (from == is_inside(at + along(axis))) return;
    const Array3i u = along((axis + 1) % 3), v = along((axis + 2) % 3);
    const std::array<std::uint32_t, 4> ring = {corner(at), corner(at - u), corner(at - u - v),
                                               corner(at - v)};
    // Counterclockwise from outside.
    const auto add = [&](int a, int b, int c) {
      if (!from) std::swap(b, c);
      triangles_.push_back({ring[static_cast<std::size_t>(a)], ring[static_cast<std::size_t>(b)],
                            ring[static_cast<std::size_t>(c)]});
    };
    add(0, 1, 2);
    add(0, 2, 3);
  }

  std::uint32_t corner(const Array3i& cell) {
    std::uint32_t& number = corner_of_[index(cell)];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(corners_.size());
      corners_.push_back(corner_place(cell));
    }
    return number;
  }

  // The surface point nearest to the intersection of the planes of a cell's crossings; along an
  // edge or a face, nearest to the middle of the crossings.
  [[nodiscard]] Vector3d corner_place(const Array3i& cell) const {
    std::array<Vector3d, 12> points, normals;
    std::size_t count = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 4; ++i) {
        const Array3i from =
            cell + (i & 1) * along((axis + 1) % 3) + (i >> 1) * along((axis + 2) % 3);
        if (is_inside(from) == is_inside(from + along(axis))) continue;
        points[count] = crossing(place(from), place(from + along(axis)));
        normals[count] = solid_.sample(points[count]).gradient.stableNormalized();
        ++count;
      }
    }
    Vector3d middle = Vector3d::Zero();
    for (std::size_t i = 0; i < count; ++i) middle += points[i] / static_cast<double>(count);
    Matrix3d spread = Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      spread += normals[i] * normals[i].transpose();
      right += normals[i] * normals[i].dot(points[i] - middle);
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(spread);
    Vector3d way = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const double value = solver.eigenvalues()[k];
      const Vector3d axis = solver.eigenvectors().col(k);
      if (value > kFlat * solver.eigenvalues()[2]) way += axis.dot(right) / value * axis;
    }
    const Vector3d low = place(cell), high = low + Vector3d::Constant(edge_);
    Vector3d at = (middle + way).cwiseMax(low).cwiseMin(high);
    for (int i = 0; i < kSteps; ++i) {
      const SignedSample here = solid_.sample(at);
      const double steep = here.gradient.squaredNorm();
      if (steep > 0.0) at -= here.value / steep * here.gradient;
    }
    // On a curved surface it may be in the next cell.
    const Vector3d room = Vector3d::Constant(0.5 * edge_);
    return at.cwiseMax(low - room).cwiseMin(high + room);
  }

  [[nodiscard]] Vector3d crossing(Vector3d a, Vector3d b) const {
    const bool from = solid_.sample(a).value < 0.0;
    for (int i = 0; i < kHalvings; ++i) {
      const Vector3d middle = 0.5 * (a + b);
      (solid_.sample(middle).value < 0.0 ? from : !from) ? a = middle : b = middle;
    }
    return 0.5 * (a + b);
  }

  const ImplicitSolid& solid_;
  double edge_ = 0.0;  // [m]
  Vector3d low_ = Vector3d::Zero();
  Array3i counts_ = Array3i::Zero();  // cells
  std::vector<double> values_;        // at the grid points
  std::vector<std::uint32_t> corner_of_;
  std::vector<Vector3d> corners_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

SurfaceMesh mesh_of(const ImplicitSolid& solid, int cells) {
  if (!solid.bounds().sizes().allFinite()) throw std::invalid_argument("is infinite");
  for (const int more : kMoreCells) {
    SurfaceMesh mesh = Contour(solid, std::clamp(cells, 4, 256) + more).mesh();
    if (mesh.report().closed) return mesh;
  }
  throw std::invalid_argument("is too thin for " + std::to_string(cells) + " cells");
}

}  // namespace reckon::haptics
