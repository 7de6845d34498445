// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene_graph/graph_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace reckon::peer {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

/// A box around the bounds, slightly larger, so that rounding excludes nothing that touches it.
AlignedBox3d box_around(const ContentBounds& bounds, const NodePose& pose) {
  Vector3d centre, half;
  if (const auto* const ball = std::get_if<SphereBounds>(&bounds)) {
    centre = pose * ball->centre;
    half = Vector3d::Constant(pose.scale * ball->radius);
  } else {
    const auto& box = std::get<BoxBounds>(bounds);
    centre = pose * box.centre;
    half = pose.orientation.toRotationMatrix().cwiseAbs() * (pose.scale * box.half);
  }
  half.array() += 1e-12 * (centre.cwiseAbs() + half).sum();
  return {centre - half, centre + half};
}

/// Least coordinate of the bounds along `normal`.
double least_along(const ContentBounds& bounds, const NodePose& pose, const Vector3d& normal) {
  if (const auto* const ball = std::get_if<SphereBounds>(&bounds))
    return normal.dot(pose * ball->centre) - pose.scale * ball->radius;
  const auto& box = std::get<BoxBounds>(bounds);
  const Vector3d across = pose.orientation.conjugate() * normal;
  return normal.dot(pose * box.centre) - pose.scale * across.cwiseAbs().dot(box.half);
}

double least_along(const AlignedBox3d& box, const Vector3d& normal) {
  return normal.dot(box.center()) - normal.cwiseAbs().dot(0.5 * box.sizes());
}

/// Distance at which a ray enters a box around the origin; none: it misses.
std::optional<double> entry(const Vector3d& half, const Vector3d& origin, const Vector3d& along) {
  double from = 0.0, to = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0.0) {
      if (std::abs(origin[axis]) > half[axis]) return std::nullopt;
      continue;
    }
    const double one = (-half[axis] - origin[axis]) / along[axis];
    const double other = (half[axis] - origin[axis]) / along[axis];
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  return from <= to ? std::optional(from) : std::nullopt;
}

/// Distance at which a ray enters a sphere around the origin; `along` has length 1.
std::optional<double> entry(double radius, const Vector3d& origin, const Vector3d& along) {
  const double nearest = -origin.dot(along);
  const double aside = (origin + nearest * along).squaredNorm();
  if (origin.squaredNorm() <= radius * radius) return 0.0;
  if (nearest < 0.0 || aside > radius * radius) return std::nullopt;
  return nearest - std::sqrt(radius * radius - aside);
}

std::optional<double> entry(const ContentBounds& bounds, const NodePose& pose,
                            const Vector3d& origin, const Vector3d& along) {
  if (const auto* const ball = std::get_if<SphereBounds>(&bounds))
    return entry(pose.scale * ball->radius, origin - pose * ball->centre, along);
  const auto& box = std::get<BoxBounds>(bounds);
  const Eigen::Quaterniond back = pose.orientation.conjugate();
  return entry(pose.scale * box.half, back * (origin - pose * box.centre), back * along);
}

std::optional<double> entry(const AlignedBox3d& box, const Vector3d& origin,
                            const Vector3d& along) {
  return entry(0.5 * box.sizes(), origin - box.center(), along);
}

}  // namespace

std::vector<HalfSpace> view_volume(const NodePose& eye, double width, double height, double nearest,
                                   double farthest) {
  const auto side = [&](const Vector3d& out, double offset) {
    const Vector3d normal = eye.orientation * out;
    return HalfSpace{normal, normal.dot(eye.position) + offset};
  };
  const double w = 0.5 * width, h = 0.5 * height;
  return {
      side(-Vector3d::UnitX(), -nearest),          side(Vector3d::UnitX(), farthest),
      side({-std::sin(w), std::cos(w), 0.0}, 0.0), side({-std::sin(w), -std::cos(w), 0.0}, 0.0),
      side({-std::sin(h), 0.0, std::cos(h)}, 0.0), side({-std::sin(h), 0.0, -std::cos(h)}, 0.0)};
}

std::vector<HalfSpace> box_volume(const AlignedBox3d& box) {
  std::vector<HalfSpace> volume;
  for (int axis = 0; axis < 3; ++axis) {
    volume.push_back({Vector3d::Unit(axis), box.max()[axis]});
    volume.push_back({-Vector3d::Unit(axis), -box.min()[axis]});
  }
  return volume;
}

GraphBounds::GraphBounds(const SceneGraph& graph, std::vector<Entry> entries)
    : graph_(&graph),
      entries_(std::move(entries)),
      entry_of_(static_cast<std::size_t>(graph.size()), -1),
      boxes_(static_cast<std::size_t>(graph.size())) {
  for (std::size_t i = 0; i < entries_.size(); ++i)
    entry_of_[static_cast<std::size_t>(entries_[i].node)] = static_cast<std::int32_t>(i);
  update();
}

const ContentBounds* GraphBounds::bounds_of(NodeIndex node) const noexcept {
  const std::int32_t entry = entry_of_[static_cast<std::size_t>(node)];
  return entry < 0 ? nullptr : &entries_[static_cast<std::size_t>(entry)].bounds;
}

void GraphBounds::update() noexcept {
  for (AlignedBox3d& box : boxes_) box.setEmpty();
  for (NodeIndex node = graph_->size() - 1; node >= 0; --node) {
    AlignedBox3d& box = boxes_[static_cast<std::size_t>(node)];
    const ContentBounds* const bounds = bounds_of(node);
    if (bounds != nullptr && graph_->shown(node))
      box.extend(box_around(*bounds, graph_->world(node)));
    const NodeIndex parent = graph_->parent(node);
    if (parent != kNoNode && !box.isEmpty()) boxes_[static_cast<std::size_t>(parent)].extend(box);
  }
}

void GraphBounds::cull(std::span<const HalfSpace> volume, std::vector<NodeIndex>& found) const {
  const auto excludes = [&](const auto&... body) {
    return std::ranges::any_of(volume, [&](const HalfSpace& half) {
      return least_along(body..., half.normal) > half.offset;
    });
  };
  for (NodeIndex node = 0; node < graph_->size();) {
    const AlignedBox3d& box = boxes_[static_cast<std::size_t>(node)];
    if (box.isEmpty() || excludes(box)) {
      node = graph_->end(node);
      continue;
    }
    const ContentBounds* const bounds = bounds_of(node);
    if (bounds != nullptr && !excludes(*bounds, graph_->world(node))) found.push_back(node);
    ++node;
  }
}

std::optional<Picked> GraphBounds::pick(const Vector3d& origin,
                                        const Vector3d& direction) const noexcept {
  const Vector3d along = direction.normalized();
  std::optional<Picked> best;
  for (NodeIndex node = 0; node < graph_->size();) {
    const AlignedBox3d& box = boxes_[static_cast<std::size_t>(node)];
    const auto reached = box.isEmpty() ? std::nullopt : entry(box, origin, along);
    if (!reached || (best && *reached > best->distance)) {
      node = graph_->end(node);
      continue;
    }
    const ContentBounds* const bounds = bounds_of(node);
    const auto hit =
        bounds != nullptr ? entry(*bounds, graph_->world(node), origin, along) : std::nullopt;
    if (hit && (!best || *hit < best->distance)) best = Picked{node, *hit};
    ++node;
  }
  return best;
}

}  // namespace reckon::peer
