// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/contact_shares.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Two unit vectors count as two directions above this value of |a - b|^2 and |a + b|^2.
constexpr double kParallel = 1e-6;

// N (N^T N)^(-1/2): the nearest orthonormal directions, by symmetric orthogonalisation (Loewdin).
// The columns of `directions` beyond the shares are zero and stay zero.
bool straighten(Matrix3d& directions, std::size_t count) {
  Matrix3d gram = directions.transpose() * directions;
  for (auto i = static_cast<Eigen::Index>(count); i < 3; ++i) gram(i, i) = 1.0;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(gram);
  if (!(eigen.eigenvalues()(0) > 0.25 * kParallel)) return false;
  directions *= eigen.operatorInverseSqrt();
  return true;
}

}  // namespace

void share_way(const Vector3d& way, std::span<ContactShare> shares) noexcept {
  std::sort(shares.begin(), shares.end(), [](const ContactShare& a, const ContactShare& b) {
    return a.push.squaredNorm() > b.push.squaredNorm();
  });
  for (ContactShare& share : shares) share.way.setZero();
  for (std::size_t count = shares.size(); count > 1; --count) {
    Matrix3d directions = Matrix3d::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      directions.col(static_cast<Eigen::Index>(i)) = shares[i].push.normalized();
    }
    if (!straighten(directions, count)) continue;
    Vector3d rest = way;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d along = directions.col(static_cast<Eigen::Index>(i));
      shares[i].way = along.dot(way) * along;
      rest -= shares[i].way;
    }
    shares[0].way += rest;
    return;
  }
  if (!shares.empty()) shares[0].way = way;
}

std::size_t find_holders(const ContactWalk<ObjectObstacles>& walk, std::uint32_t other,
                         const Vector3d& way, ContactShares& shares) noexcept {
  std::size_t count = 0;
  for (std::size_t i = 0; i < walk.solution.active_count; ++i) {
    if (!(walk.solution.loads[i] > 0.0)) continue;
    const ConstraintPlane& plane = walk.planes[walk.solution.active[i]];
    std::size_t place = 0;
    while (place < count && shares[place].object != plane.object) ++place;
    if (place == count) shares[count++].object = plane.object;
    shares[place].push += walk.solution.loads[i] * plane.normal;
    if (walk.solution.loads[i] > shares[place].load) {
      shares[place].load = walk.solution.loads[i];
      shares[place].triangle = plane.triangle;
    }
  }
  if (count > 0) return count;
  shares[0].object = walk.planes.size() > 0 ? walk.planes[0].object : other;
  shares[0].triangle = walk.planes.size() > 0 ? walk.planes[0].triangle : 0;
  shares[0].push = way.isZero(0.0) && walk.planes.size() > 0 ? walk.planes[0].normal : way;
  return 1;
}

}  // namespace reckon::haptics
