// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/entity_sender.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

using deadreckon::SendReason;
using std::chrono::nanoseconds;

// A small pose error or a heartbeat may wait for a bundle; new states and states in contact may
// not.
bool is_patient(SendReason reason) {
  return reason == SendReason::position || reason == SendReason::orientation ||
         reason == SendReason::heartbeat;
}

// Only threshold crossings depend on the distance of the receivers.
bool is_by_distance(SendReason reason) {
  return reason == SendReason::position || reason == SendReason::orientation;
}

// A receiver may approach in the meantime.
constexpr nanoseconds kLookAgain = std::chrono::milliseconds(100);

// Number of urgent tiers, and so index of the innermost tier with a row of channels.
std::size_t urgent_of(const Audiences* audiences) noexcept {
  return audiences != nullptr ? audiences->urgent() : 0;
}

}  // namespace

std::optional<std::size_t> EntitySender::asked_tier(const Decision& decision) const noexcept {
  if (network_.interop) return {};
  const OwnedEntity& entity = decision.entity;
  const aoim::TierTable& tiers = aoim_.tiers();
  if (aoim_.must_send(aoim::kCellTier, entity.id(), decision.position,
                      {entity.last_whole, entity.last_group}, decision.pass.now))
    return aoim::kCellTier;
  if (entity.audiences() == nullptr || !aoim_.introductions().is_pending()) return {};
  for (std::size_t row = tiers.last_row(); row-- > 0;) {
    if (is_asked_in(tiers.of_row(row), decision)) return tiers.of_row(row);
  }
  return {};
}

// A new listener of a row has been a listener of the outer row.
bool EntitySender::is_asked_in(std::size_t tier, const Decision& decision) const noexcept {
  const OwnedEntity& entity = decision.entity;
  const std::size_t audience = entity.audiences()->audience_of(aoim_.tiers().row_of(tier));
  return entity.audiences()->is_behind(audience + 1) &&
         aoim_.must_send(tier, entity.id(), decision.position, {entity.last_sent_at(audience), {}},
                         decision.pass.now);
}

// Whether a tier requests it. The next decision for the requesting tiers is then `event`.
bool EntitySender::note_asked(const Decision& decision) const noexcept {
  OwnedEntity& entity = decision.entity;
  const std::optional<std::size_t> tier = asked_tier(decision);
  if (!tier) return false;
  if (*tier == aoim::kCellTier) {
    entity.event();
    return true;
  }
  Audiences& audiences = *entity.audiences();
  const std::size_t row = aoim_.tiers().row_of(*tier);
  entity.event(audiences.audience_of(row));
  audiences.serve(std::min(row, audiences.served_row()), decision.pass.now + Audiences::kGrace);
  return true;
}

void EntitySender::look_for_listeners(const Decision& decision) const noexcept {
  Audiences& audiences = *decision.entity.audiences();
  const nanoseconds now = decision.pass.now;
  if (aoim_.tiers().last_row() == 0 || !audiences.has_to_look(now)) return;
  const double speed = decision.entity.truth().velocity.norm();
  audiences.serve(
      aoim_.receivers()->served_row(decision.position.position, speed, audiences.slack()),
      now + kLookAgain);
}

bool EntitySender::is_out_of_step(const Decision& decision, std::size_t audience) const noexcept {
  const OwnedEntity& entity = decision.entity;
  return entity.audiences()->is_out_of_step(audience,
                                            pdu::to_seconds(entity.last_sent_at(audience - 1)),
                                            pdu::to_seconds(decision.pass.now));
}

// Records of an entity near others are sent at once to nearby peers, in an urgent tier if there is
// one; other peers receive only the updates for display.
bool EntitySender::consider(OwnedEntity& entity, const Pass& pass, nanoseconds at,
                            std::span<const deadreckon::ProbeState> probes,
                            std::span<const EnergyAccount> accounts) noexcept {
  Decision decision{entity, pass, at};
  const bool is_asked = note_asked(decision);
  entity.note_check(pass.now);
  counters_.checks.add();
  const SendReason inmost = entity.decide(at, probes);
  const bool has_urgent = urgent_of(entity.audiences()) > 0;
  const bool in_company = !probes.empty() || (has_urgent && !accounts.empty());
  Dispatch how = choose(decision, inmost, in_company);
  how.is_asked = is_asked;
  if (how.reason == SendReason::none) return false;
  if (!hooks_.deciding.pass({entity, how, pass.now})) {
    entity.withhold(pass.now + kLookAgain);
    return false;
  }
  return send(decision, how, accounts);
}

Dispatch EntitySender::choose(Decision& decision, SendReason inmost, bool in_company) noexcept {
  if (decision.entity.audiences() != nullptr) {
    look_for_listeners(decision);
    return choose_audience(decision, inmost, in_company);
  }
  return {in_company ? inmost : unless_waiting(decision, 0, inmost), in_company};
}

// The outermost tier with a due update determines the recipients.
Dispatch EntitySender::choose_audience(Decision& decision, SendReason inmost,
                                       bool in_company) noexcept {
  const OwnedEntity& entity = decision.entity;
  const Audiences& audiences = *entity.audiences();
  const std::size_t inmost_group = in_company ? 0 : audiences.urgent();
  Dispatch how{SendReason::none, in_company, 0, false};
  for (std::size_t audience = audiences.last() + 1; audience-- > 0;) {
    SendReason reason = audience == 0 ? inmost : entity.decide_for(audience, decision.at);
    if (reason == SendReason::none && audience > 0 && is_out_of_step(decision, audience))
      reason = SendReason::heartbeat;
    if (reason == SendReason::none) continue;
    const bool at_once = in_company && (audience == 0 || aoim_.tiers().last_row() == 0);
    if (!at_once) reason = unless_waiting(decision, audience, reason);
    if (reason == SendReason::none) continue;
    const bool is_outmost = how.reason == SendReason::none;
    if (is_outmost) how.audience = std::max(audience, inmost_group);
    how.reason = is_outmost ? reason : std::min(how.reason, reason);
  }
  return how;
}

// The row of the nearest receiver; null if all receive the same.
const aoim::Channel* EntitySender::nearest_channel(Decision& decision) const noexcept {
  static constexpr aoim::Channel kNothing{0.0, aoim::Body::rigid, 0.0, 0.0, 1.0, false, 1.0};
  if (decision.nearest) return *decision.nearest;
  const aoim::ReceiverChannels* receivers = aoim_.receivers();
  const aoim::Channel* channel =
      receivers == nullptr ? nullptr : receivers->of(decision.position.position);
  if (receivers != nullptr && channel == nullptr) channel = &kNothing;
  return *(decision.nearest = channel);
}

// The row of a tier: its own if rows have groups, except for a receiver that gets all updates
// regardless of its budget.
const aoim::Channel* EntitySender::channel_of(Decision& decision,
                                              std::size_t audience) const noexcept {
  const aoim::Channel* nearest = nearest_channel(decision);
  const Audiences* audiences = decision.entity.audiences();
  if (aoim_.tiers().last_row() == 0 || audiences == nullptr) return nearest;
  const aoim::ChannelTable& table = aoim_.receivers()->table();
  const std::size_t row = audiences->row_of(std::min(audience, audiences->last()));
  return row == 0 && nearest->kept ? nearest : &table.channel(table.kept_rows() + row);
}

// The reason, unless the update may wait; then a heartbeat if one is due, else none.
SendReason EntitySender::unless_waiting(Decision& decision, std::size_t audience,
                                        SendReason reason) noexcept {
  const OwnedEntity& entity = decision.entity;
  if (reason == SendReason::none || !may_wait(decision, audience, reason)) return reason;
  const bool is_due = is_by_distance(reason) && entity.is_heartbeat_due(audience, decision.at);
  return is_due && !may_wait(decision, audience, SendReason::heartbeat) ? SendReason::heartbeat
                                                                        : SendReason::none;
}

bool EntitySender::may_wait(Decision& decision, std::size_t audience, SendReason reason) noexcept {
  OwnedEntity& entity = decision.entity;
  const nanoseconds now = decision.pass.now;
  const Audiences* audiences = entity.audiences();
  const bool by_rows = audiences != nullptr && aoim_.tiers().last_row() > 0;
  if (by_rows && audience < audiences->served()) {  // no listeners
    if (reason != SendReason::heartbeat) hold(entity, now + kLookAgain);
    return true;
  }
  if (!is_by_distance(reason)) return false;
  const aoim::Channel* channel = channel_of(decision, std::max(audience, urgent_of(audiences)));
  if (channel == nullptr || channel->kept) return false;
  const nanoseconds last = by_rows ? entity.last_sent_at(audience) : entity.last_sent;
  // A stopped entity is at rest for its receivers only after they received that state.
  const bool rests = entity.is_resting() && !entity.is_shown_moving(by_rows ? audience : 0, now);
  const double rate = rests ? channel->passive_hz : channel->active_hz;
  if (rate > 0.0 && now - last >= pdu::from_seconds(1.0 / rate)) return false;
  nanoseconds again = now + kLookAgain;
  if (rate > 0.0) again = std::min(again, last + pdu::from_seconds(1.0 / rate));
  hold(entity, again);
  return true;
}

void EntitySender::hold(OwnedEntity& entity, nanoseconds until) noexcept {
  if (entity.hold_back(until)) counters_.held_back.add();
}

bool EntitySender::send(OwnedEntity& entity, const Pass& pass, nanoseconds at, const Dispatch& how,
                        std::span<const EnergyAccount> accounts) noexcept {
  Decision decision{entity, pass, at};
  return send(decision, how, accounts);
}

bool EntitySender::send(Decision& decision, const Dispatch& how,
                        std::span<const EnergyAccount> accounts) noexcept {
  OwnedEntity& entity = decision.entity;
  const nanoseconds now = decision.pass.now, at = decision.at;
  const nanoseconds utc = decision.pass.utc - (now - at);
  aoim::Body body = aoim::Body::full;
  if (!how.in_company && is_by_distance(how.reason)) {
    if (const aoim::Channel* channel = channel_of(decision, how.audience)) body = channel->body;
  }
  if (!entity.build(at, utc, how.reason, accounts, update_, body, how.audience)) return false;
  update_.state.header.timestamp = time_.stamp(utc);

  std::array<std::byte, kMaxEntityRecords> room;
  const std::span<const std::byte> records(room.data(), store_records(update_, room));
  // Other than the last truth only if the entity has not been moved since.
  const aoim::Position sent_at = to_position(entity.truth_at(at).position);
  aoim::RoutedPosition position = decision.position;
  if (sent_at != position.position) position = sent_at;
  const bool waits = is_patient(how.reason) && !how.in_company;
  const BundlePolicy policy = waits ? bundle_policy_of(network_, entity.type()) : BundlePolicy{};
  const aoim::BundleTerms terms(now + policy.hold, policy.updates);
  const Audiences* audiences = entity.audiences();
  std::size_t octets = 0;
  if (how.in_company) {
    for (const std::size_t tier : aoim_.tiers().urgent().first(urgent_of(audiences)))
      octets += send_at_once(tier, position, records, now);
  }
  if (audiences == nullptr || how.audience >= audiences->last()) {
    const aoim::GroupIndex former = std::exchange(entity.last_group, aoim_.route(position));
    if (!hooks_.routing.empty()) reroute(entity, position);
    const Written written =
        send_to_all(entity, position, records, terms, how.reason == SendReason::event, now);
    octets += written.octets;
    if (aoim_.leading() != nullptr && former != aoim::kBaseGroup && former != entity.last_group)
      octets += send_departure(position, former, records, terms);
    entity.last_sent = now;
    if (!written.needs_key && !entity.is_thinned(body)) entity.last_whole = now;
  } else if (how.audience >= urgent_of(audiences)) {
    entity.look_again(now + kLookAgain);  // it may still be due to other tiers
    octets += send_to_row(entity, position, records, terms, how.audience, now);
  }
  if (octets == 0) return false;
  counters_.sent(how.reason, octets);
  if (how.is_asked) aoim_.introductions().note_sent(octets, now);
  return true;
}

// Receivers in the group `former` alone would extrapolate its last state there, and the leader of
// its cell would introduce it.
std::size_t EntitySender::send_departure(const aoim::RoutedPosition& position,
                                         aoim::GroupIndex former,
                                         std::span<const std::byte> records,
                                         const aoim::BundleTerms& terms) noexcept {
  aoim::RoutedPosition left = position;
  left.group = former;
  static_cast<void>(
      aoim_.send(aoim::kCellTier, aoim::StatePayload{update_.state, records}, left, terms));
  return pdu::wire_size(update_.state) + records.size();
}

void EntitySender::reroute(const OwnedEntity& entity,
                           aoim::RoutedPosition& position) const noexcept {
  RoutedUpdate update{entity, entity.last_group};
  if (!hooks_.routing.pass(update)) position.group = update.group;
}

std::size_t EntitySender::send_at_once(std::size_t tier, const aoim::RoutedPosition& position,
                                       std::span<const std::byte> records,
                                       nanoseconds now) noexcept {
  static_cast<void>(aoim_.send(tier, aoim::StatePayload{update_.state, records}, position, now));
  counters_.by_tier[tier]->add();
  return pdu::wire_size(update_.state) + records.size();
}

// A state without a compact form is not sent now, but to all in the next pass.
std::size_t EntitySender::send_to_row(OwnedEntity& entity, const aoim::RoutedPosition& position,
                                      std::span<const std::byte> records,
                                      const aoim::BundleTerms& terms, std::size_t audience,
                                      nanoseconds now) noexcept {
  const std::size_t tier = aoim_.tiers().of_row(entity.audiences()->row_of(audience));
  StateCompressor* compressor = entity.compressor();
  if (compressor == nullptr) {
    static_cast<void>(
        aoim_.send(tier, aoim::StatePayload{update_.state, records}, position, terms));
    counters_.by_tier[tier]->add();
    return pdu::wire_size(update_.state) + records.size();
  }
  std::array<std::byte, StateCompressor::kRoom> octets;
  const std::size_t size = compressor->compress_independent(update_.state, octets);
  if (size == 0) {
    entity.event();
    entity.look_again(now);
    return 0;
  }
  const aoim::CompressedPayload made{entity.id(), compressor->form(),
                                     std::span(octets).first(size)};
  static_cast<void>(aoim_.send(tier, made, position, terms));
  counters_.by_tier[tier]->add();
  return size;
}

// Octets of the state as sent. After an event, and for newcomers, it is uncompressed.
EntitySender::Written EntitySender::send_to_all(OwnedEntity& entity,
                                                const aoim::RoutedPosition& position,
                                                std::span<const std::byte> records,
                                                const aoim::BundleTerms& terms, bool is_event,
                                                nanoseconds now) noexcept {
  StateCompressor* compressor = entity.compressor();
  std::array<std::byte, StateCompressor::kRoom> octets;
  StateCompressor::Made made;
  if (compressor != nullptr) {
    made = compressor->compress(update_.state, aoim_.route(position), is_event, now, octets);
  }
  const aoim::BundleTerms due = made.is_key ? aoim::BundleTerms(now) : terms;
  if (made.size == 0) {
    static_cast<void>(
        aoim_.send(aoim::kCellTier, aoim::StatePayload{update_.state, records}, position, due));
    return {pdu::wire_size(update_.state) + records.size(), false};
  }
  const aoim::CompressedPayload payload{entity.id(), compressor->form(),
                                        std::span(octets).first(made.size), records};
  static_cast<void>(aoim_.send(aoim::kCellTier, payload, position, due));
  return {made.size + records.size(), made.needs_key};
}

}  // namespace reckon::peer
