// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/pair_queue.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostInQueue = 4096;
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kMostTangents = 8;
// Share by which a time is early, so that rounding cannot make it late.
constexpr double kEarly = 1e-12;

// Greatest distance of a body from its straight path, `age` after its report [m].
double stray(const BodyMotion& body, double age) {
  const double bent = 0.5 * body.most_acceleration * age * age;
  const double straight = (body.most_speed + body.velocity.norm()) * age;
  return age > 0.0 ? std::min(bent, straight) : 0.0;
}

// The least t > 0 with gap - speed t - acceleration t^2 / 2 = 0; speed may be negative.
double first_root(double gap, double speed, double acceleration) {
  if (!(acceleration > 0.0)) return speed > 0.0 ? gap / speed : kNever;
  const double root = std::sqrt(speed * speed + 2.0 * acceleration * gap);
  return speed >= 0.0 ? 2.0 * gap / (speed + root) : (root - speed) / acceleration;
}

}  // namespace

// A distance is at least its projection on a direction, so the motion along the line between the
// centers gives a one-dimensional bound: it falls as a parabola, or with the greatest speeds as a
// line. The next bound starts at its root.
double earliest_contact(const BodyMotion& a, const BodyMotion& b, double now) noexcept {
  const Vector3d velocity = b.velocity - a.velocity;
  const double reach = a.radius + b.radius;
  double time = now;
  for (int i = 0; i < kMostTangents; ++i) {
    const double age_a = time - a.time, age_b = time - b.time;
    const Vector3d between = (b.position + age_b * b.velocity) - (a.position + age_a * a.velocity);
    const double distance = between.norm();
    const double gap = distance - reach - stray(a, age_a) - stray(b, age_b);
    if (!(gap > kEarly * (distance + reach))) return time;
    // The deviation from the straight paths grows by up to a age t + a t^2 / 2.
    const double closing = -velocity.dot(between) / distance +
                           a.most_acceleration * std::max(0.0, age_a) +
                           b.most_acceleration * std::max(0.0, age_b);
    const double bent = first_root(gap, closing, a.most_acceleration + b.most_acceleration);
    const double straight = gap / (a.most_speed + b.most_speed);
    const double way = std::max(bent, straight);
    if (way == kNever) return kNever;
    const double next = time + way * (1.0 - kEarly);
    if (!(next > time)) return time;
    time = next;
  }
  return time;
}

PairQueue::PairQueue(std::size_t bodies) : motions_(bodies), present_(bodies, false) {
  if (bodies > kMostInQueue)
    throw std::invalid_argument("a pair queue holds at most 4096 bodies: use CellGrid");
  for (std::uint32_t high = 1; high < bodies; ++high)
    for (std::uint32_t low = 0; low < high; ++low) bodies_of_.push_back({low, high});
  places_.resize(bodies_of_.size());
  for (std::uint32_t pair = 0; pair < bodies_of_.size(); ++pair) {
    heap_.push_back({kNever, pair});
    places_[pair] = pair;
  }
  due_.reserve(bodies_of_.size());
}

void PairQueue::report(std::uint32_t body, const BodyMotion& motion, double now) noexcept {
  motions_[body] = motion;
  present_[body] = true;
  for (std::uint32_t other = 0; other < motions_.size(); ++other) {
    if (other == body || !present_[other]) continue;
    ++tests_;
    set_time(number_of(std::min(body, other), std::max(body, other)),
             earliest_contact(motion, motions_[other], now));
  }
}

void PairQueue::remove(std::uint32_t body) noexcept {
  present_[body] = false;
  for (std::uint32_t other = 0; other < motions_.size(); ++other)
    if (other != body) set_time(number_of(std::min(body, other), std::max(body, other)), kNever);
}

// A checked pair stays in the heap: it gets a later time, or one just after this call if it is due
// again with the next.
std::span<const BoxPair> PairQueue::due(double now) noexcept {
  due_.clear();
  while (!heap_.empty() && heap_.front().time <= now) {
    const std::uint32_t pair = heap_.front().pair;
    const BoxPair& bodies = bodies_of_[pair];
    ++tests_;
    double time = earliest_contact(motions_[bodies.first], motions_[bodies.second], now);
    if (time <= now) {
      due_.push_back(bodies);
      time = std::nextafter(now, kNever);
    }
    set_time(pair, time);
  }
  return due_;
}

double PairQueue::next_due() const noexcept { return heap_.empty() ? kNever : heap_.front().time; }

void PairQueue::set_time(std::uint32_t pair, double time) noexcept {
  const std::size_t place = places_[pair];
  heap_[place].time = time;
  settle(place);
}

void PairQueue::put(std::size_t place, const Entry& entry) noexcept {
  heap_[place] = entry;
  places_[entry.pair] = static_cast<std::uint32_t>(place);
}

// Moves an entry up or down the heap. Equal times are ordered by pair, so the order does not depend
// on the history.
void PairQueue::settle(std::size_t place) noexcept {
  const auto earlier = [](const Entry& one, const Entry& other) {
    return one.time != other.time ? one.time < other.time : one.pair < other.pair;
  };
  const Entry entry = heap_[place];
  while (place > 0 && earlier(entry, heap_[(place - 1) / 2])) {
    put(place, heap_[(place - 1) / 2]);
    place = (place - 1) / 2;
  }
  for (std::size_t child = 2 * place + 1; child < heap_.size(); child = 2 * place + 1) {
    if (child + 1 < heap_.size() && earlier(heap_[child + 1], heap_[child])) ++child;
    if (!earlier(heap_[child], entry)) break;
    put(place, heap_[child]);
    place = child;
  }
  put(place, entry);
}

}  // namespace reckon::haptics
