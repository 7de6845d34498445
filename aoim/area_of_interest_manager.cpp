// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/area_of_interest_manager.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "reckon/aoim/interest/focus_cover.hpp"
#include "reckon/aoim/interest/near_rows.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// How much nearer than it is left a contact group is joined.
constexpr double kContactLeave = 2.0;

// Where groups are handed out, cells have as many numbers as there can be.
CellPartition cells_of(const AreaOfInterestConfig& config) {
  GridConfig grid = config.grid;
  if (config.leader.on && config.leader.hand_out) grid.pool = kMaximumPool;
  if (!config.cells) return CellGrid(grid);
  if (config.interop && config.cells->as<LocaleMap>() != nullptr)
    throw std::invalid_argument("locales are distinguished by groups: plain DIS has one");
  if (config.cells->groups() > grid.pool)
    throw std::invalid_argument("cells of " + std::to_string(config.cells->groups()) +
                                " groups, and a pool of " + std::to_string(grid.pool));
  return *config.cells;
}

std::size_t near_rows_of(const AreaOfInterestConfig& config) {
  if (!config.near_groups || config.channels.empty()) return 0;
  return ChannelTable(config.channels).near_rows();
}

SubscriptionConfig subscription_of(const TierTable& tiers, std::size_t tier,
                                   SubscriptionConfig config) {
  if (tiers.is_near(tier)) return near_subscription(config);
  if (!tiers.is_felt(tier)) return config;
  config.leave_factor = std::max(config.leave_factor, kContactLeave);
  config.maximum_groups = kMaximumPool;  // what a hand touches is not left out
  return config;
}

std::vector<Subscription> subscriptions_of(const TierTable& tiers, const CellPartition& cells,
                                           const SubscriptionConfig& config) {
  std::vector<Subscription> all;
  all.reserve(tiers.count());
  for (std::size_t tier = 0; tier < tiers.count(); ++tier)
    all.emplace_back(cells, subscription_of(tiers, tier, config));
  return all;
}

void check_more_groups(const AreaOfInterestConfig& config) {
  const auto refuse = [](const char* what) { throw std::invalid_argument(what); };
  if (!config.contact_groups && !config.near_groups) return;
  if (config.interop) refuse("contact and near groups: plain DIS has one group");
  if (config.leader.on && config.leader.hand_out)
    refuse("contact and near groups are those of the fixed tile: none is handed out");
  if (config.grid.pool < 2 || all_groups(config) > kMaximumPool)
    refuse("contact and near groups: take a pool of 4 or more, and 1000 groups in all at most");
  if (!config.near_groups) return;
  if (config.channels.empty() || ChannelTable(config.channels).near_rows() == 0)
    refuse("near groups: the channels have no row that is near, not kept, and not the last");
  if (config.leader.on) refuse("near groups: leaders would tell what was said in all of them");
  if (config.channels[ChannelTable(config.channels).kept_rows()].coarser > 1.0)
    refuse("near groups: the nearest row has the thresholds of the scene");
}

AggregatorConfig complete(AggregatorConfig config, const AreaOfInterestConfig& all,
                          const pdu::Presence& own) {
  check_more_groups(all);
  config.pool = all_groups(all);
  config.sender = own.simulation;
  config.epoch = own.epoch;
  config.exercise_id = own.header.exercise_id;
  return config;
}

InterestConfig complete(InterestConfig config, const CellPartition& cells) {
  config.maximum_foci = std::max(config.maximum_foci, FocusCover::most(cells.as<LocaleMap>()));
  return config;
}

IntroductionConfig complete(IntroductionConfig config, const AreaOfInterestConfig& all,
                            const CellPartition& cells) {
  config.pool = std::max<std::size_t>(cells.groups(), all_groups(all));
  return config;
}

// The last 24 octets, where they are a trailer.
std::optional<pdu::DatagramTrailer> trailer_of(std::span<const std::byte> datagram) noexcept {
  if (datagram.size() < pdu::kDatagramTrailerSize) return {};
  pdu::DatagramTrailer trailer;
  const auto error = pdu::decode(datagram.last(pdu::kDatagramTrailerSize), trailer);
  const bool whole = trailer.header.length == pdu::kDatagramTrailerSize;
  if (error != pdu::DecodeError::none || !whole) return {};
  return trailer;
}

}  // namespace

std::size_t all_groups(const AreaOfInterestConfig& config) {
  const TierTable tiers(config.contact_groups, near_rows_of(config), config.grid.pool);
  return config.grid.pool * tiers.count();
}

pdu::Presence announcement(pdu::Presence own, const AreaOfInterestConfig& config) {
  own.cell_scheme = config.cells ? config.cells->scheme() : config.grid.scheme;
  own.cell_size = static_cast<float>(config.cells ? config.cells->finest() : config.grid.cell_size);
  own.pool_size = static_cast<std::uint16_t>(config.grid.pool);
  if (config.interop) own.flags |= pdu::kPresenceInterop;
  return own;
}

AreaOfInterestManager::AreaOfInterestManager(const AreaOfInterestConfig& config,
                                             const pdu::Presence& own)
    : config_(config),
      cells_(cells_of(config)),
      tiers_(config.contact_groups, near_rows_of(config), config.grid.pool),
      subscriptions_(subscriptions_of(tiers_, cells_, config.subscription)),
      sight_(complete(config.interest, cells_), cells_, subscriptions_.front(), config.follow,
             config.cells ? config.cells->finest() : config.grid.cell_size),
      aggregator_(complete(config.aggregator, config, own)),
      presence_(config.presence, announcement(own, config)),
      introductions_(complete(config.introduction, config, cells_),
                     std::max<std::size_t>(cells_.groups(), all_groups(config))),
      sequences_(config.tracked),
      asks_(cells_.groups()) {
  joined_.resize(tiers_.count());
  join_.reserve(all_groups(config));
  leave_.reserve(all_groups(config));
  aggregator_.set_interop(kBaseGroup, config.interop);
  peers_heard_.reserve(config.presence.capacity * pdu::kFixedSize<pdu::PeerEpoch>);
  joined_.front().reserve(cells_.groups() * pdu::kFixedSize<pdu::CellIndex>);
  events_.reserve(4 * config.presence.capacity + 16);
  taken_.reserve(4 * config.presence.capacity + 16);
  if (!config.channels.empty() && !config.interop) channels_.emplace(config.channels);
  if (config.leader.on && !config.interop)
    leading_.emplace(config.leader, config.grid.pool, cells_, subscriptions_.front(), presence_,
                     config.locate);
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

GroupIndex AreaOfInterestManager::route(const Position& position) const noexcept {
  if (config_.interop) return kBaseGroup;
  const GroupIndex cell = cells_.group(position);
  return leading_ ? leading_->speak_group(cell) : cell;
}

AddResult AreaOfInterestManager::send(std::size_t tier, const UpdatePayload& update,
                                      const Position& position, const BundleTerms& terms) {
  if (tier >= tiers_.count() && tier != kEverybody) return AddResult::refused_group;
  GroupIndex group = kBaseGroup;
  if (tier == kCellTier) group = route(position);
  if (tier < tiers_.count() && tier != kCellTier)
    group = tiers_.group(tier, cells_.group(position));
  if (const auto* plain = std::get_if<StatePayload>(&update)) {
    if (leading_ && tier == kCellTier)
      leading_->note_own(cells_.group(position), plain->state, plain->records, terms.deadline);
    return aggregator_.add(group, plain->state, plain->records, terms);
  }
  if (const auto* made = std::get_if<CompressedPayload>(&update))
    return aggregator_.add_compressed(group, made->entity, made->form, made->state, made->records,
                                      terms);
  return aggregator_.add(group, std::get<PduPayload>(update).octets, terms);
}

bool AreaOfInterestManager::must_send(std::size_t tier, const pdu::EntityId& entity,
                                      const Position& position, const LastSent& last,
                                      nanoseconds now) const noexcept {
  const bool has_crossed =
      tier == kCellTier && now - last.at >= config_.crossing_gap && route(position) != last.group;
  if (has_crossed) return true;
  return tier < tiers_.count() && introductions_.is_pending() &&
         introductions_.is_due(entity, tiers_.group(tier, cells_.group(position)), last.at, now);
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
    if (incoming.sequence && group.value <= cells_.groups()) asks_.note_heard(group);
  }

  // Presence is heard from everyone but ourselves: it is what changes a sender's standing, and it
  // knows impostors from peers that have moved.
  const bool fresh = is_usable(incoming.verdict) ||
                     incoming.verdict == IncomingVerdict::other_scene ||
                     incoming.verdict == IncomingVerdict::former_life ||
                     incoming.verdict == IncomingVerdict::impostor;
  if (incoming.verdict == IncomingVerdict::impostor) {
    presence_.note_impostor(incoming.trailer.epoch, from, now);
    if (group != kBaseGroup) conclude(now);
  }
  if (group == kBaseGroup && fresh && !config_.interop) consume_control(datagram, now, from);
  // It may have announced itself in this very datagram.
  if (incoming.verdict == IncomingVerdict::use &&
      presence_.standing(trailer->epoch) != Standing::member) {
    incoming.verdict = IncomingVerdict::stranger;
  }
  ++incoming_[static_cast<std::size_t>(incoming.verdict)];
  if (leading_ && incoming.verdict == IncomingVerdict::use &&
      !tiers_.is_felt(tiers_.tier_of(group))) {
    leading_->receive(group, datagram, trailer->epoch, now, came.value_or(now));
  }
  return incoming;
}

// One network carries many exercises: who is of another is neither a newcomer nor disputes an
// address, whatever its datagram says besides.
bool AreaOfInterestManager::is_of_exercise(
    GroupIndex group, std::span<const std::byte> datagram,
    const std::optional<pdu::DatagramTrailer>& trailer) const noexcept {
  const std::uint8_t ours = presence_.own().header.exercise_id;
  if (trailer && trailer->header.exercise_id != ours) return false;
  if (group != kBaseGroup || config_.interop) return true;
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    if (bundled.error != pdu::DecodeError::none) continue;
    const bool tells = bundled.header.pdu_type == pdu::PduType::presence;
    if (tells && bundled.header.exercise_id != ours) return false;
  }
  return true;
}

IncomingVerdict AreaOfInterestManager::judge_datagram(GroupIndex group, const SourceAddress& from,
                                                      Incoming& incoming) noexcept {
  const pdu::DatagramTrailer& trailer = incoming.trailer;
  const Standing standing = presence_.standing(trailer.epoch, &from);
  if (standing == Standing::own) return IncomingVerdict::own;
  if (standing == Standing::former_life) return IncomingVerdict::former_life;
  if (standing == Standing::impostor) return IncomingVerdict::impostor;
  if (!hears(group)) return IncomingVerdict::not_joined;
  if (standing == Standing::other_scene) return IncomingVerdict::other_scene;
  // Until it has announced itself nobody knows whose numbers these are.
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

// Draws the consequences of what presence found out, and keeps the events for the peer.
void AreaOfInterestManager::conclude(nanoseconds now) {
  for (const PresenceEvent& event : presence_.take_events()) {
    switch (event.kind) {
      case PresenceEventKind::newcomer:
        introduce_ = introduce_ || !leading_;  // it asks the leaders of its cells
        break;
      case PresenceEventKind::renamed:
        introduce_ = true;
        break;
      case PresenceEventKind::restarted:
        sequences_.forget(event.former_epoch);
        if (leading_) leading_->role().forget(event.former_epoch, now);
        introduce_ = introduce_ || !leading_;
        break;
      case PresenceEventKind::moved:  // what was counted of it may have been another's
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
        // Until now somebody may have taken us for the rival of a former life, and dropped all.
        if (!presence_.peers().empty()) introductions_.begin(kBaseGroup, {}, now);
        continue;  // no news for the peer
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
  announce_memberships(now);
  introductions_.step(now);
  aggregator_.flush_due(now, sink);
  note_said(now);
}

void AreaOfInterestManager::lead(nanoseconds now) {
  if (!leading_) return;
  leading_->step(
      now, pdu::to_dis_timestamp(now + utc_offset_, synchronised_),
      [&](GroupIndex group, std::span<const std::byte> pdu) { aggregator_.add(group, pdu, now); });
  CellId cell;
  while (leading_->role().take_given_up(now, cell)) ask_owners(kCellTier, cell);
  if (leading_->role().take_plea(now)) ask_owners(kCellTier, kWholeScene);
}

void AreaOfInterestManager::note_said(nanoseconds now) noexcept {
  const std::uint64_t datagrams = aggregator_.counts().datagrams;
  if (datagrams != datagrams_said_) said_ = now;
  datagrams_said_ = datagrams;
}

void AreaOfInterestManager::flush(nanoseconds now, DatagramSink sink) {
  announce(now);
  lead(now);
  aggregator_.flush_all(now, sink);
}

nanoseconds AreaOfInterestManager::next_step() const noexcept {
  nanoseconds next = config_.interop ? nanoseconds::max() : presence_.next_step();
  next = std::min(next, introductions_.next_step());
  if (const auto due = aggregator_.next_deadline()) next = std::min(next, *due);
  if (leading_) next = std::min(next, leading_->next_step());
  const auto is_pending = [](const std::vector<std::byte>& cells) { return !cells.empty(); };
  if (asks_.has_new() || std::ranges::any_of(joined_, is_pending)) next = nanoseconds::min();
  return next;
}

std::span<const PresenceEvent> AreaOfInterestManager::take_events() {
  taken_.clear();
  std::swap(taken_, events_);
  return taken_;
}

}  // namespace reckon::aoim
