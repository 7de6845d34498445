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

}  // namespace reckon::haptics
