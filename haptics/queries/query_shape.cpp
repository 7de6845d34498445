// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/query_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace reckon::haptics {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

bool is_extent(double value) { return value >= 0.0 && std::isfinite(value); }

QueryShape::Form form_of(const ContactShape& shape) {
  return std::visit(
      [](const auto& form) -> QueryShape::Form {
        using S = std::decay_t<decltype(form)>;
        if constexpr (std::is_same_v<S, HalfSpace>) {
          return BelowPlane{form.normal()};
        } else if constexpr (std::is_same_v<S, Ball>) {
          return RoundedBox{Vector3d::Zero(), form.bounds().max().x()};
        } else if constexpr (std::is_same_v<S, Block>) {
          return RoundedBox{form.bounds().max(), 0.0};
        } else {
          return form;
        }
      },
      shape);
}

struct BoundsOf {
  AlignedBox3d operator()(const BelowPlane& /*plane*/) const {
    const Vector3d all = Vector3d::Constant(std::numeric_limits<double>::infinity());
    return {-all, all};
  }
  AlignedBox3d operator()(const RoundedBox& box) const {
    const Vector3d most = box.half + Vector3d::Constant(box.radius);
    return {-most, most};
  }
  template <class S>
  AlignedBox3d operator()(const std::shared_ptr<S>& shape) const {
    return shape->bounds();
  }
};

struct TurningReachOf {
  double operator()(const BelowPlane& /*plane*/) const {
    return std::numeric_limits<double>::infinity();
  }
  double operator()(const RoundedBox& box) const { return box.half.norm(); }
  double operator()(const std::shared_ptr<const ImplicitSolid>& solid) const {
    const AlignedBox3d& box = solid->bounds();
    if (!box.sizes().allFinite()) return std::numeric_limits<double>::infinity();
    return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm();
  }
  double operator()(const std::shared_ptr<const SurfaceMesh>& mesh) const {
    double most = 0.0;
    for (const Triangle& t : mesh->triangles())
      most = std::max({most, t.a.squaredNorm(), t.b.squaredNorm(), t.c.squaredNorm()});
    return std::sqrt(most);
  }
};

}  // namespace

QueryShape::QueryShape(Form form) : form_(std::move(form)) {
  bounds_ = std::visit(BoundsOf{}, form_);
  turning_reach_ = std::visit(TurningReachOf{}, form_);
  bounded_ = bounds_.sizes().allFinite();
}

QueryShape::QueryShape(const ContactShape& shape) : QueryShape(form_of(shape)) {}

QueryShape QueryShape::box(const Vector3d& size) {
  if (!is_extent(size.x()) || !is_extent(size.y()) || !is_extent(size.z()))
    throw std::invalid_argument("box: each of the three sizes must be finite and at least 0 m");
  return QueryShape(RoundedBox{0.5 * size, 0.0});
}

QueryShape QueryShape::sphere(double radius) { return capsule(radius, 0.0); }

QueryShape QueryShape::capsule(double radius, double length) {
  if (!is_extent(radius) || !is_extent(length))
    throw std::invalid_argument("radius and length must be finite and at least 0 m");
  return QueryShape(RoundedBox{{0.0, 0.0, 0.5 * length}, radius});
}

QueryShape QueryShape::below_plane(const Vector3d& normal) {
  return QueryShape(ContactShape(HalfSpace(PlaneShape{normal})));
}

AlignedBox3d QueryShape::bounds_at(const Placement& at) const noexcept {
  if (!bounded_) return bounds_;
  Vector3d half = 0.5 * bounds_.sizes();
  double radius = 0.0;
  if (const auto* box = std::get_if<RoundedBox>(&form_)) {
    half = box->half;
    radius = box->radius;
  }
  const Vector3d centre = at.to_scene(bounds_.center());
  const Vector3d reach = at.orientation.cwiseAbs() * half + Vector3d::Constant(radius);
  return {centre - reach, centre + reach};
}

}  // namespace reckon::haptics
