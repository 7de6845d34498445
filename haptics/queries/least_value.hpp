// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The least value of a signed function on a set of points, between two bounds: best-first search of
// pieces of the set (branch and bound).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "reckon/haptics/implicit/primitives.hpp"

namespace reckon::haptics {

/// Bounds of the least value, and the point of `most`.
struct LeastValue {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
};

/// A function at a point.
struct FieldSample {
  double value = 0.0;  ///< [m]
  /// Sample of a convex function that nowhere exceeds this one, such as itself; needed only if
  /// `convex`.
  SignedSample below;

  FieldSample(const SignedSample& own) : value(own.value), below(own) {}
  FieldSample(double own, const SignedSample& convex) : value(own), below(convex) {}
};

/// Greatest number of samples in one search.
inline constexpr std::size_t kMostPieces = 1024;

/// A box about a middle.
struct BoxPiece {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();

  /// Whether all its points belong to the set; false: it only encloses a part of the set.
  [[nodiscard]] static bool on_set() noexcept { return true; }
  [[nodiscard]] Eigen::Vector3d middle() const noexcept { return centre; }
  /// Radius of a ball around the middle that contains the piece.
  [[nodiscard]] double radius() const noexcept { return half.norm(); }
  /// Point of the piece at which a plane of this slope is lowest.
  [[nodiscard]] Eigen::Vector3d lowest(const Eigen::Vector3d& slope) const noexcept {
    Eigen::Vector3d at = centre;
    for (Eigen::Index i = 0; i < 3; ++i)
      if (slope[i] != 0.0) at[i] -= std::copysign(half[i], slope[i]);
    return at;
  }
  void split(auto&& take) const noexcept {
    Eigen::Index axis = 0;
    if (!(half.maxCoeff(&axis) > 0.0)) return;
    BoxPiece part = *this;
    part.half[axis] *= 0.5;
    part.centre[axis] = centre[axis] - part.half[axis];
    take(part);
    part.centre[axis] = centre[axis] + part.half[axis];
    take(part);
  }
};

/// Priority queue of pieces by their bound, with room for kMostPieces + 1.
template <class Piece>
class PieceQueue {
 public:
  void push(double bound, const Piece& piece) noexcept {
    entries_[count_++] = {bound, piece};
    std::push_heap(entries_.begin(), end(), later);
  }
  Piece pop() noexcept {
    std::pop_heap(entries_.begin(), end(), later);
    return entries_[--count_].piece;
  }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  [[nodiscard]] double least() const noexcept { return entries_.front().bound; }

 private:
  struct Entry {
    double bound = 0.0;
    Piece piece;
  };
  static bool later(const Entry& one, const Entry& two) noexcept { return one.bound > two.bound; }
  auto end() noexcept { return entries_.begin() + static_cast<std::ptrdiff_t>(count_); }

  std::array<Entry, kMostPieces + 4> entries_;
  std::size_t count_ = 0;
};

/// @param field  p -> FieldSample, or SignedSample; |f(p) - f(q)| <= |p - q|
/// @param convex whether FieldSample::below is set: tangents of a convex function give much better
/// bounds
/// @param tolerance [m], difference of the bounds that ends the search; it also ends after
/// kMostPieces samples with wider bounds
template <class Piece, class Field>
[[nodiscard]] LeastValue least_value(const Piece& whole, const Field& field, bool convex,
                                     double tolerance) noexcept {
  LeastValue found;
  PieceQueue<Piece> queue;
  std::size_t samples = 0;
  const auto offer = [&](const Eigen::Vector3d& at, double value) {
    if (!(value < found.most)) return;
    found.most = value;
    found.at = at;
  };
  const auto take = [&](const Piece& piece) {
    const Eigen::Vector3d middle = piece.middle();
    const FieldSample here = field(middle);
    ++samples;
    if (piece.on_set()) offer(middle, here.value);
    double bound = here.value - piece.radius();
    if (convex) {
      const Eigen::Vector3d lowest = piece.lowest(here.below.gradient);
      bound = std::max(bound, here.below.value + here.below.gradient.dot(lowest - middle));
      if (piece.on_set()) offer(lowest, field(lowest).value);
    }
    queue.push(bound, piece);
  };
  take(whole);
  while (!queue.empty() && samples < kMostPieces - 4 && queue.least() < found.most - tolerance)
    queue.pop().split(take);
  found.least = queue.empty() ? found.most : std::min(queue.least(), found.most);
  return found;
}

}  // namespace reckon::haptics
