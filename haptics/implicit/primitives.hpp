// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Solids as signed functions f of a point, in their own axes, metres: f < 0 inside, 0 on the
// surface, > 0 outside. Each one here is the exact signed distance, inside and outside: |gradient|
// = 1.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <variant>

namespace reckon::haptics {

/// Value of a signed function at one point.
struct SignedSample {
  double value = 0.0;                                  ///< [m]
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< at a discontinuity, from one side
};

/// Solid where normal . p < 0.
struct HalfSpaceFunction {
  Eigen::Vector3d normal;                  ///< unit
  static constexpr bool kIsConvex = true;  ///< the solid, and so f along each straight path
  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;
};

/// A ball around the origin.
struct SphereFunction {
  double radius;  ///< [m], > 0
  static constexpr bool kIsConvex = true;
  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;
};

/// A block around the origin, edges along the axes.
struct BoxFunction {
  Eigen::Vector3d half;  ///< half of each edge [m], > 0
  static constexpr bool kIsConvex = true;
  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;
};

/// A cylinder with flat ends around the origin, its axis along z.
struct CylinderFunction {
  double radius;  ///< [m], > 0
  double half;    ///< half of its height [m], > 0
  static constexpr bool kIsConvex = true;
  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;
};

/// A cone, or a frustum, about z, with its base at -half and its tip or upper face at +half.
struct ConeFunction {
  double base;  ///< radius of the base [m], >= 0
  double top;   ///< radius of the upper face [m], >= 0; 0 is a tip. Not both 0
  double half;  ///< half of its height [m], > 0
  static constexpr bool kIsConvex = true;
  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;
};

/// A ring around z.
struct TorusFunction {
  double radius;  ///< of the centre line of its tube [m], > tube
  double tube;    ///< radius of the tube [m], > 0
  static constexpr bool kIsConvex = false;
  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;
};

/// An ellipsoid around the origin, axes along x, y, z. Its distance is a root that Newton's method
/// finds from one side in 4 to 8 steps near the surface, and in at most 100 near its centre.
struct EllipsoidFunction {
  Eigen::Vector3d semi;  ///< semi-axes [m], > 0
  static constexpr bool kIsConvex = true;
  [[nodiscard]] SignedSample sample(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;
};

using Primitive = std::variant<HalfSpaceFunction, SphereFunction, BoxFunction, CylinderFunction,
                               ConeFunction, TorusFunction, EllipsoidFunction>;

}  // namespace reckon::haptics
