// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/measurement/device_measurement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

constexpr double kRest = 0.2;        // [s] of rest before a push
constexpr double kPatience = 6.0;    // [s] allowed to come to rest
constexpr double kStill = 0.002;     // [m/s]
constexpr double kFirstPush = 0.05;  // [N]
constexpr double kGrows = 1.3;       // factor from push to push
constexpr double kTells =
    1.4;  // force of recorded pushes / force of the first push that moves kWay
constexpr double kCoast = 0.4;        // [s], recorded after a push
constexpr double kSpeedOver = 0.005;  // [s], interval of a speed
constexpr double kGains = 1.3;   // times the speed after the push: no passive handle gains so much
constexpr double kMoves = 0.02;  // [m/s], least speed for that check
constexpr int kRecorded = 8;     // recorded pushes of an axis
constexpr std::array<double, 3> kLengths{0.04, 0.05, 0.06};  // [s], of a quarter of a push

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// The step of which nearly all moves are multiples; 0: none.
double step_of(const std::vector<double>& moves) {
  constexpr double kLeast = 1e-7;  // [m]
  double least = 0.0;
  for (const double move : moves) {
    const double size = std::abs(move);
    if (size > 1e-10 && (least == 0.0 || size < least)) least = size;
  }
  if (least < kLeast) return 0.0;
  const auto off = std::ranges::count_if(moves, [&](double move) {
    const double steps = std::abs(move) / least;
    return std::abs(steps - std::round(steps)) > 0.05;
  });
  return off * 50 < static_cast<std::ptrdiff_t>(moves.size()) ? least : 0.0;
}

}  // namespace

DeviceMeasurement::DeviceMeasurement(const DeviceLimits& limits, std::chrono::nanoseconds period,
                                     Axes axes)
    : period_(pdu::to_seconds(period)),
      delay_(static_cast<std::size_t>(std::max(0, limits.delay_samples))),
      axes_(axes),
      greatest_(std::min(kMostPush, 0.4 * limits.max_force)),
      axis_(axis_from(0)),
      amplitude_(std::min(kFirstPush, greatest_)) {}

// The first axis of the device from `axis` on; 3: none.
int DeviceMeasurement::axis_from(int axis) const noexcept {
  while (axis < 3 && !axes_[static_cast<std::size_t>(axis)]) ++axis;
  return axis;
}

void DeviceMeasurement::end(MeasurementProblem problem) noexcept {
  problem_ = problem;
  phase_ = Phase::done;
}

Eigen::Vector3d DeviceMeasurement::step(const DeviceSample& sample, std::chrono::nanoseconds now,
                                        std::optional<std::chrono::nanoseconds> heard) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  if (is_done() || needs_judging()) return force;
  heard_gap_ = heard && heard_ ? pdu::to_seconds(*heard - *heard_) : 0.0;
  heard_ = heard;
  if (!is_punctual(now) || !is_safe(sample)) return force;
  if (!sample.ok || (sample.watchdog && phase_ == Phase::push)) {
    begin_anew();
    return force;
  }
  if (phase_ == Phase::rest) {
    rest(sample.position(axis_));
  } else {
    force(axis_) = push(sample);
  }
  if (is_done() || needs_judging()) return Eigen::Vector3d::Zero();
  most_push_ = std::max(most_push_, force.norm());
  return force;
}

// A failed reading leaves a gap in the record, so the push is repeated.
void DeviceMeasurement::begin_anew() {
  if (phase_ == Phase::push && ++holes_ > kMostHoles) return end(MeasurementProblem::readings);
  now_ = {};
  at_rest_.clear();
  phase_ = Phase::rest;
}

// A force that is held too long moves the handle farther than intended.
bool DeviceMeasurement::is_punctual(std::chrono::nanoseconds now) {
  constexpr std::size_t kTold = 1'000;  // least number of steps for a share
  gap_ = last_ ? pdu::to_seconds(now - *last_) : period_;
  last_ = now;
  if (phase_ != Phase::push) return true;
  ++in_push_;
  if (gap_ > 1.5 * period_) ++late_;
  const double most = kMostLate * static_cast<double>(std::max(in_push_, kTold));
  if (gap_ > kMostGap || static_cast<double>(late_) > most) end(MeasurementProblem::busy);
  return !is_done();
}

bool DeviceMeasurement::is_safe(const DeviceSample& sample) {
  failed_ = sample.ok ? 0 : failed_ + 1;
  if (failed_ > kMostFailed) end(MeasurementProblem::readings);
  if (!sample.ok) return !is_done();
  if (!sample.position.allFinite()) end(MeasurementProblem::readings);
  if (!sample.enabled) end(MeasurementProblem::switch_off);
  if (is_done()) return false;
  const double place = sample.position(axis_);
  if (!has_start_) start_ = place;
  has_start_ = true;
  const std::vector<double>& seen = phase_ == Phase::push ? now_.places : at_rest_;
  const std::size_t over =
      std::min(seen.size(), static_cast<std::size_t>(std::lround(kSpeedOver / period_)));
  const double way = over > 0 ? place - seen[seen.size() - over] : 0.0;
  if (std::abs(way) > kMostSpeed * kSpeedOver) end(MeasurementProblem::speed);
  if (is_done()) return false;
  if (std::abs(place - start_) > kMostWay) end(MeasurementProblem::place);
  return !is_done();
}

void DeviceMeasurement::rest(double place) {
  at_rest_.push_back(place);
  const auto needed = static_cast<std::size_t>(std::lround(kRest / period_));
  if (at_rest_.size() < needed) return;
  const auto last = at_rest_.end() - static_cast<std::ptrdiff_t>(needed);
  const auto [least, most] = std::minmax_element(last, at_rest_.end());
  if (*most - *least > kStill * kRest) {
    if (static_cast<double>(at_rest_.size()) * period_ > kPatience)
      end(MeasurementProblem::restless);
    return;
  }
  const std::vector<double> still(last, at_rest_.end());
  const double mean = mean_of(still);
  for (const double one : still) rests_.push_back(one - mean);
  begin_push();
  // Without dry friction a handle creeps for long.
  now_.creeps = *most > *least;
}

void DeviceMeasurement::begin_push() {
  phase_ = Phase::push;
  now_ = {};
  took_.clear();
  at_rest_.clear();
}

// Forward, backward for twice as long, and forward: a mass without friction is then at rest where
// it started.
double DeviceMeasurement::force_at(std::size_t k) const noexcept {
  const double quarter = kLengths[static_cast<std::size_t>(pushes_) % kLengths.size()];
  const double time = static_cast<double>(k) * period_;
  const double sign = pushes_ % 2 == 0 ? 1.0 : -1.0;
  if (time >= 4 * quarter) return 0.0;
  return time < quarter || time >= 3 * quarter ? sign * amplitude_ : -sign * amplitude_;
}

// Time of the motion to a reading [s].
double DeviceMeasurement::way_time(const DeviceSample& sample) const noexcept {
  if (sample.took) return pdu::to_seconds(*sample.took);
  return heard_ ? heard_gap_ : gap_;
}

double DeviceMeasurement::push(const DeviceSample& sample) {
  const double place = sample.position(axis_);
  took_.push_back(way_time(sample));
  const std::size_t k = now_.places.size();
  const double force = force_at(k);
  if (k > 0) moves_.push_back(place - now_.places.back());
  now_.places.push_back(place);
  now_.forces.push_back(force);
  const double quarter = kLengths[static_cast<std::size_t>(pushes_) % kLengths.size()];
  const double end = 4 * quarter + 2 * kLongestDelay;
  const double time = static_cast<double>(k) * period_;
  // After the last delayed force, a passive handle can only slow down.
  const auto over = static_cast<std::size_t>(std::lround(4 * kSpeedOver / period_));
  const auto after = static_cast<std::size_t>(std::lround(end / period_));
  if (k > after + 2 * over) {
    const auto& p = now_.places;
    const double first = std::abs(p[after + over] - p[after]);
    const double latest = std::abs(p[k] - p[k - over]);
    const double least = kMoves * static_cast<double>(over) * period_;
    if (latest > kGains * std::max(first, least)) this->end(MeasurementProblem::active);
  }
  if (time > end + kCoast) end_push();
  return force;
}

void DeviceMeasurement::end_push() {
  const auto [least, most] = std::minmax_element(now_.places.begin(), now_.places.end());
  const double way = *most - *least;
  phase_ = Phase::rest;
  ++pushes_;
  if (recording_) {
    record_.push_back(recorded());
    if (record_.size() == kRecorded) phase_ = Phase::judge;
    return;
  }
  if (way >= kWay) {
    recording_ = true;
    amplitude_ = std::min(greatest_, kTells * amplitude_);
  } else if (amplitude_ >= greatest_) {
    end(MeasurementProblem::stuck);
  } else {
    amplitude_ = std::min(greatest_, kGrows * amplitude_);
  }
}

// The present push, with times. The motion from read k to the next was under the force of write k -
// delay, however late they were.
AxisPush DeviceMeasurement::recorded() const {
  AxisPush push = now_;
  const std::size_t last = push.places.size() - 1;
  double time = 0.0;
  for (std::size_t k = 0; k <= last; ++k) push.reads.push_back(time += k > 0 ? took_[k] : 0.0);
  for (std::size_t k = 0; k <= last; ++k) {
    const std::size_t read = std::min(k + delay_, last);
    push.writes.push_back(push.reads[read] - static_cast<double>(read - k) * period_);
  }
  return push;
}

void DeviceMeasurement::judge() {
  const AxisFit fit = fit_axis(record_, period_, 2.2 * kLongestDelay);
  if (fit.model.damping < 0) return end(MeasurementProblem::active);
  if (fit.model.delay > kLongestDelay) return end(MeasurementProblem::late);
  const double fine = std::max(step_of(moves_), 1e-5);
  if (fit.residual > 0.02 * kWay + fine) return end(MeasurementProblem::unlike);
  fits_.push_back(fit);
  record_.clear();
  at_rest_.clear();
  failed_ = 0;
  recording_ = has_start_ = false;
  amplitude_ = std::min(kFirstPush, greatest_);
  axis_ = axis_from(axis_ + 1);
  if (axis_ == 3) return conclude();
  phase_ = Phase::rest;
}

void DeviceMeasurement::conclude() {
  MeasuredDevice found;
  const auto least =
      std::ranges::min_element(fits_, {}, [](const AxisFit& fit) { return fit.model.damping; });
  found.damping = least->model.damping;
  found.damping_error = least->damping_error;
  for (const AxisFit& fit : fits_) {
    found.friction = std::max(found.friction, fit.model.friction);
    found.delay = std::max(found.delay, fit.model.delay);
    found.mass += fit.model.mass / static_cast<double>(fits_.size());
    found.residual = std::max(found.residual, fit.residual);
  }
  found.resolution = step_of(moves_);
  double squares = 0.0;
  for (const double one : rests_) squares += one * one;
  found.noise = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, rests_.size())));
  result_ = found;
  end(MeasurementProblem::none);
}

}  // namespace reckon::haptics
