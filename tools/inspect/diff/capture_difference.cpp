// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/diff/capture_difference.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
using std::chrono::nanoseconds;

namespace {

/// Field name without indices: "variable_parameters[2].value" becomes
/// "variable_parameters[].value".
std::string without_indices(std::string_view path) {
  std::string name;
  bool inside = false;
  for (const char letter : path) {
    if (letter == ']') inside = false;
    if (!inside) name += letter;
    if (letter == '[') inside = true;
  }
  return name;
}

void note_state(EntityTraits& traits, const HeldPdu& held) {
  if (!held.decoded || held.header.pdu_type != pdu::PduType::entity_state) return;
  pdu::EntityState state;
  if (decode(held.octets, state) != pdu::DecodeError::none) return;
  traits.has_state = true;
  traits.marking = std::string(state.marking.view());
  traits.force = static_cast<std::uint8_t>(state.force_id);
  const auto algorithm = static_cast<std::uint32_t>(state.dead_reckoning.algorithm);
  traits.algorithms |= std::uint32_t{1} << std::min<std::uint32_t>(algorithm, 31);
}

}  // namespace

nanoseconds PairedTimes::in_a(nanoseconds time_b) const {
  return a + nanoseconds(std::llround(rate * static_cast<double>((time_b - b).count())));
}

std::optional<PairedTimes> CaptureDifference::other_rate() const {
  constexpr double kOtherRate = 0.01;
  constexpr double kLeastChange = 0.05;  // [s]
  const std::uint64_t pairs = same_ + changed_;
  if (pairs < 2 || 2 * pairs < std::max(a_.all.pdus, b_.all.pdus)) return std::nullopt;
  const double in_a = pdu::to_seconds(last_pair_->a - first_pair_->a);
  const double in_b = pdu::to_seconds(last_pair_->b - first_pair_->b);
  if (in_a <= 0 || in_b <= 0 || std::abs(in_a - in_b) < kLeastChange) return std::nullopt;
  if (std::abs(in_a / in_b - 1) < kOtherRate) return std::nullopt;
  return PairedTimes{first_pair_->a, first_pair_->b, in_a / in_b};
}

void CaptureSurvey::add(const HeldPdu& pdu) {
  if (all.pdus == 0) first = last = pdu.time;
  first = std::min(first, pdu.time);
  last = std::max(last, pdu.time);
  datagrams += pdu.ends_datagram ? 1 : 0;
  const auto count = [&](CaptureShare& share) {
    ++share.pdus;
    share.octets += pdu.octets.size();
  };
  count(all);
  count(types[pdu.type()]);
  if (!pdu.id.has_value()) return;
  const std::array<std::uint16_t, 3> key{pdu.id->site, pdu.id->application, pdu.id->entity};
  if (!entities.contains(key) && entities.size() == kMostEntities) return;
  EntityTraits& traits = entities[key];
  count(traits.share);
  note_state(traits, pdu);
}

double CaptureSurvey::seconds() const { return pdu::to_seconds(last - first); }

PduPlace CaptureDifference::place_of(const HeldPdu& pdu) const {
  return {order_, pdu.frame, pdu.pdu, pdu.offset, pdu.time, pdu.type(), pdu.id};
}

void CaptureDifference::add(const AlignedPdus& step) {
  using Kind = AlignedPdus::Kind;
  if (step.kind != Kind::only_b) a_.add(step.a);
  if (step.kind != Kind::only_a) b_.add(step.b);
  switch (step.kind) {
    case Kind::same:
      ++same_;
      compare_times(step.a, step.b);
      break;
    case Kind::changed:
      compare_times(step.a, step.b);
      take_changed(step.a, step.b);
      break;
    case Kind::only_a:
      take_alone(step.a, true);
      break;
    case Kind::only_b:
      take_alone(step.b, false);
      break;
  }
  ++order_;
}

void CaptureDifference::compare_times(const HeldPdu& a, const HeldPdu& b) {
  if (!shift_.has_value()) shift_ = b.time - a.time;
  if (!first_pair_.has_value()) first_pair_ = {a.time, b.time};
  last_pair_ = {a.time, b.time};
  const nanoseconds in_a = paired_.has_value() ? paired_->in_a(b.time) : b.time - *shift_;
  const double apart = std::abs(pdu::to_seconds(in_a - a.time));
  times_.add(apart);
  greatest_time_ = std::max(greatest_time_, apart);
}

void CaptureDifference::take_changed(const HeldPdu& a, const HeldPdu& b) {
  ++changed_;
  std::vector<FieldDifference> differences = pdu_differences(a.octets, b.octets);
  for (const FieldDifference& difference : differences) {
    const std::string name = without_indices(difference.field);
    if (!fields_.contains(name) && fields_.size() == kMostFields) continue;
    ChangedField& field = fields_[name];
    if (field.pdus++ > 0) continue;
    field.a = place_of(a);
    field.b = place_of(b);
    field.first = difference;
  }
  if (!first_changed_.has_value())
    first_changed_ = PduPair{place_of(a), place_of(b), std::move(differences)};
}

void CaptureDifference::take_alone(const HeldPdu& pdu, bool is_a) {
  Pending& mine = is_a ? only_a_ : only_b_;
  Pending& other = is_a ? only_b_ : only_a_;
  const auto counterpart = other.find(pdu.hash);
  if (counterpart != other.end()) {
    ++moved_;
    const PduPlace here = place_of(pdu);
    const PduPlace there = counterpart->second;
    if (!first_moved_.has_value())
      first_moved_ = is_a ? PduPair{here, there, {}} : PduPair{there, here, {}};
    other.erase(counterpart);
    return;
  }
  if (mine.size() < kMostPending)
    mine.emplace(pdu.hash, place_of(pdu));
  else
    ++(is_a ? beyond_a_ : beyond_b_);
}

std::vector<PduPlace> CaptureDifference::in_order(const Pending& pending) {
  std::vector<PduPlace> places;
  places.reserve(pending.size());
  for (const auto& [hash, place] : pending) places.push_back(place);
  std::ranges::sort(places, {}, &PduPlace::order);
  return places;
}

}  // namespace reckon::tools
