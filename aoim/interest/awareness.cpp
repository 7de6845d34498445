// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/awareness.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace reckon::aoim {
namespace {

double distance_to_box(const AwarenessFocus& focus, const Position& point) noexcept {
  const Position out{std::max(0.0, std::abs(point.x - focus.position.x) - focus.half_sides.x),
                     std::max(0.0, std::abs(point.y - focus.position.y) - focus.half_sides.y),
                     std::max(0.0, std::abs(point.z - focus.position.z) - focus.half_sides.z)};
  return distance(out, {});
}

// In the plane through the axis and the point, with coordinates `along` and `across` the axis.
double distance_to_cone(const AwarenessFocus& focus, const Position& point) noexcept {
  const Position& at = focus.position;
  const double x = point.x - at.x, y = point.y - at.y, z = point.z - at.z;
  const double along = x * focus.axis.x + y * focus.axis.y + z * focus.axis.z;
  const double squared = x * x + y * y + z * z;
  const double across = std::sqrt(std::max(0.0, squared - along * along));
  const double cosine = std::cos(focus.half_angle), sine = std::sin(focus.half_angle);
  // Rotated so that the edge of the cone is the first axis: below it is inside.
  const double on_edge = along * cosine + across * sine;
  const double off_edge = across * cosine - along * sine;
  if (off_edge <= 0.0) return std::max(0.0, std::sqrt(squared) - focus.radius);
  const double beyond = on_edge - std::clamp(on_edge, 0.0, focus.radius);
  return std::sqrt(off_edge * off_edge + beyond * beyond);
}

bool is_inside(const Occluders::Box& box, const Position& p) noexcept {
  return box.lower.x < p.x && p.x < box.upper.x && box.lower.y < p.y && p.y < box.upper.y &&
         box.lower.z < p.z && p.z < box.upper.z;
}

// The part of the line, 0 .. 1, between two planes; an empty part has begin >= end.
struct LinePart {
  double begin = 0.0, end = 1.0;

  void cut(double from, double to, double lower, double upper) noexcept {
    const double step = to - from;
    if (step == 0.0) {
      if (from <= lower || from >= upper) end = begin;
      return;
    }
    const double a = (lower - from) / step, b = (upper - from) / step;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
};

bool crosses(const Occluders::Box& box, const Position& from, const Position& to) noexcept {
  LinePart part;
  part.cut(from.x, to.x, box.lower.x, box.upper.x);
  part.cut(from.y, to.y, box.lower.y, box.upper.y);
  part.cut(from.z, to.z, box.lower.z, box.upper.z);
  return part.begin < part.end;
}

}  // namespace

double distance_to(const AwarenessFocus& focus, const Position& point) noexcept {
  switch (focus.shape) {
    case AwarenessFocus::Shape::box:
      return distance_to_box(focus, point);
    case AwarenessFocus::Shape::cone:
      return distance_to_cone(focus, point);
    case AwarenessFocus::Shape::ball:
      break;
  }
  return std::max(0.0, distance(focus.position, point) - focus.radius);
}

Occluders::Occluders(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const auto& [lower, upper] = boxes_[i];
    const bool solid = is_finite(lower) && is_finite(upper) && lower.x < upper.x &&
                       lower.y < upper.y && lower.z < upper.z;
    if (!solid) {
      throw std::invalid_argument("occluder " + std::to_string(i) +
                                  ": lower must be finite and below upper on each axis");
    }
  }
}

bool Occluders::hides(const Position& from, const Position& to) const noexcept {
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
    return crosses(box, from, to) && !is_inside(box, from) && !is_inside(box, to);
  });
}

Awareness AwarenessEvaluator::answer(const Observer& observer,
                                     const Subject& subject) const noexcept {
  const AwarenessFocus& focus = observer.focus;
  if (!is_finite(focus.position) || !is_finite(subject.position) || !std::isfinite(focus.radius) ||
      !std::isfinite(subject.nimbus)) {
    return Awareness::not_finite;
  }
  const bool wanted = subject.kind >= 32 || (observer.kinds >> subject.kind & 1U) != 0;
  if (!wanted || (observer.roles & subject.roles) == 0) return Awareness::class_off;

  const double apart = distance(focus.position, subject.position);
  if (!(apart <= observer.aura + subject.aura)) return Awareness::auras_apart;
  if (!(distance_to(focus, subject.position) <= subject.nimbus)) return Awareness::out_of_focus;
  const bool hidden = occluders_ != nullptr && occluders_->hides(focus.position, subject.position);
  return hidden ? Awareness::occluded : Awareness::aware;
}

Awareness AwarenessEvaluator::evaluate(const Observer& observer, const Subject& subject) noexcept {
  const Awareness result = answer(observer, subject);
  ++counts_[static_cast<std::size_t>(result)];
  return result;
}

}  // namespace reckon::aoim
