// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/articulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/entity/variable_parameter.hpp"

namespace reckon::deadreckon {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::uint32_t kMetricBits = 5;
constexpr std::uint32_t kMetrics = 1U << kMetricBits;
constexpr auto kLastMetric = static_cast<std::uint32_t>(PartMetric::rotation);

// Wraps to (-pi, pi].
double wrapped(double angle) {
  const double rest = std::remainder(angle, kTurn);
  return rest <= -std::numbers::pi ? rest + kTurn : rest;
}

double in_range(PartMetric metric, double value) {
  return is_angle(metric) ? wrapped(value) : value;
}

double threshold(PartMetric metric, const PartThresholds& thresholds) {
  if (is_angle(metric)) return thresholds.angle;
  return metric == PartMetric::position ? thresholds.share : thresholds.length;
}

bool changed(const PartParameter& a, const PartParameter& b) {
  return a.value != b.value || a.rate != b.rate || a.attached_to != b.attached_to;
}

std::uint8_t counted_on(std::uint8_t change) {
  return change == 255 ? std::uint8_t{1} : static_cast<std::uint8_t>(change + 1);
}

// One record of an articulated part: its part, and whether it is a value or a rate.
struct WirePart {
  PartParameter place;
  bool is_rate;
  bool is_known;
  double number;
};

std::optional<WirePart> load(std::span<const std::byte> record) {
  pdu::ArticulatedPart wire;
  if (!pdu::load_record(record, wire) || wire.record_type != pdu::ArticulatedPart::kType)
    return std::nullopt;
  const std::uint32_t metric = wire.parameter_type % kMetrics;
  const bool known = metric >= 1 && metric <= kLastMetric + 1;
  WirePart part{{}, metric % 2 == 0, known, static_cast<double>(wire.parameter_value)};
  part.place.part = wire.parameter_type >> kMetricBits;
  part.place.attached_to = wire.part_attached_to;
  part.place.change = wire.change_indicator;
  part.place.metric = static_cast<PartMetric>(metric - (part.is_rate ? 1 : 0));
  return part;
}

void for_each_part(std::span<const std::byte> records, auto&& take) {
  for (; records.size() >= pdu::kVariableParameterSize;
       records = records.subspan(pdu::kVariableParameterSize)) {
    if (const std::optional<WirePart> part = load(records)) take(*part);
  }
}

std::size_t store(const PartParameter& p, bool is_rate, std::span<std::byte> out) {
  pdu::ArticulatedPart wire;
  wire.change_indicator = p.change;
  wire.part_attached_to = p.attached_to;
  const auto metric = static_cast<std::uint32_t>(p.metric) + (is_rate ? 1U : 0U);
  wire.parameter_type = (p.part << kMetricBits) | metric;
  wire.parameter_value = static_cast<float>(is_rate ? p.rate : p.value);
  return pdu::store_record(wire, out);
}

}  // namespace

PartParameter* PartState::slot(const PartParameter& like) noexcept {
  for (PartParameter& known : std::span(parameters_).first(size_))
    if (same_place(known, like)) return &known;
  if (size_ == kCapacity) return nullptr;
  parameters_[size_] = {};
  return &parameters_[size_++];
}

const PartParameter* PartState::find(std::uint32_t part, PartMetric metric) const noexcept {
  for (const PartParameter& known : parameters())
    if (known.part == part && known.metric == metric) return &known;
  return nullptr;
}

bool PartState::set(const PartParameter& parameter) noexcept {
  if (!std::isfinite(parameter.value) || !std::isfinite(parameter.rate)) return false;
  const PartParameter* before = find(parameter.part, parameter.metric);
  PartParameter next = parameter;
  next.value = in_range(next.metric, next.value);
  next.change = before == nullptr        ? std::uint8_t{0}
                : changed(*before, next) ? counted_on(before->change)
                                         : before->change;
  PartParameter* place = slot(next);
  if (place == nullptr) return false;
  *place = next;
  return true;
}

void PartState::remove(std::uint32_t part, PartMetric metric) noexcept {
  const auto end = parameters_.begin() + static_cast<std::ptrdiff_t>(size_);
  const auto kept = std::remove_if(parameters_.begin(), end, [&](const PartParameter& p) {
    return p.part == part && p.metric == metric;
  });
  size_ = static_cast<std::size_t>(kept - parameters_.begin());
}

// Stores values first, then the rates for them: the wire may have them in any order.
struct PartReader {
  PartState& out;
  PartReading& reading;

  bool is_good(const WirePart& part) const noexcept {
    if (!part.is_known) {
      ++reading.unknown;
    } else if (!std::isfinite(part.number)) {
      ++reading.not_finite;
    } else {
      return true;
    }
    return false;
  }
  void take_value(const WirePart& part) const noexcept {
    if (part.is_rate || !is_good(part)) return;
    PartParameter* place = out.slot(part.place);
    if (place == nullptr) {
      ++reading.no_room;
      return;
    }
    *place = part.place;
    place->value = in_range(part.place.metric, part.number);
    ++reading.taken;
  }
  void take_rate(const WirePart& part) const noexcept {
    if (!part.is_rate || !is_good(part)) return;
    if (out.find(part.place.part, part.place.metric) == nullptr) {
      ++reading.no_value;
      return;
    }
    out.slot(part.place)->rate = part.number;
    ++reading.taken;
  }
};

PartReading from_wire(std::span<const std::byte> records, PartState& out) noexcept {
  PartReading reading;
  out.clear();
  const PartReader reader{out, reading};
  for_each_part(records, [&](const WirePart& part) { reader.take_value(part); });
  for_each_part(records, [&](const WirePart& part) { reader.take_rate(part); });
  return reading;
}

std::size_t wire_size(const PartState& state) noexcept {
  return 2 * pdu::kVariableParameterSize * state.parameters().size();
}

std::size_t to_wire(const PartState& state, std::span<std::byte> out) noexcept {
  if (out.size() < wire_size(state)) return 0;
  std::size_t written = 0;
  for (const PartParameter& p : state.parameters()) {
    written += store(p, false, out.subspan(written));
    written += store(p, true, out.subspan(written));
  }
  return written;
}

PartMotion predict(const PartParameter& parameter, double tau, double longest) noexcept {
  const double asked = bounded_tau(tau);
  const double t = std::min(std::max(asked, -longest), longest);
  return {in_range(parameter.metric, parameter.value + parameter.rate * t),
          t == asked ? parameter.rate : 0.0};
}

double difference(PartMetric metric, double a, double b) noexcept {
  return in_range(metric, a - b);
}

bool should_send(const PartState& truth, const PartState& sent, double since,
                 const PartThresholds& thresholds, double longest) noexcept {
  if (truth.parameters().size() != sent.parameters().size()) return true;
  for (const PartParameter& is : truth.parameters()) {
    const PartParameter* last = sent.find(is.part, is.metric);
    if (last == nullptr || last->attached_to != is.attached_to) return true;
    const double off = difference(is.metric, is.value, predict(*last, since, longest).value);
    // Negated, so that NaN is sent too.
    if (!(std::abs(off) <= threshold(is.metric, thresholds))) return true;
  }
  return false;
}

double PartConvergence::gentle_duration(PartMetric metric, double off) const noexcept {
  const double gentle = is_angle(metric) ? settings_.gentle_turn : settings_.gentle_speed;
  return std::max(settings_.duration, std::min(1.5 * std::abs(off) / gentle, settings_.longest));
}

PartConvergence::Error PartConvergence::error_for(const PartParameter& next, double time,
                                                  double now, double longest) const noexcept {
  const PartParameter* before = state_.find(next.part, next.metric);
  if (before == nullptr || before->attached_to != next.attached_to) return {};
  const auto i = static_cast<std::size_t>(before - state_.parameters().data());
  const PartMotion seen = shown(i, now), predicted = predict(next, now - time, longest);
  const PartMotion off{difference(next.metric, seen.value, predicted.value),
                       seen.rate - predicted.rate};
  if (!(std::isfinite(off.rate) && std::abs(off.value) <= settings_.teleport_distance)) return {};
  return {off, gentle_duration(next.metric, off.value)};
}

void PartConvergence::update(const PartState& state, double time, double now,
                             double longest) noexcept {
  std::array<Error, PartState::kCapacity> errors{};
  const std::span<const PartParameter> parameters = state.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    errors[i] = error_for(parameters[i], time, now, longest);
  errors_ = errors;
  state_ = state;
  time_ = time;
  start_ = now;
  longest_ = longest;
}

PartMotion PartConvergence::shown(std::size_t i, double now) const noexcept {
  const PartParameter& parameter = state_.parameters()[i];
  const PartMotion predicted = predict(parameter, now - time_, longest_);
  const auto& [off, duration] = errors_[i];
  if (!(duration > 0)) return predicted;
  const ConvergenceWeights w = convergence_weights(settings_.curve, now - start_, duration);
  return {in_range(parameter.metric, predicted.value + w.error * off.value + w.rate * off.rate),
          predicted.rate + w.error_rate * off.value + w.rate_rate * off.rate};
}

}  // namespace reckon::deadreckon
