// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/tracks/entity_track.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "reckon/deadreckon/motion/rotation.hpp"

namespace reckon::peer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kNear = 1.5;    // mean steps between the ends of what repeats by itself
constexpr double kSame = 0.1;    // mean steps between points that are taken for one
constexpr double kStops = 0.05;  // of the greatest speed: slower has no direction

/// Value and slope of the parabola through three neighbours, from the slopes of its two sides.
struct Parabola {
  Vector3d rate, change;
};

Parabola parabola(double before, const Vector3d& slope_before, double after,
                  const Vector3d& slope_after) {
  const double both = before + after;
  return {(after * slope_before + before * slope_after) / both,
          2.0 * (slope_after - slope_before) / both};
}

void require(bool good, const char* what) {
  if (!good) throw std::invalid_argument(std::string("track: ") + what);
}

void check(const TrackSamples& samples) {
  const auto& times = samples.times;
  require(!times.empty(), "it needs one sample at least");
  require(samples.positions.size() == times.size(), "it needs as many positions as times");
  require(samples.orientations.empty() || samples.orientations.size() == times.size(),
          "it needs as many orientations as times, or none");
  for (std::size_t i = 0; i < times.size(); ++i) {
    require(std::isfinite(times[i]), "a time is not finite");
    require(i == 0 || times[i] - times[i - 1] >= TrackSamples::kLeastStep,
            "times must grow by 1 us at least");
    require((samples.positions[i].array().abs() <= TrackSamples::kFarthest).all(),
            "a position is more than 1000 km from the origin");
    require(samples.orientations.empty() ||
                std::abs(samples.orientations[i].norm() - 1.0) < 1e-6,
            "an orientation is no unit quaternion");
  }
}

double length_of(const std::vector<Vector3d>& positions) {
  double length = 0;
  for (std::size_t i = 1; i < positions.size(); ++i) {
    length += (positions[i] - positions[i - 1]).norm();
  }
  return length;
}

bool ends_meet(const std::vector<Vector3d>& positions, double length) {
  if (positions.size() < 3) return false;
  const double step = length / static_cast<double>(positions.size() - 1);
  return (positions.back() - positions.front()).norm() <= kNear * step;
}

/// Body x level along `velocity`, z down.
Quaterniond along(const Vector3d& velocity) {
  return Quaterniond(Eigen::AngleAxisd(std::atan2(velocity.y(), velocity.x()), Vector3d::UnitZ())) *
         Quaterniond(0.0, 1.0, 0.0, 0.0);
}

double level_speed(const Vector3d& velocity) { return velocity.head<2>().norm(); }

}  // namespace

struct TrackCurve::Knot {
  double time;  // [s], the first is 0
  Vector3d position;
  Quaterniond orientation = Quaterniond::Identity();
  Vector3d velocity = Vector3d::Zero();
  Vector3d acceleration = Vector3d::Zero();
  Vector3d angular_velocity = Vector3d::Zero();  // [rad/s], body axes
};

TrackCurve::TrackCurve(TrackSamples samples, std::optional<bool> repeat, TrackTurn turn) {
  check(samples);
  length_ = length_of(samples.positions);
  repeat_ = samples.times.size() > 1 && repeat.value_or(ends_meet(samples.positions, length_));
  if (turn == TrackTurn::held) samples.orientations.clear();
  turns_ = !samples.orientations.empty();
  std::vector<Knot> knots = knots_of(samples);
  if (repeat_) close(knots);
  set_rates(knots);
  if (!turns_ && turn == TrackTurn::nose_ahead) face_ahead(knots);
  set_turning(knots);
  build(knots);
}

std::vector<TrackCurve::Knot> TrackCurve::knots_of(const TrackSamples& samples) const {
  std::vector<Knot> knots;
  knots.reserve(samples.times.size() + 1);
  for (std::size_t i = 0; i < samples.times.size(); ++i) {
    knots.push_back({samples.times[i] - samples.times.front(), samples.positions[i]});
    if (turns_) knots.back().orientation = samples.orientations[i];
  }
  return knots;
}

// The last point is the first, or one more leads there at the mean speed.
void TrackCurve::close(std::vector<Knot>& knots) const {
  const Knot& first = knots.front();
  const double gap = (knots.back().position - first.position).norm();
  if (gap > kSame * length_ / static_cast<double>(knots.size() - 1)) {
    const double speed = length_ / knots.back().time;
    knots.push_back({knots.back().time + gap / speed, first.position});
  }
  knots.back().position = first.position;
  knots.back().orientation = first.orientation;
}

void TrackCurve::set_rates(std::vector<Knot>& knots) const {
  const std::size_t last = knots.size() - 1;
  if (last == 0) return;
  const auto span = [&](std::size_t i) { return knots[i + 1].time - knots[i].time; };
  const auto slope = [&](std::size_t i) -> Vector3d {
    return (knots[i + 1].position - knots[i].position) / span(i);
  };
  for (std::size_t i = repeat_ ? 0 : 1; i < last; ++i) {
    const std::size_t before = i == 0 ? last - 1 : i - 1;
    const Parabola at = parabola(span(before), slope(before), span(i), slope(i));
    knots[i].velocity = at.rate;
    knots[i].acceleration = at.change;
  }
  if (repeat_) {
    knots[last].velocity = knots[0].velocity;
    knots[last].acceleration = knots[0].acceleration;
  } else {
    knots[0].acceleration = last > 1 ? knots[1].acceleration : Vector3d::Zero();
    knots[0].velocity = slope(0) - 0.5 * span(0) * knots[0].acceleration;
  }
}

void TrackCurve::face_ahead(std::vector<Knot>& knots) {
  double fastest = 0;
  for (const Knot& knot : knots) fastest = std::max(fastest, level_speed(knot.velocity));
  const auto moving = [&](const Knot& knot) {
    return level_speed(knot.velocity) > kStops * fastest;
  };
  const auto first = std::ranges::find_if(knots, moving);
  if (first == knots.end()) return;
  const auto before = repeat_ ? std::find_if(knots.rbegin(), knots.rend(), moving).base() - 1 : first;
  Quaterniond facing = along(before->velocity);
  for (Knot& knot : knots) {
    if (moving(knot)) facing = along(knot.velocity);
    knot.orientation = facing;
  }
  turns_ = true;
}

void TrackCurve::set_turning(std::vector<Knot>& knots) const {
  const std::size_t last = knots.size() - 1;
  if (!turns_ || last == 0) return;
  const auto span = [&](std::size_t i) { return knots[i + 1].time - knots[i].time; };
  const auto slope = [&](std::size_t i) -> Vector3d {
    return deadreckon::logarithm(knots[i].orientation.conjugate() * knots[i + 1].orientation) /
           span(i);
  };
  for (std::size_t i = repeat_ ? 0 : 1; i < last; ++i) {
    const std::size_t before = i == 0 ? last - 1 : i - 1;
    knots[i].angular_velocity = parabola(span(before), slope(before), span(i), slope(i)).rate;
  }
  if (repeat_) {
    knots[last].angular_velocity = knots[0].angular_velocity;
  } else {
    knots[0].angular_velocity = slope(0);
  }
}

void TrackCurve::build(const std::vector<Knot>& knots) {
  end_ = knots.back().time;
  last_position_ = knots.back().position;
  last_orientation_ = knots.back().orientation;
  segments_.reserve(knots.size() - 1);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const Knot& a = knots[i];
    const Knot& b = knots[i + 1];
    const double h = b.time - a.time;
    const Vector3d way = b.position - a.position;
    const Vector3d va = h * a.velocity, vb = h * b.velocity;
    const Vector3d aa = h * h * a.acceleration, ab = h * h * b.acceleration;
    Segment& s = segments_.emplace_back();
    s.begin = a.time;
    s.per_span = 1.0 / h;
    s.c0 = a.position;
    s.c1 = va;
    s.c2 = 0.5 * aa;
    s.c3 = 10.0 * way - 6.0 * va - 4.0 * vb - 1.5 * aa + 0.5 * ab;
    s.c4 = -15.0 * way + 8.0 * va + 7.0 * vb + 1.5 * aa - ab;
    s.c5 = 6.0 * way - 3.0 * (va + vb) + 0.5 * (ab - aa);
    if (!turns_) continue;
    const Vector3d turn = deadreckon::logarithm(a.orientation.conjugate() * b.orientation);
    const Vector3d ra = h * a.angular_velocity;
    const Vector3d rb = h * deadreckon::rate_of_rotation_vector(turn, b.angular_velocity);
    s.orientation = a.orientation;
    s.r1 = ra;
    s.r2 = 3.0 * turn - 2.0 * ra - rb;
    s.r3 = ra + rb - 2.0 * turn;
  }
  build_index();
}

void TrackCurve::build_index() {
  const std::size_t count = segments_.size();
  if (count == 0) return;
  steps_per_second_ = static_cast<double>(count) / end_;
  index_.reserve(count + 1);
  std::size_t segment = 0;
  for (std::size_t step = 0; step <= count; ++step) {
    const double time = static_cast<double>(step) / steps_per_second_;
    while (segment + 1 < count && segments_[segment + 1].begin <= time) ++segment;
    index_.push_back(static_cast<std::uint32_t>(segment));
  }
}

// Rounding at a border may give the neighbour, whose polynomial goes on there.
const TrackCurve::Segment& TrackCurve::segment_at(double time) const noexcept {
  const auto step =
      std::min(static_cast<std::size_t>(time * steps_per_second_), segments_.size() - 1);
  const auto* first = segments_.data() + index_[step];
  const auto* last = segments_.data() + index_[step + 1] + 1;
  const auto* next = std::upper_bound(first + 1, last, time,
                                      [](double t, const Segment& s) { return t < s.begin; });
  return *(next - 1);
}

deadreckon::KinematicState TrackCurve::at(double time) const noexcept {
  deadreckon::KinematicState state;
  if (!(time > 0)) time = 0;
  if (repeat_ && time >= end_) {
    time -= std::floor(time / end_) * end_;
    if (!(time >= 0 && time < end_)) time = 0;
  }
  if (time >= end_) {
    state.position = last_position_;
    state.orientation = last_orientation_;
    return state;
  }
  const Segment& s = segment_at(time);
  const double u = (time - s.begin) * s.per_span;
  state.position = s.c0 + u * (s.c1 + u * (s.c2 + u * (s.c3 + u * (s.c4 + u * s.c5))));
  state.velocity =
      s.per_span * (s.c1 + u * (2 * s.c2 + u * (3 * s.c3 + u * (4 * s.c4 + u * (5 * s.c5)))));
  state.acceleration = s.per_span * s.per_span *
                       (2 * s.c2 + u * (6 * s.c3 + u * (12 * s.c4 + u * (20 * s.c5))));
  if (!turns_) return state;
  const Vector3d turned = u * (s.r1 + u * (s.r2 + u * s.r3));
  const Vector3d rate = s.per_span * (s.r1 + u * (2 * s.r2 + u * (3 * s.r3)));
  state.orientation = s.orientation * deadreckon::exponential(turned);
  state.angular_velocity = deadreckon::angular_velocity_of(turned, rate);
  return state;
}

std::size_t TrackCurve::octets() const noexcept {
  return sizeof(*this) + segments_.capacity() * sizeof(Segment) +
         index_.capacity() * sizeof(std::uint32_t);
}

EntityTrack::EntityTrack(std::shared_ptr<const TrackCurve> curve, const Vector3d& offset,
                         const Quaterniond& orientation, double speed)
    : curve_(std::move(curve)), offset_(offset), orientation_(orientation), speed_(speed) {
  require(curve_ != nullptr, "there is no curve to follow");
  require(speed_ > 0 && std::isfinite(speed_), "its speed must be above 0");
}

deadreckon::KinematicState EntityTrack::at(double time) const noexcept {
  deadreckon::KinematicState state;
  if (curve_ != nullptr) state = curve_->at(time * speed_);
  state.position += offset_;
  if (curve_ == nullptr || !curve_->turns()) state.orientation = orientation_;
  state.velocity *= speed_;
  state.acceleration *= speed_ * speed_;
  state.angular_velocity *= speed_;
  return state;
}

}  // namespace reckon::peer
