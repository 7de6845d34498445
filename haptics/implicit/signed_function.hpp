// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Union, intersection and difference of placed primitives as one signed function f, constructive
// solid geometry (CSG), with sharp or rounded edges. Basis of contacts with implicit surfaces.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/haptics/implicit/primitives.hpp"

namespace reckon::haptics {

/// f at a point of a straight path.
struct WaySample {
  double value = 0.0;  ///< [m]
  /// If surfaces meet within the tie, the gradient of the one that f follows along the path.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double advance = 0.0;  ///< [m]: distance along the path over which f stays above the given level
};

/// A tree of signed functions; f < 0 inside, 0 on the surface, > 0 outside.
///
/// |f| is never more than the distance from the surface, and |f(p) - f(q)| <= |p - q| (Lipschitz
/// constant 1), rounded edges included. It equals the distance for one primitive, outside of a
/// union, and inside of an intersection. It is only a lower bound
///  - outside of an intersection or difference, beside a convex edge: along the mitre of an edge of
///    90 deg it is 0.71 of the distance;
///  - inside of a union, where the parts overlap;
///  - within the band of a rounded edge.
/// The gradient has length 1, except within such a band, where it is shorter.
///
/// A rounded edge blends the two functions a and b where |a - b| < radius by a parabola: at a right
/// angle it leaves each surface `radius` from the edge, like a circular fillet of that radius, and
/// its smallest radius of curvature is 0.71 of it. It reduces f by at most radius/4.
///
/// Example: a plate of 10 mm with a bore, its rim rounded.
///   const auto f = subtract(SignedFunction(BoxFunction{{0.05, 0.05, 0.005}}),
///                           SignedFunction(CylinderFunction{0.01, 0.02}), 0.002);
///   f.sample({0.0, 0.0, 0.0}).value;  // > 0: in the bore
///
/// Evaluation is noexcept, does not allocate and costs the same everywhere: about the sum of its
/// nodes. Construction allocates.
class SignedFunction {
 public:
  /// Greatest number of primitives in a tree.
  static constexpr std::size_t kMostLeaves = 32;

  /// One primitive; p = place * p_primitive.
  /// @throws std::invalid_argument for a place that is not finite
  explicit SignedFunction(const Primitive& primitive,
                          const Eigen::Isometry3d& place = Eigen::Isometry3d::Identity());

  /// @throws std::invalid_argument above kMostLeaves, or for a radius below 0 or not finite
  friend SignedFunction unite(const SignedFunction& a, const SignedFunction& b, double radius);
  friend SignedFunction intersect(const SignedFunction& a, const SignedFunction& b, double radius);
  friend SignedFunction subtract(const SignedFunction& a, const SignedFunction& b, double radius);

  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;

  /// Also computes a distance along the path from p over which f stays above `level` [m].
  /// @param direction unit  @param tie [m]: surfaces whose functions differ by less are both met
  [[nodiscard]] WaySample sample_along(const Eigen::Vector3d& p, const Eigen::Vector3d& direction,
                                       double level, double tie) const noexcept;

  /// Contains the solid. Infinite if the solid may be unbounded, empty if nothing of it is left.
  [[nodiscard]] const Eigen::AlignedBox3d& bounds() const noexcept { return bounds_; }
  [[nodiscard]] std::size_t leaves() const noexcept { return (nodes_.size() + 1) / 2; }
  /// Whether f is the distance outside, and not only a bound of it.
  [[nodiscard]] bool exact_outside() const noexcept { return exact_outside_; }
  /// Whether f is known to be convex, and so above each of its tangents: a convex primitive or an
  /// intersection of convex functions.
  [[nodiscard]] bool convex() const noexcept { return nodes_.back().convex; }

 private:
  enum class NodeKind : std::uint8_t { leaf, least, greatest };

  // In postfix order. Only leaves have complements.
  struct Node {
    NodeKind kind = NodeKind::leaf;
    bool complement = false;  // leaf: of the primitive
    bool convex = true;       // f of this node, along each straight path
    double radius = 0.0;      // of the edge
    double sag = 0.0;         // leaf: greatest decrease of f by the rounded unions above it [m]
    Primitive primitive = SphereFunction{1.0};
    Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  // primitive -> tree
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
  };

  SignedFunction() = default;
  static SignedFunction combine(const SignedFunction& a, const SignedFunction& b, NodeKind kind,
                                double radius);
  [[nodiscard]] SignedFunction complement() const;
  void note_levels();
  [[nodiscard]] static WaySample sample_leaf(const Node& node, const Eigen::Vector3d& p,
                                             const Eigen::Vector3d* direction,
                                             double level) noexcept;

  std::vector<Node> nodes_;
  Eigen::AlignedBox3d bounds_;
  bool exact_outside_ = true;
};

/// Solid where either a or b is. @param radius of the edge between them [m], 0 is sharp
[[nodiscard]] SignedFunction unite(const SignedFunction& a, const SignedFunction& b,
                                   double radius = 0.0);
/// Solid where both a and b are.
[[nodiscard]] SignedFunction intersect(const SignedFunction& a, const SignedFunction& b,
                                       double radius = 0.0);
/// Solid where a is and b is not.
[[nodiscard]] SignedFunction subtract(const SignedFunction& a, const SignedFunction& b,
                                      double radius = 0.0);

}  // namespace reckon::haptics
