// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/pointer_path.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

// The filter's impulse response is h(t) = w^3 t^2/2 e^(-wt). With x = wt:
constexpr double kPeak = 0.27067056647322537;  // largest h / w: 2/e^2, at x = 2
// Total variation of h' / w^2: h' is 0.23058 at x = 2 - sqrt 2 and -0.07944 at 2 + sqrt 2.
constexpr double kSlopeWay = 0.6200250;

Eigen::Vector3d inside(const Eigen::AlignedBox3d& box, const Vector3d& point) {
  return point.cwiseMax(box.min()).cwiseMin(box.max());
}

}  // namespace

PointerPath::PointerPath(const Eigen::AlignedBox3d& box, const Vector3d& start, double max_speed)
    : box_(box), max_speed_(max_speed) {
  if (box.isEmpty() || !box.sizes().allFinite() || !start.allFinite()) {
    throw std::invalid_argument(
        "pointer path: box and start must be finite, and the box not empty");
  }
  if (!(max_speed > 0) || !std::isfinite(max_speed)) {
    throw std::invalid_argument("pointer path: speed must be above 0 m/s, got " +
                                std::to_string(max_speed));
  }
  goal_ = wanted_ = position_ = inside(box_, start);
}

void PointerPath::lead_to(const Vector3d& point) noexcept { goal_ = inside(box_, point); }

void PointerPath::advance(double h) noexcept {
  const Vector3d way = goal_ - wanted_;
  const double needs = way.norm() / max_speed_;  // [s]
  if (needs > 0) {
    const double moving = std::min(h, needs);
    const Vector3d speed = way / needs;
    advance_filter(speed, moving);
    if (moving < needs) {
      wanted_ += moving * speed;
    } else {
      wanted_ = goal_;
    }
    h -= moving;
  }
  advance_filter(Vector3d::Zero(), h);
}

// Exact for a wanted point u + speed t: the path is u + speed (t - 3/w) plus the solution of (1 +
// s/w)^3 e = 0, which is (c0 + c1 t + c2 t^2) e^(-wt).
void PointerPath::advance_filter(const Vector3d& speed, double h) noexcept {
  if (!(h > 0)) return;
  constexpr double w = kBandwidth;
  const Vector3d c0 = position_ - wanted_ + kLag * speed;
  const Vector3d de = velocity_ - speed;
  const Vector3d c1 = de + w * c0;
  const Vector3d c2 = 0.5 * (acceleration_ + 2.0 * w * de + w * w * c0);

  const double fade = std::exp(-w * h);
  const Vector3d e = c0 + h * (c1 + h * c2);
  const Vector3d e1 = c1 + 2.0 * h * c2;
  position_ = wanted_ + (h - kLag) * speed + fade * e;
  velocity_ = speed + fade * (e1 - w * e);
  acceleration_ = fade * (2.0 * c2 - 2.0 * w * e1 + w * w * e);
}

double PointerPath::max_acceleration() const noexcept {
  return 2.0 * kPeak * kBandwidth * max_speed_;
}
double PointerPath::max_jerk() const noexcept {
  return kSlopeWay * kBandwidth * kBandwidth * max_speed_;
}

}  // namespace reckon::haptics
