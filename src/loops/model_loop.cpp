// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/model_loop.hpp"

#include <algorithm>
#include <bit>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/management/acknowledge.hpp"
#include "reckon/peer/loops/address_text.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/world/addressed.hpp"
#include "reckon/peer/world/interaction_issuers.hpp"

namespace reckon::peer {
namespace {

using deadreckon::SendReason;
using std::chrono::nanoseconds;

constexpr nanoseconds kViewPeriod = std::chrono::milliseconds(50);

constexpr std::size_t kMostTaken = 512;  // datagrams a step of which something is taken, some 1 ms
// Datagrams that are looked through for overtaken states at a time, and where nearly all were
// overtaken: as many large ones as the ring holds.
constexpr std::size_t kAtOnce = 512, kFarAtOnce = 1408;
constexpr std::size_t kMostSeen = 4096;  // with those of which all is overtaken, some 1 ms more
constexpr std::size_t kBacklog = 16;     // fewer that wait are no backlog

RemoteSettings settings_of(const ModelWiring& wiring) {
  RemoteSettings settings = remote_settings(wiring.scene);
  settings.capacity = wiring.capacity;
  settings.record_changes = wiring.record_changes;
  return settings;
}

aoim::AreaOfInterestConfig with_secret(aoim::AreaOfInterestConfig config,
                                       const aoim::ChainLink& secret) {
  config.presence.secret = secret;
  return config;
}

// Forms in which a state may be a key, which others are read by.
bool leans_on_states(pdu::CompressedForm form) {
  return form == pdu::CompressedForm::delta || form == pdu::CompressedForm::residual;
}

const haptics::ServoSnapshot& no_servo() {
  static const haptics::ServoSnapshot none;
  return none;
}

}  // namespace

ModelLoop::ModelLoop(const ModelWiring& wiring, const ModelIdentity& identity)
    : scene_(wiring.scene),
      frame_(wiring.frame),
      pool_(wiring.pool),
      inbound_(wiring.inbound),
      felt_(wiring.felt),
      outbound_(wiring.outbound),
      commands_(wiring.commands),
      shown_(wiring.shown),
      muted_(wiring.muted),
      known_(wiring.known),
      tap_(wiring.tap),
      epoch_(identity.epoch),
      owned_(wiring.frame, owner_settings(wiring.scene, identity)),
      aoim_(with_secret(aoim_config(wiring.scene, wiring.frame), identity.secret),
            presence(wiring.scene, wiring.frame, wiring.pool, identity)),
      time_(identity.epoch, wiring.scene.network.exercise, wiring.counters),
      remote_(wiring.frame, aoim_, settings_of(wiring), wiring.counters),
      decoder_(wiring.scene.network.exercise, wiring.counters, wiring.scene.network.compression,
               wiring.capacity),
      queued_(kFarAtOnce),
      admitted_(kFarAtOnce),
      overtaken_(wiring.scene.network.exercise, kFarAtOnce, wiring.scene.aoim.awareness.channels),
      cover_(cells_of(wiring.scene.aoim)),
      contact_foci_(wiring.scene),
      sender_(wiring.scene.network, aoim_, time_, wiring.counters),
      notices_(256),
      aoim_watch_(wiring.scene, wiring.counters),
      limit_watch_(wiring.capacity, wiring.counters),
      silence_watch_(wiring.counters),
      leader_watch_(wiring.counters, wiring.scene.aoim.leaders),
      beacon_watch_(wiring.scene.aoim.follow),
      channel_keeper_(wiring.scene.aoim.awareness),
      link_watch_(wiring.link, wiring.pool.base(), wiring.counters),
      counted_(wiring.counters) {}

// A pass
// ---------------------------------------------------------------------------------------------

void ModelLoop::start(nanoseconds now) {
  started_ = next_view_ = pass_.now = now;
  static_cast<void>(commands_.push({pool_.base(), true}));
  subscribe();
  if (!scene_.network.interop) aoim_.start(now);
}

void ModelLoop::begin(nanoseconds now, nanoseconds utc) noexcept {
  drop_stale(now);
  time_.begin(now, utc);
  pass_ = {now, time_.utc()};
  aoim_.set_utc_offset(pass_.utc - pass_.now, time_.is_aligned());
  if (const auto leap = time_.leap()) tell("this host's clock leapt by {:+.3f} s", *leap);
}

// What had to leave while this process stood still is not sent as new: the predictors send what has
// changed since, and heartbeats the rest.
void ModelLoop::drop_stale(nanoseconds now) noexcept {
  const std::optional<nanoseconds> due = aoim_.aggregator().next_deadline();
  const bool is_stale = due && *due > pass_.now && now - *due > NetworkReadLoop::kStale;
  if (!is_stale) return;
  aoim_.empty(now, [this](aoim::GroupIndex group, std::span<const std::byte> octets) {
    counted_.stale_unsent.add();
    if (tap_ != nullptr) tell_numbered(group, octets, DatagramFate::stale_unsent);
  });
}

void ModelLoop::step(nanoseconds now, nanoseconds utc) noexcept {
  begin(now, utc);
  drain();
  take_presence_events();
  take_relayed();
  doubt_the_silent();
  tell_what_is_felt();
  remote_.expire(now);
  tracked_.advance(now, [this](EntityNumber number, const EntityTruth& t) { move(number, t); });
  if (guest_ != nullptr) guest_->begin_pass(*this);
  read_hands();
  answer_bodies();
  find_near();
  consider_hands();
  consider_bodies();
  consider_others();
  publish_all_contacts();
  publish_shown();
  emit(false);
  if (guest_ != nullptr) guest_->end_pass(*this);
  if (now >= next_view_) {
    subscribe();
    remote_.look_shown(now);
    remote_.look_outside(now);
    channel_keeper_.look(remote_, aoim_, now, notices_);
    tell_muted();
    known_.publish(aoim_.presence());
    notice_gate_.look(now, notices_);
    publish_view();
    next_view_ = now + kViewPeriod;
  }
}

bool ModelLoop::stop(nanoseconds now, nanoseconds utc) noexcept {
  begin(now, utc);
  if (goodbyes_ == 0) read_hands();
  for (std::size_t room = outbound_.room(); room > 0 && goodbyes_ < owned_.last_number(); --room) {
    OwnedEntity* entity = owned_.find(static_cast<EntityNumber>(++goodbyes_));
    if (entity == nullptr || entity->truth().time <= nanoseconds(0)) continue;
    const HandPort* port = port_of(static_cast<EntityNumber>(goodbyes_));
    entity->set_deactivated();
    sender_.send(*entity, pass_, port != nullptr ? port->servo().time : pass_.now, {},
                 port != nullptr ? port->accounts() : std::span<const EnergyAccount>());
  }
  const bool done = goodbyes_ >= owned_.last_number();
  if (done) aoim_.stop();
  emit(true);
  return done;
}

// In: datagrams
// --------------------------------------------------------------------------------------

void ModelLoop::drain() noexcept {
  if (felt_ != nullptr) drain(*felt_);
  drain(inbound_);
  const aoim::SequenceCounts& counts = aoim_.sequences().counts();
  counted_.lost.set(counts.lost);
  counted_.doubled.set(counts.duplicated);
  counted_.leaps.set(counts.leaps);
  counted_.reordered.set(counts.reordered);
  counted_.numberings_given_up.set(counts.given_up);
}

// So many at a time that a flood does not keep the own hand from being sent.
void ModelLoop::drain(DatagramRing& ring) noexcept {
  std::size_t taken = 0, seen = 0;
  while (taken < kMostTaken && seen < kMostSeen) {
    const bool far = looks_far_ && &ring == &inbound_;
    const std::size_t most = far ? kFarAtOnce : std::min(kAtOnce, kMostTaken - taken);
    const std::size_t count = ring.front(std::span(queued_).first(most));
    if (count == 0) break;
    const std::size_t now_taken = take_datagrams(std::span(queued_).first(count));
    ring.pop();
    if (&ring == &inbound_) looks_far_ = count >= kAtOnce && 2 * now_taken < kAtOnce;
    taken += now_taken;
    seen += count;
  }
}

// Returns of how many something was taken.
std::size_t ModelLoop::take_datagrams(std::span<const QueuedDatagram> datagrams) noexcept {
  std::size_t count = 0, taken = datagrams.size();
  for (const QueuedDatagram& datagram : datagrams) count += admit(datagram, admitted_[count]);
  const std::span<const ArrivedDatagram> admitted = std::span(admitted_).first(count);
  const bool backlog = count >= kBacklog && !leans_on_states(scene_.network.compression);
  if (backlog) overtaken_.look(admitted);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t overtaken = backlog ? overtaken_.of(i) : 0;
    if (backlog && overtaken_.is_whole(i)) {
      decoder_.leave_out(static_cast<std::size_t>(std::popcount(overtaken)),
                         admitted[i].arrival.epoch != 0);
      --taken;
      continue;
    }
    const std::span<const Inbound> updates =
        decoder_.decode(admitted[i].octets, owned_.simulation().simulation(), overtaken,
                        key_speaker(admitted[i].arrival));
    remote_.prefetch(updates);
    for (const Inbound& update : updates) take_update(update, admitted[i].arrival);
  }
  return taken;
}

// Whose words may be keys of compressed states: those of peers, of what is their own.
KeySpeaker ModelLoop::key_speaker(const Arrival& arrival) const noexcept {
  if (arrival.epoch == 0 || !leans_on_states(scene_.network.compression)) return {};
  const auto id = aoim_.presence().id_of(arrival.epoch);
  return id ? KeySpeaker{*id, arrival.epoch, arrival.from} : KeySpeaker{};
}

// False where a datagram is not to be read.
bool ModelLoop::admit(const QueuedDatagram& datagram, ArrivedDatagram& admitted) noexcept {
  const auto index = pool_.index(datagram.group);
  if (!index && datagram.group != pool_.base()) {
    counted_.unicast_refused.add();
    if (tap_ != nullptr)
      tap_->note(DatagramTap::Loop::model, DatagramFate::unicast, datagram.group, datagram.octets);
    return false;
  }
  const aoim::GroupIndex group =
      index ? aoim::GroupIndex{static_cast<std::uint16_t>(*index + 1)} : aoim::kBaseGroup;
  const std::span<const std::byte> octets = datagram.octets;
  const aoim::SourceAddress from = source_of(datagram.sender, datagram.boot);
  const std::uint64_t lost_before = aoim_.sequences().counts().lost;
  const nanoseconds came = std::min(datagram.arrival, pass_.now);
  const aoim::Incoming incoming = aoim_.receive(group, octets, pass_.now, from, came);
  if (tap_ != nullptr) tell_judged(datagram, incoming, lost_before);
  if (!aoim::is_usable(incoming.verdict)) return counted_.datagrams_refused.add(), false;

  const ClockEvidence clock = time_.hear(incoming.trailer, index ? octets.first(0) : octets, came);
  const bool of_cell = group.value <= scene_.aoim.pool;
  admitted = {octets,
              {pass_.now, pass_.utc, came, incoming.trailer.epoch, clock, from,
               of_cell ? aoim::kBaseGroup : group}};
  remote_.heard(from, pass_.now);
  return true;
}

void ModelLoop::take_update(const Inbound& update, const Arrival& arrival) noexcept {
  if (update.kind == Inbound::Kind::claim) {
    static_cast<void>(remote_.hear(std::span(&update.entity, 1), arrival));
    return;
  }
  if (update.kind != Inbound::Kind::entity) return take_interaction(update, arrival);
  const haptics::ServoSnapshot& servo = hands_.empty() ? no_servo() : hands_.front().servo();
  if (!remote_.take(update, arrival, servo)) return;
  for (std::size_t i = 0; i < update.account_count; ++i) {
    const pdu::EnergyAccountRecord& account = update.accounts[i];
    const OwnedEntity* own = owned_.find(account.counterpart.entity);
    if (own == nullptr || own->touch() == nullptr) continue;
    HeardAccount& pair = books_.pair(account.counterpart.entity, update.entity, pass_.now);
    pair.given = account.given;
    pair.need = pdu::from_microjoules(account.need);
    pair.spring_need = pdu::from_microjoules(account.spring_need);
    pair.unanswered = true;
  }
}

// In another's name it is neither obeyed nor heard.
void ModelLoop::take_interaction(const Inbound& update, const Arrival& arrival) noexcept {
  const bool order = update.kind != Inbound::Kind::other;
  if (order && !obeys(update, arrival)) return;
  const InteractionIssuers issuers = issuers_of(update.pdu.header, update.pdu.bytes);
  const Voice voice = remote_.hear(issuers.ids(), arrival);
  if (voice == Voice::refused) return counted_.interactions_refused.add();
  if (guest_ != nullptr) {
    const auto peer = arrival.epoch == 0 ? std::nullopt : aoim_.presence().id_of(arrival.epoch);
    guest_->hear(update.pdu.header, update.pdu.bytes, {arrival.from, peer, voice == Voice::owner});
  }
  if (order) take_control(update, arrival);
}

void ModelLoop::take_control(const Inbound& update, const Arrival& arrival) noexcept {
  if (!is_addressed(update.entity, owned_.simulation().simulation())) return;
  const bool frozen = update.kind == Inbound::Kind::stop_freeze;
  if (is_whole(update.entity)) {
    owned_.for_each([&](OwnedEntity& entity, EntityNumber number) {
      entity.set_frozen(frozen);
      owned_.look_at(number);
    });
    answer(update, arrival, own_id());
  } else if (OwnedEntity* entity = owned_.find(update.entity.entity)) {
    entity->set_frozen(frozen);
    owned_.look_at(update.entity.entity);
    answer(update, arrival, entity->id());
  }
}

void ModelLoop::answer(const Inbound& update, const Arrival& arrival,
                       const pdu::EntityId& own) noexcept {
  const bool frozen = update.kind == Inbound::Kind::stop_freeze;
  pdu::Acknowledge answer;
  answer.header.exercise_id = scene_.network.exercise;
  answer.header.timestamp = time_.stamp(pass_.utc);
  answer.originating_entity_id = own;
  answer.receiving_entity_id = update.originator;
  answer.acknowledge_flag =
      frozen ? pdu::AcknowledgeFlag::stop_freeze : pdu::AcknowledgeFlag::start_resume;
  answer.response_flag = pdu::ResponseFlag::able_to_comply;
  answer.request_id = update.request_id;
  queue(answer);
  tell("{} by {}:{}:{} at {}", frozen ? "frozen" : "resumed", update.originator.site,
       update.originator.application, update.originator.entity, AddressText(arrival.from).view());
}

template <typename Pdu>
void ModelLoop::queue(const Pdu& pdu) noexcept {
  std::array<std::byte, 512> octets;
  const std::size_t size = pdu::encode(pdu, octets);
  static_cast<void>(say(std::span(octets.data(), size), std::nullopt));
}

void ModelLoop::emit(bool everything) noexcept {
  const auto sink = [this](aoim::GroupIndex group, std::span<const std::byte> octets) {
    push_datagram(group, octets);
  };
  pdu::TimeExchange exchange;
  if (aoim_.presence().is_due(pass_.now) &&
      time_.echo(owned_.simulation().simulation(), exchange)) {
    queue(exchange);
  }
  aoim_.step(pass_.now, sink);
  if (everything) aoim_.flush(pass_.now, sink);
}

// Out: the servo and the watchers
// --------------------------------------------------------------------

void ModelLoop::publish_shown() noexcept {
  if (shown_ == nullptr) return;
  for (const RemoteEntity& row : remote_.rows()) {
    static_cast<void>(shown_->push({pass_.now, row.id, row.shown(pass_.now).position}));
  }
}

// Where the first hand is, or the first entity, or the scene's origin.
Eigen::Vector3d ModelLoop::middle_of_interest() const noexcept {
  if (!hands_.empty()) return hands_.front().servo().device;
  const OwnedEntity* first = owned_.find(own_id().entity);
  return first != nullptr ? first->truth().position : Eigen::Vector3d::Zero();
}

void ModelLoop::publish_view() noexcept {
  PeerView& view = views_.write_slot();
  std::size_t unfelt = 0;
  view.time = pass_.now;
  view.own = own_id();
  view.owned = owned_.size();
  view.power_given = power_given_j_;
  view.hand_count = hands_.size();
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    view.hands[i] = {owned_.find(hands_[i].hand())->id(), hands_[i].servo(), stiffness_[i]};
    unfelt = std::max(unfelt, hands_[i].servo().left_out);
  }
  refusal_watch_.look(remote_, owned_.simulation().simulation(), pass_.now);
  limit_watch_.look(unfelt, crowder_, remote_.last_refused(), pass_.now, notices_);
  link_watch_.look(pass_.now, notices_);
  aoim_.note_own_source(source_of(link_watch_.own_endpoint(), 0), pass_.now);
  view.entities = remote_.rows().size();
  view.peers = aoim_.presence().peers().size();
  view.groups = aoim_.joined_groups();
  view.leaders = leader_watch_.view();
  const OwnedEntity* first = owned_.find(view.own.entity);
  view.frozen = first != nullptr && first->is_frozen();
  const nanoseconds heard = remote_.first_heard();
  view.set_out = tracked_.begun();
  view.first_remote = heard < nanoseconds(0) ? heard : heard - started_;
  view.middle = middle_of_interest();
  view.count = 0;
  for (const std::uint32_t place : view_choice_.choose(remote_.rows(), view.middle)) {
    view.rows[view.count++] = view_of(remote_.rows()[place], view.own_hands(), pass_.now);
  }
  views_.publish();
}

template <typename... Arguments>
void ModelLoop::tell(std::string_view format, const Arguments&... arguments) noexcept {
  static_cast<void>(notices_.push(make_notice(format, arguments...)));
}

}  // namespace reckon::peer
