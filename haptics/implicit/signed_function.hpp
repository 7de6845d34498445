// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Union, intersection and difference of placed primitives as one signed function f, constructive
// solid geometry (CSG), with sharp or with rounded edges; what a contact with an implicit surface
// is computed from.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/haptics/implicit/primitives.hpp"

namespace reckon::haptics {

/// f at a point of a straight way.
struct WaySample {
  double value = 0.0;  ///< [m]
  /// Where surfaces meet within the tie, that of the one which f follows along the way.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double advance = 0.0;  ///< [m]: so far along the way, f stays above the level asked for
};

/// A tree of signed functions; f < 0 inside, 0 on the surface, > 0 outside.
///
/// |f| is never more than the distance from the surface, and |f(p) - f(q)| <= |p - q| (Lipschitz
/// constant 1), rounded edges included. It is the distance itself for one primitive, outside of a
/// union, and inside of an intersection. It is only a bound
///  - outside of an intersection or difference, beside a convex edge: along the mitre of an edge of
///    90 deg it is 0.71 of the distance;
///  - inside of a union, where the parts overlap;
///  - within the band of a rounded edge.
/// The gradient is of length 1 but within such a band, where it is shorter.
///
/// A rounded edge blends the two functions a and b where |a - b| < radius by a parabola: at a right
/// angle it leaves each surface `radius` from the edge, as a circular fillet of that radius does,
/// and its tightest curve has 0.71 of it. It takes no more than radius/4 off f.
///
/// Example: a plate of 10 mm with a bore, its rim rounded.
///   const auto f = subtract(SignedFunction(BoxFunction{{0.05, 0.05, 0.005}}),
///                           SignedFunction(CylinderFunction{0.01, 0.02}), 0.002);
///   f.sample({0.0, 0.0, 0.0}).value;  // > 0: in the bore
///
/// Evaluation is noexcept, allocates nothing and costs the same everywhere: about the sum of its
/// nodes. Making one allocates.
class SignedFunction {
 public:
  /// Most primitives of a tree.
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

  /// Also how far a way from p may go before f can come down to `level` [m].
  /// @param direction unit  @param tie [m]: surfaces whose functions differ by less count as met
  /// both
  [[nodiscard]] WaySample sample_along(const Eigen::Vector3d& p, const Eigen::Vector3d& direction,
                                       double level, double tie) const noexcept;

  /// Holds the solid; infinite where that may have no end, empty where nothing is left.
  [[nodiscard]] const Eigen::AlignedBox3d& bounds() const noexcept { return bounds_; }
  [[nodiscard]] std::size_t leaves() const noexcept { return (nodes_.size() + 1) / 2; }
  /// Whether outside it is the distance and not only a bound of it.
  [[nodiscard]] bool exact_outside() const noexcept { return exact_outside_; }

 private:
  enum class NodeKind : std::uint8_t { leaf, least, greatest };

  // In postfix order. Complements stand at the leaves alone.
  struct Node {
    NodeKind kind = NodeKind::leaf;
    bool complement = false;  // leaf: of the primitive
    bool convex = true;       // f of this node, along each straight way
    double radius = 0.0;      // of the edge
    double sag = 0.0;         // leaf: what the rounded unions above it take off f at most [m]
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

/// Solid where either is. @param radius of the edge between them [m], 0 is sharp
[[nodiscard]] SignedFunction unite(const SignedFunction& a, const SignedFunction& b,
                                   double radius = 0.0);
/// Solid where both are.
[[nodiscard]] SignedFunction intersect(const SignedFunction& a, const SignedFunction& b,
                                       double radius = 0.0);
/// Solid where a is and b is not.
[[nodiscard]] SignedFunction subtract(const SignedFunction& a, const SignedFunction& b,
                                      double radius = 0.0);

}  // namespace reckon::haptics
