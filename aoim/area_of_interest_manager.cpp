// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/area_of_interest_manager.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::aoim {
using std::chrono::nanoseconds;

AreaOfInterestManager::AreaOfInterestManager(const AreaOfInterestConfig& config,
                                             const pdu::Presence& own)
    : config_(config),
      cells_(cells_of(config)),
      tiers_(tiers_of(config)),
      subscriptions_(tiers_, cells_, config.subscription, tier_reach_of(config)),
      sight_(interest_of(config, cells_), cells_, subscriptions_.cells(), config.follow,
             config.cells ? config.cells->finest() : config.grid.cell_size, config.interop),
      aggregator_(aggregator_of(config, own)),
      presence_(config.presence, announcement(own, config)),
      introductions_(introduction_of(config, cells_),
                     std::max<std::size_t>(cells_.groups(), all_groups(config))),
      sequences_(config.tracked),
      joins_(tiers_, cells_.groups()) {
  aggregator_.set_interop(kBaseGroup, config.interop);
  events_.reserve(4 * config.presence.capacity + 16);
  taken_.reserve(4 * config.presence.capacity + 16);
  if (!config.channels.empty() && !config.interop) channels_.emplace(config.channels);
  if (config.leader.on && !config.interop)
    leading_.emplace(config.leader, config.grid.pool, cells_, subscriptions_.cells(), presence_,
                     config.body_owners, config.locate);
  if (!config.follow.empty() && !hands_out())
    throw std::invalid_argument("beacons are found in the map of groups: hand groups out");
}

void AreaOfInterestManager::start(nanoseconds now) {
  if (config_.interop) return;
  started_ = true;
  presence_.start(now);
  if (leading_) leading_->start(now + utc_offset_, now);
}

void AreaOfInterestManager::stop() {
  started_ = false;
  if (leading_) leading_->stop();
  presence_.stop();
}

void AreaOfInterestManager::set_utc_offset(nanoseconds offset, bool synchronised) noexcept {
  utc_offset_ = offset;
  synchronised_ = synchronised;
  aggregator_.set_utc_offset(offset, synchronised);
}

// ----------------------------------------------------------------------------------------- route

GroupIndex AreaOfInterestManager::route(const RoutedPosition& position) const noexcept {
  if (position.group) return *position.group;
  const GroupIndex cell = config_.interop ? kBaseGroup : position.cell_in(cells_);
  position.group = leading_ ? leading_->speak_group(cell) : cell;
  return *position.group;
}

AddResult AreaOfInterestManager::send(std::size_t tier, const UpdatePayload& update,
                                      const RoutedPosition& position, const BundleTerms& terms) {
  if (tier >= tiers_.count() && tier != kEverybody) return AddResult::refused_group;
  GroupIndex group = kBaseGroup;
  if (tier != kEverybody)
    group = tier == kCellTier ? route(position) : tiers_.group(tier, position.cell_in(cells_));
  if (const auto* plain = std::get_if<StatePayload>(&update)) {
    if (leading_ && tier == kCellTier)
      leading_->note_own(position.cell_in(cells_), plain->state, plain->records, terms.deadline);
    return aggregator_.add(group, plain->state, plain->records, terms);
  }
  if (const auto* made = std::get_if<CompressedPayload>(&update))
    return aggregator_.add_compressed(group, made->entity, made->form, made->state, made->records,
                                      terms);
  const auto& pdu = std::get<PduPayload>(update);
  return aggregator_.add(group, pdu.octets, terms, pdu.mark);
}

bool AreaOfInterestManager::must_send(std::size_t tier, const pdu::EntityId& entity,
                                      const RoutedPosition& position, const LastSent& last,
                                      nanoseconds now) const noexcept {
  const bool has_crossed =
      tier == kCellTier && now - last.at >= config_.crossing_gap && route(position) != last.group;
  if (has_crossed) return true;
  return tier < tiers_.count() && introductions_.is_pending() &&
         introductions_.is_due(entity, tiers_.group(tier, position.cell_in(cells_)), last.at, now);
}

// ------------------------------------------------------------------------------------- subscribe

SubscriptionChange AreaOfInterestManager::listen(std::size_t tier, std::span<const Focus> foci,
                                                 nanoseconds now) {
  if (tier >= tiers_.count()) return {};
  const SubscriptionChange change =
      tier == kCellTier ? listen_to_cells(foci, now) : listen_beside_cells(tier, foci, now);
  subscriptions_.note(change);
  for (const GroupIndex group : change.leave) sequences_.forget(group);
  for (const GroupIndex group : change.join) sequences_.forget(group);
  return change;
}

SubscriptionChange AreaOfInterestManager::listen_beside_cells(std::size_t tier,
                                                              std::span<const Focus> foci,
                                                              nanoseconds now) {
  const SubscriptionChange cells = subscriptions_.update(tier, foci, now);
  if (started_ && tiers_.kind(tier).runs_ahead) {
    for (const GroupIndex cell : cells.join)
      joins_.ask_once(tier, subscriptions_.of(tier).cell(cell));
  }
  return subscriptions_.groups_of(tier, cells);
}

SubscriptionChange AreaOfInterestManager::listen_to_cells(std::span<const Focus> foci,
                                                          nanoseconds now) {
  sight_.set_foci(foci);
  if (config_.interop) return {};
  const auto besides = sight_.follow(now, config_.leader.empty, [&](std::uint32_t tag) {
    return leading_->role().directory().find_beacon(tag, now);
  });
  const SubscriptionChange change = subscriptions_.update(kCellTier, foci, now, besides);
  if (!change.leave.empty()) sight_.leave_cell();
  if (!hands_out()) {
    for (const GroupIndex group : change.leave) joins_.asks().leave(group);
  }
  if (leading_) return leading_->follow(change, now + utc_offset_, now);
  // Each peer that receives our start introduces all its entities.
  for (const GroupIndex group : change.join)
    joins_.asks().join(group, subscriptions_.cells().cell(group), started_, now);
  return change;
}

// ---------------------------------------------------------------------------------------- filter

Incoming AreaOfInterestManager::receive(GroupIndex group, std::span<const std::byte> datagram,
                                        nanoseconds now, const SourceAddress& from,
                                        std::optional<nanoseconds> came) {
  Incoming incoming;
  const auto trailer = trailer_of(datagram);
  if (trailer) incoming.trailer = *trailer;
  if (!is_of_exercise(group, datagram, trailer)) {
    incoming.verdict = IncomingVerdict::other_exercise;
  } else if (trailer) {
    incoming.verdict = judge_datagram(group, from, incoming);
    if (incoming.verdict == IncomingVerdict::use) presence_.note_alive(trailer->epoch, now);
    if (incoming.sequence && group.value <= cells_.groups()) joins_.asks().note_heard(group);
  }

  // Presence PDUs are read from all senders except ourselves: they change a sender's standing, and
  // distinguish impostors from peers that have moved.
  const bool fresh = is_usable(incoming.verdict) ||
                     incoming.verdict == IncomingVerdict::other_scene ||
                     incoming.verdict == IncomingVerdict::former_life ||
                     incoming.verdict == IncomingVerdict::impostor;
  if (incoming.verdict == IncomingVerdict::impostor) {
    presence_.note_impostor(incoming.trailer.epoch, from, now);
    if (group != kBaseGroup) conclude(now);
  }
  if (group == kBaseGroup && fresh && !config_.interop) consume_control(datagram, now, from);
  // The sender may have announced itself in this datagram.
  if (incoming.verdict == IncomingVerdict::use &&
      presence_.standing(trailer->epoch) != Standing::member) {
    incoming.verdict = IncomingVerdict::stranger;
  }
  ++incoming_[static_cast<std::size_t>(incoming.verdict)];
  if (leading_ && incoming.verdict == IncomingVerdict::use && tiers_.tier_of(group) == kCellTier) {
    leading_->receive(group, datagram, trailer->epoch, now, came.value_or(now));
  }
  return incoming;
}

// A network may carry many exercises: a peer of another exercise is no newcomer and disputes no ID,
// with any other content of its datagram.
bool AreaOfInterestManager::is_of_exercise(
    GroupIndex group, std::span<const std::byte> datagram,
    const std::optional<pdu::DatagramTrailer>& trailer) const noexcept {
  const std::uint8_t ours = presence_.own().header.exercise_id;
  if (trailer && trailer->header.exercise_id != ours) return false;
  return group != kBaseGroup || config_.interop || !announces_another_exercise(datagram, ours);
}

IncomingVerdict AreaOfInterestManager::judge_datagram(GroupIndex group, const SourceAddress& from,
                                                      Incoming& incoming) noexcept {
  const pdu::DatagramTrailer& trailer = incoming.trailer;
  const Standing standing = presence_.standing(trailer.epoch, &from);
  if (standing == Standing::own) return IncomingVerdict::own;
  if (standing == Standing::former_life) return IncomingVerdict::former_life;
  if (standing == Standing::impostor) return IncomingVerdict::impostor;
  if (!subscriptions_.hears(group)) return IncomingVerdict::not_joined;
  if (standing == Standing::other_scene) return IncomingVerdict::other_scene;
  // Before its announcement, the owner of these sequence numbers is unknown.
  if (standing == Standing::unknown) return IncomingVerdict::use;

  incoming.sequence = sequences_.note(trailer.epoch, group, trailer.sequence);
  if (*incoming.sequence == SequenceVerdict::duplicate) return IncomingVerdict::duplicate;
  if (*incoming.sequence == SequenceVerdict::too_old) return IncomingVerdict::too_old;
  return IncomingVerdict::use;
}

void AreaOfInterestManager::consume_control(std::span<const std::byte> datagram, nanoseconds now,
                                            const SourceAddress& from) {
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    if (bundled.error != pdu::DecodeError::none) continue;
    if (bundled.header.pdu_type == pdu::PduType::presence) {
      pdu::Presence heard;
      if (pdu::decode(bundled.bytes, heard) == pdu::DecodeError::none)
        presence_.receive(heard, now, from);
    } else if (bundled.header.pdu_type == pdu::PduType::peers_heard) {
      pdu::PeersHeard list;
      if (pdu::decode(bundled.bytes, list) == pdu::DecodeError::none)
        presence_.receive(list, now, from);
    } else if (bundled.header.pdu_type == pdu::PduType::cell_membership) {
      pdu::CellMembership membership;
      if (pdu::decode(bundled.bytes, membership) == pdu::DecodeError::none) {
        note_membership(membership, now, from);
      }
    }
  }
  conclude(now);
}

// A peer that joins a cell lacks its entities. The time of a request identifies a repetition.
void AreaOfInterestManager::note_membership(const pdu::CellMembership& membership, nanoseconds now,
                                            const SourceAddress& from) {
  if (membership.header.exercise_id != presence_.own().header.exercise_id) return;
  const Standing standing = presence_.standing(membership.epoch, &from);
  if (standing != Standing::member && standing != Standing::unknown) return;
  const std::optional<std::size_t> tier = joined_tier(membership, tiers_);
  if (!tier) return;
  if (*tier == kCellTier && !heard_asks_.note(membership.epoch, membership.since)) return;
  const nanoseconds heard_for = presence_.heard_for(membership.epoch);
  for (const pdu::CellIndex& cell : pdu::records_of<pdu::CellIndex>(membership.cells)) {
    const CellId id{cell.column, cell.row};
    if (*tier != kCellTier || id != kWholeScene) {
      introductions_.begin(tiers_.group(*tier, cells_.group(id)), heard_for, now);
    } else if (hands_out() && standing == Standing::member) {
      leading_->role().doubt_map(now);
      introductions_.begin(kBaseGroup, heard_for, now);
    }
  }
}

// Applies the events of presence, and keeps them for the peer.
void AreaOfInterestManager::conclude(nanoseconds now) {
  for (const PresenceEvent& event : presence_.take_events()) {
    switch (event.kind) {
      case PresenceEventKind::newcomer:
        introduce_ = introduce_ || !leading_;  // leaders answer the newcomer
        break;
      case PresenceEventKind::renamed:
        introduce_ = true;
        break;
      case PresenceEventKind::restarted:
        sequences_.forget(event.former_epoch);
        if (leading_) leading_->role().forget(event.former_epoch, now);
        introduce_ = introduce_ || !leading_;
        break;
      case PresenceEventKind::moved:  // its counts may come from another sender
        sequences_.forget(event.announced.epoch);
        break;
      case PresenceEventKind::departed:
      case PresenceEventKind::timed_out:
        sequences_.forget(event.announced.epoch);
        if (leading_) leading_->role().forget(event.announced.epoch, now);
        break;
      case PresenceEventKind::identity_changed:
        aggregator_.set_sender(event.peer());
        introduce_ = true;
        break;
      case PresenceEventKind::settled:
        // A peer may have taken us for a rival of a former epoch and dropped our entities.
        if (!presence_.peers().empty()) introductions_.begin(kBaseGroup, {}, now);
        continue;  // not reported to the peer
      case PresenceEventKind::heard_late:
        if (!leading_) introductions_.begin(kBaseGroup, event.heard_for, now);
        continue;
      case PresenceEventKind::scene_mismatch:
      case PresenceEventKind::disputed:
      case PresenceEventKind::impostor:
      case PresenceEventKind::crowd:
      case PresenceEventKind::quiet:
      case PresenceEventKind::unheard:
      case PresenceEventKind::heard_again:
      case PresenceEventKind::slept:
        break;
    }
    events_.push_back(event);
  }
}

// ------------------------------------------------------------------------------------- aggregate

void AreaOfInterestManager::step(nanoseconds now, DatagramSink sink) {
  announce(now);
  lead(now);
  const bool asks = joins_.asks().has_new();
  joins_.step(now, stamp(now), to_everybody(now));
  if (asks) presence_.announce_by(joins_.asks().next_repetition());
  introductions_.step(now);
  aggregator_.flush_due(now, sink);
  note_last_sent(now);
}

void AreaOfInterestManager::announce(nanoseconds now) {
  const ControlStamp sent = stamp(now);
  const std::span<const pdu::Presence> outgoing = presence_.step(now, sent.utc, sent.timestamp);
  conclude(now);
  for (const pdu::Presence& announced : outgoing) {
    const bool leaves = (announced.flags & pdu::kPresenceLeaving) != 0;
    // Peers would drop entities that arrive before our announcement.
    if (introduce_ && !leaves) introductions_.begin(kBaseGroup, {}, now);
    introduce_ = introduce_ && leaves;
    std::array<std::byte, pdu::kFixedSize<pdu::Presence>> octets;
    const std::size_t size = pdu::encode(announced, octets);
    aggregator_.add(kBaseGroup, std::span(octets).first(size), now);
    if (leaves) continue;
    joins_.repeat(now, stamp(now), to_everybody(now));
    presence_.announce_by(joins_.asks().next_repetition());
  }
  if (const auto heard = presence_.take_list(now, said_))
    aggregator_.add(kBaseGroup, peers_heard_.encode(*heard, stamp(now)), now);
}

void AreaOfInterestManager::lead(nanoseconds now) {
  if (!leading_) return;
  leading_->step(
      now, pdu::to_dis_timestamp(now + utc_offset_, synchronised_),
      [&](GroupIndex group, std::span<const std::byte> pdu) { aggregator_.add(group, pdu, now); });
  CellId cell;
  while (leading_->role().take_given_up(now, cell)) joins_.ask_once(kCellTier, cell);
  if (leading_->role().take_plea(now)) joins_.ask_once(kCellTier, kWholeScene);
}

ControlStamp AreaOfInterestManager::stamp(nanoseconds now) const noexcept {
  return {presence_.own().header.exercise_id, presence_.id(), presence_.own().epoch,
          pdu::to_dis_timestamp(now + utc_offset_, synchronised_), now + utc_offset_};
}

JoinAnnouncer::Send AreaOfInterestManager::to_everybody(nanoseconds now) {
  return [this, now](std::span<const std::byte> pdu) { aggregator_.add(kBaseGroup, pdu, now); };
}

void AreaOfInterestManager::note_last_sent(nanoseconds now) noexcept {
  const std::uint64_t datagrams = aggregator_.counts().datagrams;
  if (datagrams != datagrams_said_) said_ = now;
  datagrams_said_ = datagrams;
}

nanoseconds AreaOfInterestManager::next_step() const noexcept {
  nanoseconds next = config_.interop ? nanoseconds::max() : presence_.next_step();
  next = std::min(next, introductions_.next_step());
  if (const auto due = aggregator_.next_deadline()) next = std::min(next, *due);
  if (leading_) next = std::min(next, leading_->next_step());
  if (joins_.is_pending()) next = nanoseconds::min();
  return next;
}

std::span<const PresenceEvent> AreaOfInterestManager::take_events() {
  taken_.clear();
  std::swap(taken_, events_);
  return taken_;
}

}  // namespace reckon::aoim
