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

constexpr double kNear = 1.5;    // mean steps between the ends of a track that repeats by default
constexpr double kSame = 0.1;    // mean steps between points that count as one
constexpr double kStops = 0.05;  // of the greatest speed: a slower motion has no direction

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
  require(!times.empty(), "it needs at least one sample");
  require(samples.positions.size() == times.size(), "it needs as many positions as times");
  require(samples.orientations.empty() || samples.orientations.size() == times.size(),
          "it needs as many orientations as times, or none");
  for (std::size_t i = 0; i < times.size(); ++i) {
    require(std::isfinite(times[i]), "a time is not finite");
    require(i == 0 || times[i] - times[i - 1] >= TrackSamples::kLeastStep,
            "times must increase by at least 1 us");
    require((samples.positions[i].array().abs() <= TrackSamples::kFarthest).all(),
            "a position is more than 1000 km from the origin");
    require(samples.orientations.empty() || std::abs(samples.orientations[i].norm() - 1.0) < 1e-6,
            "an orientation is not a unit quaternion");
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

/// The time within a round of `end` [s] if it repeats; 0 for an invalid time.
double wrapped(double time, double end, bool repeat) {
  if (!(time > 0)) return 0;
  if (!repeat || time < end) return time;
  time -= std::floor(time / end) * end;
  return time >= 0 && time < end ? time : 0;
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

// Makes the last point equal to the first. If they differ, first adds points that lead there at the
// mean speed, at the same intervals as the others. There are at most as many of them, because the
// way back is not longer.
void TrackCurve::close(std::vector<Knot>& knots) const {
  const Knot first = knots.front(), last = knots.back();
  const Vector3d way = first.position - last.position;
  const double step = length_ / static_cast<double>(knots.size() - 1);
  if (way.norm() > kSame * step) {
    const double seconds = last.time * way.norm() / length_;
    const double pieces = std::max(1.0, std::round(way.norm() / step));
    for (double i = 1; i <= pieces; ++i) {
      knots.push_back({last.time + seconds * i / pieces, last.position + way * i / pieces});
      knots.back().orientation = last.orientation.slerp(i / pieces, first.orientation);
    }
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
  const auto before =
      repeat_ ? std::find_if(knots.rbegin(), knots.rend(), moving).base() - 1 : first;
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

TrackPiece TrackCurve::piece_between(const Knot& a, const Knot& b) const {
  const double h = b.time - a.time;
  const Vector3d way = b.position - a.position;
  const Vector3d va = h * a.velocity, vb = h * b.velocity;
  const Vector3d aa = h * h * a.acceleration, ab = h * h * b.acceleration;
  TrackPiece piece{a.time, b.time, 1.0 / h, turns_};
  piece.c = {a.position,
             va,
             0.5 * aa,
             10.0 * way - 6.0 * va - 4.0 * vb - 1.5 * aa + 0.5 * ab,
             -15.0 * way + 8.0 * va + 7.0 * vb + 1.5 * aa - ab,
             6.0 * way - 3.0 * (va + vb) + 0.5 * (ab - aa)};
  if (!turns_) return piece;
  const Vector3d turn = deadreckon::logarithm(a.orientation.conjugate() * b.orientation);
  const Vector3d ra = h * a.angular_velocity;
  const Vector3d rb = h * deadreckon::rate_of_rotation_vector(turn, b.angular_velocity);
  piece.orientation = a.orientation;
  piece.r = {ra, 3.0 * turn - 2.0 * ra - rb, ra + rb - 2.0 * turn};
  return piece;
}

void TrackCurve::build(const std::vector<Knot>& knots) {
  end_ = knots.back().time;
  last_position_ = knots.back().position;
  last_orientation_ = knots.back().orientation;
  pieces_.reserve(knots.size() - 1);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    pieces_.push_back(piece_between(knots[i], knots[i + 1]));
  }
  build_index();
}

void TrackCurve::build_index() {
  const std::size_t count = pieces_.size();
  if (count == 0) return;
  steps_per_second_ = static_cast<double>(count) / end_;
  index_.reserve(count + 1);
  std::size_t piece = 0;
  for (std::size_t step = 0; step <= count; ++step) {
    const double time = static_cast<double>(step) / steps_per_second_;
    while (piece + 1 < count && pieces_[piece + 1].begin <= time) ++piece;
    index_.push_back(static_cast<std::uint32_t>(piece));
  }
}

// Rounding at a border may give the neighbour, whose polynomial is continuous there.
const TrackPiece& TrackCurve::piece_at(double time) const noexcept {
  const auto step =
      std::min(static_cast<std::size_t>(time * steps_per_second_), pieces_.size() - 1);
  const auto* first = pieces_.data() + index_[step];
  const auto* last = pieces_.data() + index_[step + 1] + 1;
  const auto* next = std::upper_bound(first + 1, last, time,
                                      [](double t, const TrackPiece& p) { return t < p.begin; });
  return *(next - 1);
}

double TrackCurve::within(double time) const noexcept { return wrapped(time, end_, repeat_); }

deadreckon::KinematicState TrackCurve::at(double time) const noexcept {
  time = within(time);
  if (time < end_) return piece_at(time).at(time);
  deadreckon::KinematicState rest;
  rest.position = last_position_;
  rest.orientation = last_orientation_;
  return rest;
}

std::size_t TrackCurve::octets() const noexcept {
  return sizeof(*this) + pieces_.capacity() * sizeof(TrackPiece) +
         index_.capacity() * sizeof(std::uint32_t);
}

deadreckon::KinematicState TrackPiece::at(double time) const noexcept {
  const double u = (time - begin) * per_span;
  deadreckon::KinematicState state;
  state.position = c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * (c[4] + u * c[5]))));
  state.velocity =
      per_span * (c[1] + u * (2 * c[2] + u * (3 * c[3] + u * (4 * c[4] + u * (5 * c[5])))));
  state.acceleration =
      per_span * per_span * (2 * c[2] + u * (6 * c[3] + u * (12 * c[4] + u * (20 * c[5]))));
  if (!turns) return state;
  const Vector3d turned = u * (r[0] + u * (r[1] + u * r[2]));
  const Vector3d rate = per_span * (r[0] + u * (2 * r[1] + u * (3 * r[2])));
  state.orientation = orientation * deadreckon::exponential(turned);
  state.angular_velocity = deadreckon::angular_velocity_of(turned, rate);
  return state;
}

EntityTrack::EntityTrack(const Vector3d& position, const Quaterniond& orientation)
    : offset_(position), orientation_(orientation) {}

EntityTrack::EntityTrack(std::shared_ptr<const TrackCurve> curve, const Vector3d& offset,
                         const Quaterniond& orientation, double speed)
    : offset_(offset), orientation_(orientation), speed_(speed), curve_(std::move(curve)) {
  require(curve_ != nullptr, "there is no curve to follow");
  require(speed_ > 0 && std::isfinite(speed_), "its speed must be above 0");
  end_ = curve_->duration();
  repeat_ = curve_->repeats();
  turns_ = curve_->turns();
}

deadreckon::KinematicState EntityTrack::at(double time) noexcept {
  deadreckon::KinematicState state;
  time = wrapped(time * speed_, end_, repeat_);
  if (time >= piece_.begin && time < piece_.end) {
    state = piece_.at(time);
  } else if (curve_ != nullptr && time < end_) {
    piece_ = curve_->piece_at(time);
    state = piece_.at(time);
  } else if (curve_ != nullptr) {
    state = curve_->at(time);
  }
  state.position += offset_;
  if (!turns_) state.orientation = orientation_;
  state.velocity *= speed_;
  state.acceleration *= speed_ * speed_;
  state.angular_velocity *= speed_;
  return state;
}

}  // namespace reckon::peer
