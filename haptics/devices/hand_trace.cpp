// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/hand_trace.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace reckon::haptics {
namespace {

Eigen::AlignedBox3d box_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  return box;
}

std::vector<Eigen::Vector3d> placed(std::vector<Eigen::Vector3d> points,
                                    const HandTraceOptions& options) {
  const Eigen::AlignedBox3d box = box_of(points);
  Eigen::Vector3d centre = box.center();
  double scale = options.scale;
  Eigen::Vector3d to = centre;
  if (options.fit_to) {
    const Eigen::Array3d room = options.fit_to->sizes().array();
    const Eigen::Array3d size = box.sizes().array().max(1e-12);
    scale *= std::min(1.0, (room / size).minCoeff());
    to = options.fit_to->center();
  }
  for (Eigen::Vector3d& p : points) p = to + scale * (p - centre) + options.offset;
  return points;
}

// Velocity of the parabola through three neighbours; exact for uneven times.
Eigen::Vector3d slope(const std::vector<double>& t, const std::vector<Eigen::Vector3d>& p,
                      std::size_t i) {
  const std::size_t last = t.size() - 1;
  if (last == 0) return Eigen::Vector3d::Zero();
  if (i == 0) return (p[1] - p[0]) / (t[1] - t[0]);
  if (i == last) return (p[i] - p[i - 1]) / (t[i] - t[i - 1]);
  const double before = t[i] - t[i - 1];
  const double after = t[i + 1] - t[i];
  return (before * (p[i + 1] - p[i]) / after + after * (p[i] - p[i - 1]) / before) /
         (before + after);
}

}  // namespace

HandTrace::HandTrace(std::vector<double> times, std::vector<Eigen::Vector3d> positions,
                     const HandTraceOptions& options) {
  if (times.empty() || times.size() != positions.size()) {
    throw std::invalid_argument(
        "hand trace: needs one time for each position, and at least one position");
  }
  const auto stuck =
      std::adjacent_find(times.begin(), times.end(), [](double a, double b) { return !(b > a); });
  if (stuck != times.end()) throw std::invalid_argument("hand trace: times must increase");
  build(times, positions, options);
}

void HandTrace::build(const std::vector<double>& times,
                      const std::vector<Eigen::Vector3d>& positions,
                      const HandTraceOptions& options) {
  if (!(options.scale > 0) || !(options.loop_blend > 0)) {
    throw std::invalid_argument("hand trace: scale and loop blend must be above 0");
  }
  loop_ = options.loop;
  const std::vector<Eigen::Vector3d> p = placed(positions, options);
  knots_.reserve(p.size() + 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    knots_.push_back({times[i] - times.front(), p[i], slope(times, p, i)});
  }
  if (loop_) {
    Knot back = knots_.front();
    back.time = knots_.back().time + options.loop_blend;
    knots_.push_back(back);
  } else {
    knots_.back().velocity.setZero();
  }
}

HandTarget HandTrace::at(double time) const noexcept {
  if (!(time > 0)) time = 0;
  const double end = knots_.back().time;
  if (loop_) time = std::fmod(time, end);
  HandTarget out;
  if (time >= end || knots_.size() < 2) {
    out.position = knots_.back().position;
    return out;
  }
  const auto next = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, time,
                                     [](double t, const Knot& k) { return t < k.time; });
  const Knot& a = *(next - 1);
  const Knot& b = *next;
  const double span = b.time - a.time;
  const double u = (time - a.time) / span;
  const double v = 1 - u;

  // Cubic Hermite.
  out.position = v * v * (1 + 2 * u) * a.position + u * u * (3 - 2 * u) * b.position +
                 u * v * span * (v * a.velocity - u * b.velocity);
  out.velocity = 6 * u * v / span * (b.position - a.position) + v * (1 - 3 * u) * a.velocity +
                 u * (3 * u - 2) * b.velocity;
  return out;
}

Eigen::AlignedBox3d HandTrace::bounds() const noexcept {
  Eigen::AlignedBox3d box;
  for (const Knot& k : knots_) box.extend(k.position);
  return box;
}

}  // namespace reckon::haptics
