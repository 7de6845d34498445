// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/entity_sender.hpp"

#include <array>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

using deadreckon::SendReason;
using std::chrono::nanoseconds;

// A pose that is off a little, or repeated, may wait for company; what is new or felt may not.
bool is_patient(SendReason reason) {
  return reason == SendReason::position || reason == SendReason::orientation ||
         reason == SendReason::heartbeat;
}

// Only how far copies are off is a matter of who sees it.
bool is_by_distance(SendReason reason) {
  return reason == SendReason::position || reason == SendReason::orientation;
}

// Somebody may come near meanwhile.
constexpr nanoseconds kLookAgain = std::chrono::milliseconds(100);

}  // namespace

bool EntitySender::is_asked_for(const OwnedEntity& entity, const Pass& pass) const noexcept {
  return !network_.interop && aoim_.must_send(entity.id(), to_position(entity.truth().position),
                                              entity.last_group, entity.last_whole, pass.now);
}

// What is felt of an entity in company is told to those near at once, by its contact group where
// there are some; all others are told as much as they need to see.
bool EntitySender::consider(OwnedEntity& entity, const Pass& pass, nanoseconds at,
                            std::span<const deadreckon::ProbeState> probes,
                            std::span<const EnergyAccount> accounts) noexcept {
  if (is_asked_for(entity, pass)) entity.event();
  counters_.checks.add();
  const SendReason felt = entity.decide(at, probes);
  const SendReason seen = entity.decide_seen(at);
  Dispatch how{felt != SendReason::none ? felt : seen, !probes.empty()};
  if (how.reason == SendReason::none) return false;
  if (entity.tells_near_apart() && !(probes.empty() && accounts.empty())) {
    how.in_company = true;
    how.to = seen != SendReason::none ? Told::both : Told::near_only;
  }
  if (!how.in_company && is_by_distance(how.reason) && may_wait(entity, pass)) return false;
  return send(entity, pass, at, how, accounts);
}

// The row of the nearest receiver; null where all are told the same.
const aoim::Channel* EntitySender::channel_of(const OwnedEntity& entity) const noexcept {
  static constexpr aoim::Channel kNothing{0.0, aoim::Body::rigid, 0.0, 0.0, 1.0, false};
  const aoim::ReceiverChannels* receivers = aoim_.receivers();
  if (receivers == nullptr) return nullptr;
  const aoim::Channel* channel = receivers->of(to_position(entity.truth().position));
  return channel != nullptr ? channel : &kNothing;
}

bool EntitySender::may_wait(OwnedEntity& entity, const Pass& pass) noexcept {
  const aoim::Channel* channel = channel_of(entity);
  if (channel == nullptr || channel->kept) return false;
  const double rate = entity.is_resting() ? channel->passive_hz : channel->active_hz;
  const nanoseconds since = pass.now - entity.last_sent;
  if (rate > 0.0 && since >= pdu::from_seconds(1.0 / rate)) return false;
  nanoseconds again = pass.now + kLookAgain;
  if (rate > 0.0) again = std::min(again, entity.last_sent + pdu::from_seconds(1.0 / rate));
  if (entity.hold_back(again)) counters_.held_back.add();
  return true;
}

bool EntitySender::send(OwnedEntity& entity, const Pass& pass, nanoseconds at, const Dispatch& how,
                        std::span<const EnergyAccount> accounts) noexcept {
  const nanoseconds utc = pass.utc - (pass.now - at);
  aoim::Body body = aoim::Body::full;
  if (!how.in_company && is_by_distance(how.reason)) {
    if (const aoim::Channel* channel = channel_of(entity)) body = channel->body;
  }
  if (!entity.build(at, utc, how.reason, accounts, update_, body, how.to)) return false;
  update_.state.header.timestamp = time_.stamp(utc);

  std::array<std::byte, kMaxEntityRecords> room;
  const std::span<const std::byte> records(room.data(), store_records(update_, room));
  const aoim::Position position = to_position(entity.truth_at(at).position);
  const bool waits = is_patient(how.reason) && !how.in_company;
  const BundlePolicy policy = waits ? bundle_policy_of(network_, entity.type()) : BundlePolicy{};
  const aoim::BundleTerms terms(pass.now + policy.hold, policy.updates);
  std::size_t octets = 0;
  if (how.to != Told::all) octets += tell_near(position, records, pass.now);
  if (how.to != Told::near_only) {
    const Written written =
        tell_all(entity, position, records, terms, how.reason == SendReason::event, pass.now);
    octets += written.octets;
    entity.last_group = aoim_.route(position);
    entity.last_sent = pass.now;
    if (!written.leans && !entity.is_thinned(body)) entity.last_whole = pass.now;
  }
  counters_.sent(how.reason, octets);
  return true;
}

std::size_t EntitySender::tell_near(const aoim::Position& position,
                                    std::span<const std::byte> records, nanoseconds now) noexcept {
  static_cast<void>(aoim_.send_felt(update_.state, position, records, now));
  counters_.felt.add();
  return pdu::wire_size(update_.state) + records.size();
}

// Octets of the state as it goes out. Who is new, or was told something new, gets it plain.
EntitySender::Written EntitySender::tell_all(OwnedEntity& entity, const aoim::Position& position,
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
    static_cast<void>(aoim_.send(update_.state, position, records, due));
    return {pdu::wire_size(update_.state) + records.size(), false};
  }
  static_cast<void>(aoim_.send_compressed(
      entity.id(), compressor->form(), std::span(octets).first(made.size), position, records, due));
  return {made.size + records.size(), made.leans};
}

}  // namespace reckon::peer
