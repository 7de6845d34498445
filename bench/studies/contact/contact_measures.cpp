// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/contact/contact_measures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "reckon/bench/statistics/quantile.hpp"

namespace reckon::bench {
namespace {

using Eigen::Vector3d;

constexpr double kServoPeriod = 1e-3;      // [s]
constexpr std::size_t kFirstTouch = 1000;  // steps

/// Force of one hand on another in a step [N], along the line between them.
struct Pair {
  double felt = 0, wanted = 0;
};

Pair pair_at(const ContactRecord& record, const ContactTruth& truth, std::size_t step,
             std::size_t hand, std::size_t other) {
  const Vector3d between = record.position(step, hand) - record.position(step, other);
  const double distance = between.norm();
  const Vector3d normal = distance > 0 ? Vector3d(between / distance) : Vector3d::UnitZ();
  return {normal.dot(record.force(step, hand, other)),
          truth.stiffness * std::max(0.0, truth.reach - distance)};
}

/// Visits every ordered pair of hands, in every step.
template <typename Visit>
void each_pair(const ContactRecord& record, Visit&& visit) {
  for (std::size_t step = 0; step < record.steps(); ++step)
    for (std::size_t hand = 0; hand < record.hands; ++hand)
      for (std::size_t other = 0; other < record.hands; ++other)
        if (other != hand) visit(step, hand, other);
}

double largest(const ContactRecord& record, std::size_t from, std::size_t to) {
  double most = 0;
  const std::size_t pairs = record.hands * record.hands;
  for (std::size_t i = from * pairs; i < std::min(to, record.steps()) * pairs; ++i)
    most = std::max(most, record.forces[i].norm());
  return most;
}

}  // namespace

ForceError error_size(std::vector<double> errors, std::span<const double> wanted) {
  ForceError size;
  size.samples = errors.size();
  if (errors.empty()) return size;
  double squares = 0, wanted_squares = 0;
  std::size_t noticed = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    squares += errors[i] * errors[i];
    wanted_squares += wanted[i] * wanted[i];
    noticed += errors[i] > std::max(kLeastFelt, kWeberShare * wanted[i]);
  }
  const auto count = static_cast<double>(errors.size());
  size.rms = std::sqrt(squares / count);
  if (wanted_squares > 0) size.share = std::sqrt(squares / wanted_squares);
  size.noticed = static_cast<double>(noticed) / count;
  size.p50 = quantile(errors, 0.5);
  size.p99 = quantile(errors, 0.99);
  size.max = *std::max_element(errors.begin(), errors.end());
  return size;
}

ForceError error_at_instant(const ContactRecord& record, const ContactTruth& truth) {
  std::vector<double> errors, wanted;
  each_pair(record, [&](std::size_t step, std::size_t hand, std::size_t other) {
    const Pair pair = pair_at(record, truth, step, hand, other);
    if (pair.wanted == 0 && record.force(step, hand, other).isZero()) return;
    errors.push_back(std::abs(pair.felt - pair.wanted));
    wanted.push_back(pair.wanted);
  });
  return error_size(std::move(errors), wanted);
}

double error_of_twin(const ContactRecord& record, const ContactRecord& twin) {
  double squares = 0;
  std::size_t samples = 0;
  each_pair(record, [&](std::size_t step, std::size_t hand, std::size_t other) {
    if (step >= twin.steps()) return;
    const Vector3d &felt = record.force(step, hand, other), &wanted = twin.force(step, hand, other);
    if (felt.isZero() && wanted.isZero()) return;
    squares += (felt - wanted).squaredNorm();
    ++samples;
  });
  return samples > 0 ? std::sqrt(squares / static_cast<double>(samples)) : 0;
}

std::optional<double> first_peak(const ContactRecord& record, const ContactRecord& twin) {
  for (std::size_t step = 0; step < twin.steps(); ++step) {
    if (largest(twin, step, step + 1) == 0) continue;
    return largest(record, step, step + kFirstTouch) / largest(twin, step, step + kFirstTouch);
  }
  return std::nullopt;
}

std::optional<std::array<Response, 2>> stroke_response(const ContactRecord& record,
                                                       const ContactTruth& truth, double frequency,
                                                       std::size_t from, std::size_t to) {
  if (!(frequency > 0) || to > record.steps() || record.hands < 2) return std::nullopt;
  std::array<Response, 2> responses;
  for (std::size_t hand = 0; hand < 2; ++hand) {
    std::complex<double> felt, wanted;
    for (std::size_t step = from; step < to; ++step) {
      const Pair pair = pair_at(record, truth, step, hand, 1 - hand);
      const double angle =
          2 * std::numbers::pi * frequency * kServoPeriod * static_cast<double>(step);
      felt += pair.felt * std::polar(1.0, -angle);
      wanted += pair.wanted * std::polar(1.0, -angle);
    }
    if (std::abs(wanted) == 0) return std::nullopt;
    responses[hand] = {std::abs(felt / wanted), std::arg(felt / wanted)};
  }
  return responses;
}

double linger(const ContactRecord& record, const ContactTruth& truth) {
  constexpr std::size_t kOver = 0;  // 0: over; otherwise the last step of a contact, plus one
  std::vector<std::size_t> touched(record.hands * record.hands, kOver);
  std::size_t longest = 0;
  each_pair(record, [&](std::size_t step, std::size_t hand, std::size_t other) {
    std::size_t& last = touched[hand * record.hands + other];
    if (pair_at(record, truth, step, hand, other).wanted > 0)
      last = step + 1;
    else if (record.force(step, hand, other).norm() < kLeastFelt)
      last = kOver;
    else if (last != kOver)
      longest = std::max(longest, step + 1 - last);
  });
  return static_cast<double>(longest) * kServoPeriod;
}

}  // namespace reckon::bench
