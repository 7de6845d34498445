// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/implicit/signed_function.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace reckon::haptics {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kFar = std::numeric_limits<double>::infinity();

// A function that is convex along the path is above its tangent.
double above_tangent(double height, double slope) {
  if (slope >= 0.0) return kFar;
  return height / -slope;
}

// Distance from inside a block to its walls moved inwards by `level`.
double to_walls(const BoxFunction& box, const Vector3d& p, const Vector3d& direction,
                double level) {
  double way = kFar;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (direction[i] == 0.0) continue;
    const double wall = std::copysign(box.half[i] - level, direction[i]);
    way = std::min(way, (wall - p[i]) / direction[i]);
  }
  return way;
}

// Distance along a path at which |p| grows to `reach`. `p` and `direction` are the components
// across an axis, or the whole vectors.
template <class Vector>
double to_reach(const Vector& p, const Vector& direction, double reach) {
  const double speed = direction.squaredNorm();
  const double room = reach * reach - p.squaredNorm();
  if (!(speed > 0.0) || !(room > 0.0)) return speed > 0.0 ? 0.0 : kFar;
  const double outward = p.dot(direction);
  const double root = std::sqrt(outward * outward + speed * room);
  return outward > 0.0 ? room / (outward + root) : (root - outward) / speed;
}

// The same from inside the other solids with a closed form; 0 if none is known.
template <class Function>
double way_out(const Function& solid, const Vector3d& p, const Vector3d& direction, double level) {
  if constexpr (std::is_same_v<Function, HalfSpaceFunction>) {
    return above_tangent(-solid.normal.dot(p) - level, -solid.normal.dot(direction));
  } else if constexpr (std::is_same_v<Function, BoxFunction>) {
    return to_walls(solid, p, direction, level);
  } else if constexpr (std::is_same_v<Function, SphereFunction>) {
    return to_reach(p, direction, solid.radius - level);
  } else if constexpr (std::is_same_v<Function, CylinderFunction>) {
    const Eigen::Vector2d across = p.head<2>();
    const Eigen::Vector2d turn = direction.head<2>();
    const double end = std::copysign(solid.half - level, direction.z());
    const double along = direction.z() == 0.0 ? kFar : (end - p.z()) / direction.z();
    return std::min(along, to_reach(across, turn, solid.radius - level));
  } else {
    return 0.0;
  }
}

// Rounded edge where a and b are close: decrease of the smaller one, and share of the greater one
// in the gradient. For the maximum, with both signs reversed.
struct Blend {
  double off = 0.0;
  double share = 0.0;
};

Blend blend(double a, double b, double radius) {
  const double near = radius - std::abs(a - b);
  if (!(near > 0.0)) return {};
  return {0.25 * near * near / radius, 0.5 * near / radius};
}

void check(double radius) {
  if (!(radius >= 0.0) || !std::isfinite(radius)) {
    throw std::invalid_argument("rounding must be finite and at least 0 m");
  }
}

AlignedBox3d placed(const AlignedBox3d& box, const Eigen::Isometry3d& place) {
  if (!box.sizes().allFinite()) return box;
  const Vector3d half = place.linear().cwiseAbs() * (0.5 * box.sizes());
  const Vector3d centre = place * box.center();
  return {centre - half, centre + half};
}

}  // namespace

SignedFunction::SignedFunction(const Primitive& primitive, const Eigen::Isometry3d& place) {
  if (!place.matrix().allFinite()) {
    throw std::invalid_argument("the pose of a part must be finite");
  }
  Node leaf;
  leaf.primitive = primitive;
  leaf.orientation = place.linear();
  leaf.position = place.translation();
  nodes_.push_back(leaf);
  note_levels();
  bounds_ = std::visit([&](const auto& solid) { return placed(solid.bounds(), place); }, primitive);
}

SignedFunction SignedFunction::combine(const SignedFunction& a, const SignedFunction& b,
                                       NodeKind kind, double radius) {
  check(radius);
  if (a.leaves() + b.leaves() > kMostLeaves) {
    throw std::invalid_argument("more than " + std::to_string(kMostLeaves) +
                                " parts; split it into several objects");
  }
  SignedFunction whole;
  whole.nodes_ = a.nodes_;
  whole.nodes_.insert(whole.nodes_.end(), b.nodes_.begin(), b.nodes_.end());
  Node top;
  top.kind = kind;
  top.radius = radius;
  whole.nodes_.push_back(top);
  whole.exact_outside_ =
      kind == NodeKind::least && radius == 0.0 && a.exact_outside_ && b.exact_outside_;
  whole.note_levels();
  return whole;
}

// De Morgan: the complement of a union is the intersection of the complements.
SignedFunction SignedFunction::complement() const {
  SignedFunction other = *this;
  for (Node& node : other.nodes_) {
    if (node.kind == NodeKind::leaf) {
      node.complement = !node.complement;
    } else {
      node.kind = node.kind == NodeKind::least ? NodeKind::greatest : NodeKind::least;
    }
  }
  other.exact_outside_ = false;
  return other;
}

// From the top down, which is the reverse order, each node passes its sag to its two children. The
// maximum of convex functions is convex, rounded or not.
void SignedFunction::note_levels() {
  std::vector<double> open{0.0};
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    const double sag = open.back();
    open.pop_back();
    node->sag = sag;
    if (node->kind == NodeKind::leaf) continue;
    const double own = node->kind == NodeKind::least ? 0.25 * node->radius : 0.0;
    open.insert(open.end(), 2, sag + own);
  }
  std::vector<bool> convex;
  for (Node& node : nodes_) {
    if (node.kind == NodeKind::leaf) {
      node.convex =
          !node.complement &&
          std::visit([](const auto& solid) { return std::decay_t<decltype(solid)>::kIsConvex; },
                     node.primitive);
    } else {
      const bool second = convex.back();
      convex.pop_back();
      node.convex = node.kind == NodeKind::greatest && second && convex.back();
      convex.pop_back();
    }
    convex.push_back(node.convex);
  }
}

SignedFunction unite(const SignedFunction& a, const SignedFunction& b, double radius) {
  SignedFunction whole = SignedFunction::combine(a, b, SignedFunction::NodeKind::least, radius);
  whole.bounds_ = a.bounds_.merged(b.bounds_);
  const Vector3d room = Vector3d::Constant(0.25 * radius);  // the greatest decrease of f
  whole.bounds_ = AlignedBox3d(whole.bounds_.min() - room, whole.bounds_.max() + room);
  return whole;
}

SignedFunction intersect(const SignedFunction& a, const SignedFunction& b, double radius) {
  SignedFunction whole = SignedFunction::combine(a, b, SignedFunction::NodeKind::greatest, radius);
  whole.bounds_ = a.bounds_.intersection(b.bounds_);
  return whole;
}

SignedFunction subtract(const SignedFunction& a, const SignedFunction& b, double radius) {
  SignedFunction whole =
      SignedFunction::combine(a, b.complement(), SignedFunction::NodeKind::greatest, radius);
  whole.bounds_ = a.bounds_;
  return whole;
}

WaySample SignedFunction::sample_leaf(const Node& node, const Vector3d& p,
                                      const Vector3d* direction, double level) noexcept {
  const Vector3d local = node.orientation.transpose() * (p - node.position);
  return std::visit(
      [&](const auto& solid) -> WaySample {
        using Function = std::decay_t<decltype(solid)>;
        const SignedSample own = solid.sample(local);
        const double sign = node.complement ? -1.0 : 1.0;
        WaySample out{sign * own.value, node.orientation * (sign * own.gradient), 0.0};
        if (direction == nullptr) return out;
        const double height = out.value - level;
        if (!(height > 0.0)) return out;
        out.advance = height;  // by the Lipschitz constant
        if (node.complement) {
          const Vector3d turned = node.orientation.transpose() * *direction;
          out.advance = std::max(height, way_out(solid, local, turned, level));
        } else if (Function::kIsConvex) {
          out.advance = std::max(height, above_tangent(height, out.gradient.dot(*direction)));
        }
        return out;
      },
      node.primitive);
}

SignedSample SignedFunction::sample(const Vector3d& p) const noexcept {
  std::array<WaySample, kMostLeaves> stack;
  std::size_t size = 0;
  for (const Node& node : nodes_) {
    if (node.kind == NodeKind::leaf) {
      stack[size++] = sample_leaf(node, p, nullptr, 0.0);
      continue;
    }
    const WaySample& b = stack[--size];
    WaySample& a = stack[size - 1];
    const double sign = node.kind == NodeKind::least ? 1.0 : -1.0;
    const Blend round = blend(a.value, b.value, node.radius);
    const bool second = sign * b.value < sign * a.value;
    const double share = second ? 1.0 - round.share : round.share;  // share of b
    a.gradient += share * (b.gradient - a.gradient);
    a.value = (second ? b.value : a.value) - sign * round.off;
  }
  return {stack[0].value, stack[0].gradient};
}

WaySample SignedFunction::sample_along(const Vector3d& p, const Vector3d& direction, double level,
                                       double tie) const noexcept {
  std::array<WaySample, kMostLeaves> stack;
  std::size_t size = 0;
  for (const Node& node : nodes_) {
    if (node.kind == NodeKind::leaf) {
      stack[size++] = sample_leaf(node, p, &direction, level + node.sag);
      continue;
    }
    const WaySample& b = stack[--size];
    WaySample& a = stack[size - 1];
    const bool least = node.kind == NodeKind::least;
    const double sign = least ? 1.0 : -1.0;
    const Blend round = blend(a.value, b.value, node.radius);
    const double gap = sign * (b.value - a.value);
    // At an edge, the function into which the path leads: a minimum has the lesser derivative.
    const bool tied = std::abs(gap) <= tie && !(round.off > 0.0);
    const bool second = tied ? sign * direction.dot(b.gradient - a.gradient) < 0.0 : gap < 0.0;
    const double share = second ? 1.0 - round.share : round.share;
    a.gradient += share * (b.gradient - a.gradient);
    a.advance = least ? std::min(a.advance, b.advance) : std::max(a.advance, b.advance);
    a.value = (gap < 0.0 ? b.value : a.value) - sign * round.off;
    const double height = a.value - level - node.sag;
    if (node.convex && height > 0.0) {
      a.advance = std::max(a.advance, above_tangent(height, a.gradient.dot(direction)));
    }
    a.advance = std::max(a.advance, height);
  }
  return stack[0];
}

}  // namespace reckon::haptics
