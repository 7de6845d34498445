// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/model_loop.hpp"

#include <algorithm>
#include <array>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/loops/send_pdu.hpp"
#include "reckon/peer/world/interaction_issuers.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// With newcomers, every entity is checked within this many passes.
constexpr std::size_t kIntroductionPasses = 8;
constexpr std::size_t kLeastAsked = 1024;  // in one pass

RemoteSettings settings_of(const ModelWiring& wiring, const aoim::BodyOwners* owners) {
  RemoteSettings settings = remote_settings(wiring.scene);
  settings.body_owners = owners;
  settings.record_changes = wiring.record_changes;
  return settings;
}

aoim::AreaOfInterestConfig config_of(const ModelWiring& wiring, const aoim::ChainLink& secret,
                                     const aoim::BodyOwners* owners) {
  aoim::AreaOfInterestConfig config = aoim_config(wiring.scene, wiring.frame, wiring.link);
  config.body_owners = owners;
  config.presence.secret = secret;
  return config;
}

}  // namespace

ModelLoop::ModelLoop(const ModelWiring& wiring, const ModelIdentity& identity)
    : scene_(wiring.scene),
      counted_(wiring.counters),
      owned_(wiring.frame, owner_settings(wiring.scene, identity)),
      bodies_(wiring),
      aoim_(config_of(wiring, identity.secret, bodies_.owners()),
            presence(wiring.scene, wiring.frame, wiring.pool, identity)),
      time_(identity.epoch, wiring.scene.network.exercise, wiring.counters),
      remote_(wiring.frame, aoim_, settings_of(wiring, bodies_.owners()), wiring.counters),
      sender_(wiring.scene.network, aoim_, time_, hooks_, wiring.counters),
      intake_(wiring, aoim_, time_, remote_, hooks_, counted_),
      outlet_(wiring, counted_),
      touch_(wiring, identity.epoch, {owned_, remote_, aoim_, sender_, time_, counted_}),
      subscriber_(wiring, aoim_, owned_, remote_),
      watches_(wiring),
      hooks_(wiring),
      orders_(wiring.scene.network, aoim_, owned_, time_, watches_, counted_),
      assured_(wiring, identity.epoch, aoim_, time_, hooks_, outlet_, watches_.notices()),
      ownership_(wiring, identity,
                 {aoim_, assured_, bodies_, owned_, remote_, touch_, time_, watches_.notices()}),
      records_(wiring.counters, identity.epoch, aoim_, assured_),
      view_(wiring) {}

// A pass

void ModelLoop::start(nanoseconds now) {
  pass_.now = now;
  view_.start(now);
  subscriber_.join_base();
  subscriber_.subscribe(now, touch_.bodies_in_reach(), watches_.notices());
  if (!scene_.network.interop) aoim_.start(now);
}

void ModelLoop::begin(nanoseconds now, nanoseconds utc) noexcept {
  drop_stale(now);
  outlet_.begin(now);
  time_.begin(now, utc);
  pass_ = {now, time_.utc()};
  aoim_.set_utc_offset(pass_.utc - pass_.now, time_.is_aligned());
  if (const auto leap = time_.leap())
    report(NoticeKind::clock_leap, "this host's clock leapt by {:+.3f} s", *leap);
}

// Datagrams that became due while this process was suspended are stale and dropped: later updates
// replace them.
void ModelLoop::drop_stale(nanoseconds now) noexcept {
  const std::optional<nanoseconds> due = aoim_.aggregator().next_deadline();
  const bool is_stale = due && *due > pass_.now && now - *due > NetworkReadLoop::kStale;
  if (!is_stale) return;
  aoim_.flush(now, [this](aoim::GroupIndex group, std::span<const std::byte> octets) {
    outlet_.drop_stale(group, octets);
  });
}

void ModelLoop::step(nanoseconds now, nanoseconds utc) noexcept {
  trace_.begin_pass(now);
  begin(now, utc);
  read_sensors();
  trace_.end(LoopStage::sensors);
  if (guest_ != nullptr) guest_->begin_pass(*this);
  trace_.end(LoopStage::actions);
  do_tasks();
  trace_.end(LoopStage::tasks);
  publish();
  trace_.end(LoopStage::publish);
}

void ModelLoop::read_sensors() noexcept {
  intake_.read(pass_, owned_.simulation().simulation(), assured_, *this);
  deliver_events(aoim_, *this, pass_.now);
  doubt_silent_peers();
  remote_.expire(pass_.now);
  if (touch_.read_hands()) subscriber_.note_moved();
  bodies_.read(pass_.now, owned_);
  ownership_.step(pass_);
  bodies_.move_own(owned_, [this](EntityNumber number, const EntityTruth& truth, bool is_knocked) {
    if (move(number, truth) && is_knocked) owned_.find(number)->event();
  });
}

void ModelLoop::do_tasks() noexcept {
  tracked_.advance(pass_.now,
                   [this](EntityNumber number, const EntityTruth& t) { move(number, t); });
  returned_.resend_touchable(owned_, pass_.now);
  touch_.answer_bodies(pass_);
  touch_.find_near(pass_);
  touch_.consider(pass_);
  consider_others();
}

void ModelLoop::publish() noexcept {
  bodies_.publish(pass_.utc - pass_.now, remote_);
  touch_.publish_contacts(pass_);
  touch_.publish_felt_sources();
  records_.step(pass_);
  view_.publish_shown(remote_, pass_.now);
  emit(false);
  if (guest_ != nullptr) guest_->end_pass(*this);
  if (pass_.now >= view_.next()) {
    look_around();
    publish_view();
  }
}

// Called some twenty times a second.
void ModelLoop::look_around() noexcept {
  subscriber_.subscribe(pass_.now, touch_.bodies_in_reach(), watches_.notices());
  remote_.look_shown(pass_.now);
  remote_.look_outside(pass_.now);
}

// Bodies of the scene stay, for their next owner.
bool ModelLoop::stop(nanoseconds now, nanoseconds utc) noexcept {
  begin(now, utc);
  if (goodbyes_ == 0 && touch_.read_hands()) subscriber_.note_moved();
  for (std::size_t room = outlet_.room(); room > 0 && goodbyes_ < owned_.last_number(); --room) {
    OwnedEntity* entity = owned_.find(static_cast<EntityNumber>(++goodbyes_));
    if (entity == nullptr || entity->is_body() || entity->truth().time <= nanoseconds(0)) continue;
    const HandPort* port = touch_.port_of(static_cast<EntityNumber>(goodbyes_));
    entity->set_deactivated();
    sender_.send(*entity, pass_, port != nullptr ? port->servo().time : pass_.now, {},
                 port != nullptr ? port->accounts() : std::span<const EnergyAccount>());
  }
  const bool done = goodbyes_ >= owned_.last_number();
  if (done) aoim_.stop();
  emit(true);
  return done;
}

// The entities of this peer

EntityNumber ModelLoop::add_hand(std::string_view marking,
                                 haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots,
                                 haptics::TripleBuffer<haptics::ContactSet>& contacts,
                                 const DeviceStiffness& stiffness) {
  const auto number = static_cast<EntityNumber>(touch_.hand_count() + 1);
  touch_.add_hand(number, snapshots, contacts, stiffness);
  EntityDescription hand;
  hand.marking = marking;
  hand.type = hand_type();
  hand.force_id = pdu::ForceId::friendly;
  hand.dead_reckoning = scene_.dead_reckoning;
  hand.model = to_force_model(scene_.hand);
  // Both sides of a contact show the softer of two hands; else one would feel a force that the
  // other cannot.
  hand.model->k1 = std::min(hand.model->k1, stiffness.hands);
  report_softened(hand.marking, stiffness, watches_.notices());
  owned_.add(number, hand);
  aoim_.introductions().set_owned(owned_.size());
  return number;
}

bool ModelLoop::add(EntityNumber number, const EntityDescription& description,
                    const EntityTruth& truth) {
  if (!owned_.add(number, description, truth)) return false;
  aoim_.introductions().set_owned(owned_.size());
  subscriber_.note_moved();
  if (!description.beacon.empty()) subscriber_.add_beacon(number, description.beacon);
  if (description.model) touch_.add_body(number, description.power);
  return true;
}

void ModelLoop::add_bodies(EntityNumber first) {
  bodies_.add_own(first, owned_);
  aoim_.introductions().set_owned(owned_.size());
  subscriber_.note_moved();
}

void ModelLoop::follow(EntityNumber number, const EntityTrack& track) {
  const OwnedEntity* entity = owned_.find(number);
  if (entity != nullptr) tracked_.add(number, track, entity->touch() != nullptr);
}

bool ModelLoop::move(EntityNumber number, const EntityTruth& truth) noexcept {
  OwnedEntity* entity = owned_.find(number);
  if (entity == nullptr || !entity->move(truth)) return false;
  subscriber_.note_moved();
  owned_.look_at(number);
  return true;
}

bool ModelLoop::remove(EntityNumber number) noexcept {
  OwnedEntity* entity = owned_.find(number);
  if (entity == nullptr || touch_.is_hand(number)) return false;
  entity->set_deactivated();
  if (entity->last_built() > nanoseconds(0)) {
    sender_.send(*entity, pass_, pass_.now, {});
  }
  subscriber_.remove_beacon(number);
  touch_.remove_body(number);
  owned_.remove(number);
  aoim_.introductions().set_owned(owned_.size());
  subscriber_.note_moved();
  return true;
}

aoim::AddResult ModelLoop::send(std::span<const std::byte> pdu,
                                const std::optional<aoim::Position>& place) {
  const std::size_t tier = place ? aoim::kCellTier : aoim::kEverybody;
  return aoim_.send(tier, aoim::PduPayload{pdu}, place.value_or(aoim::Position{}), pass_.now);
}

// Out

void ModelLoop::consider_others() noexcept {
  if (aoim_.introductions().is_pending()) {
    const std::size_t asked = std::max(owned_.last_number() / kIntroductionPasses, kLeastAsked);
    owned_.for_each_next(asked, [&](OwnedEntity& entity, EntityNumber number) {
      if (entity.is_ours() && sender_.is_asked(entity, pass_)) owned_.look_at(number);
    });
  }
  std::size_t room = outlet_.paced_room();
  owned_.for_each_waiting(pass_.now, [&](OwnedEntity& entity, EntityNumber number) {
    if (room == 0) return false;
    if (consider_other(entity, number)) --room;
    return true;
  });
}

bool ModelLoop::consider_other(OwnedEntity& entity, EntityNumber number) noexcept {
  const bool is_sent = entity.is_ours() && entity.truth().time > nanoseconds(0);
  if (!is_sent || touch_.is_hand(number)) return false;
  const PortlessBody* body = entity.touch() == nullptr ? nullptr : touch_.body_of(number);
  return sender_.consider(entity, pass_, pass_.now, {},
                          body == nullptr ? std::span<const EnergyAccount>() : body->accounts());
}

void ModelLoop::emit(bool everything) noexcept {
  const auto sink = [this](aoim::GroupIndex group, std::span<const std::byte> octets) {
    if (!hooks_.leaving.pass({group, octets})) return outlet_.withhold(group, octets);
    hooks_.sent(octets);
    outlet_.push(group, octets);
  };
  pdu::TimeExchange exchange;
  if (aoim_.presence().is_due(pass_.now)) {
    aoim_.note_own_source(source_of(outlet_.source(), 0), pass_.now);
    if (time_.echo(owned_.simulation().simulation(), exchange))
      send_pdu(aoim_, exchange, std::nullopt, pass_.now);
  }
  assured_.step(pass_);
  aoim_.step(pass_.now, sink);
  if (everything) aoim_.flush(pass_.now, sink);
}

// Position of the first hand, or of the first entity, or the scene's origin.
Eigen::Vector3d ModelLoop::middle_of_interest() const noexcept {
  if (touch_.hand_count() > 0) return touch_.servo().device;
  const OwnedEntity* first = owned_.find(own_id().entity);
  return first != nullptr ? first->truth().position : Eigen::Vector3d::Zero();
}

void ModelLoop::publish_view() noexcept {
  PeerView& view = view_.begin();
  watches_.look(remote_, aoim_.presence().id(), pass_.now);
  hooks_.look({remote_, aoim_, touch_.show(view), ownership_.unpressed(), touch_.crowder(),
               pass_.now, watches_.notices()});
  view.own = own_id();
  view.owned = owned_.ours();
  view.peers = aoim_.presence().peers().size();
  view.groups = aoim_.subscriptions().joined_groups();
  view.leaders = subscriber_.leaders();
  const OwnedEntity* first = owned_.find(view.own.entity);
  view.frozen = first != nullptr && first->is_frozen();
  bodies_.show(view);
  ownership_.show(view);
  view.set_out = tracked_.begun();
  view.middle = middle_of_interest();
  emissions_.expire(pass_.now);
  counted_.emissions_refused.set(emissions_.refusals().all());
  view_.publish(view, remote_, emissions_, pass_.now);
}

// In

void ModelLoop::take_update(const Inbound& update, const Arrival& arrival) noexcept {
  if (update.kind == Inbound::Kind::claim) {
    static_cast<void>(remote_.sender_right(std::span(&update.entity, 1), arrival));
    return;
  }
  if (!assured_.admits(update, arrival)) return;
  if (update.kind != Inbound::Kind::entity)
    return assured_.conclude(update, take_interaction(update, arrival));
  ownership_.note_state(update, arrival);
  if (!remote_.take(update, arrival, touch_.servo())) return;
  touch_.note_accounts(update, pass_);
  bodies_.note(update, arrival, remote_);
}

// A forged PDU is neither obeyed nor delivered; then false.
bool ModelLoop::take_interaction(const Inbound& update, const Arrival& arrival) noexcept {
  if (ownership_.takes(update, arrival)) return true;
  const bool order = update.kind != Inbound::Kind::other;
  if (order && !orders_.obeys(update, arrival, pass_)) return false;
  const InteractionIssuers issuers = issuers_of(update.pdu.header, update.pdu.bytes);
  const SenderRight right = remote_.sender_right(issuers.ids(), arrival);
  if (right == SenderRight::refused) return counted_.interactions_refused.add(), false;
  const bool is_owner = right == SenderRight::owner;
  if (guest_ != nullptr) {
    const auto peer = arrival.epoch == 0 ? std::nullopt : aoim_.presence().id_of(arrival.epoch);
    guest_->receive(update.pdu.header, update.pdu.bytes, {arrival.from, peer, is_owner});
  }
  if (order) return orders_.carry_out(update, arrival, own_id(), pass_), true;
  emissions_.take(update.pdu.bytes, {arrival.from, arrival.arrival, arrival.epoch == 0, is_owner});
  return true;
}

void ModelLoop::claim(const aoim::PeerId& name, std::uint32_t epoch) noexcept {
  remote_.claim(name, epoch);
}

void ModelLoop::drop(const aoim::PresenceEvent::Dropped& life, bool silent) noexcept {
  remote_.drop_peer(life.name, silent ? Gone::silent : Gone::left, pass_.now);
  emissions_.drop(life.name);
  intake_.forget_keys(life.epoch);
  assured_.drop(life);
}

void ModelLoop::rename(const aoim::PeerId& own) noexcept { owned_.rename(own); }

void ModelLoop::report(const aoim::PresenceEvent& event) noexcept {
  if (event.kind == aoim::PresenceEventKind::heard_again) returned_.note(pass_.now);
  watches_.report(event, pass_.now);
}

void ModelLoop::receive(const aoim::RelayedState& relayed,
                        const aoim::SourceAddress& from) noexcept {
  Inbound update;
  update.has_state = true;
  if (pdu::decode(relayed.octets, update.state) != pdu::DecodeError::none) return;
  update.entity = update.state.entity_id;
  if ((update.has_model = relayed.model.has_value())) update.model = *relayed.model;
  update.ownership = relayed.ownership;
  const Arrival arrival{pass_.now,
                        pass_.utc,
                        std::min(relayed.heard, pass_.now),
                        relayed.epoch,
                        time_.evidence(relayed.epoch),
                        from};
  subscriber_.note_relayed();
  if (!hooks_.admits(relayed.octets, arrival)) return;
  take_update(update, arrival);
}

void ModelLoop::doubt_silent_peers() noexcept {
  std::array<Touched, kMaxDevices * haptics::kMaxRemoteHands> touched;
  const std::size_t count = touch_.copy_touched(touched);
  for (const Touched& hand : std::span(touched).first(count)) {
    if (const RemoteEntity* row = remote_.find(hand.id)) aoim_.note_touched(row->epoch, pass_.now);
  }
  if (watches_.doubt_silent(aoim_.presence(), std::span(touched).first(count), remote_, pass_.now))
    returned_.note(pass_.now);
}

template <typename... Arguments>
void ModelLoop::report(NoticeKind kind, std::string_view format,
                       const Arguments&... arguments) noexcept {
  static_cast<void>(watches_.notices().push(make_notice(kind, format, arguments...)));
}

}  // namespace reckon::peer
