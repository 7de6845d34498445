// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/model_loop.hpp"

#include <algorithm>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/management/acknowledge.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/world/impact.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

using deadreckon::SendReason;
using std::chrono::nanoseconds;

constexpr nanoseconds kViewPeriod = std::chrono::milliseconds(50);
// A hand farther away than this is not worth the servo's time; nothing moves so far within one
// update.
constexpr double kContactReach = 0.25;  // [m] between surfaces

bool names(const pdu::EntityId& receiver, const pdu::EntityId& own) {
  const auto matches = [](std::uint16_t wanted, std::uint16_t mine) {
    return wanted == mine || wanted == 0xFFFF;
  };
  // Entity 0 addresses a simulation as a whole.
  return matches(receiver.site, own.site) && matches(receiver.application, own.application) &&
         (matches(receiver.entity, own.entity) || receiver.entity == 0);
}

}  // namespace

ModelLoop::ModelLoop(const ModelWiring& wiring, const ModelIdentity& identity)
    : scene_(wiring.scene),
      frame_(wiring.frame),
      pool_(wiring.pool),
      snapshots_(wiring.snapshots),
      contacts_(wiring.contacts),
      inbound_(wiring.inbound),
      outbound_(wiring.outbound),
      commands_(wiring.commands),
      shown_(wiring.shown),
      hand_(wiring.frame, to_force_model(wiring.scene.hand), wiring.scene.dead_reckoning,
            wiring.scene.convergence.settings.teleport_distance, identity.hand, identity.marking,
            wiring.scene.network.exercise),
      aoim_(aoim_config(wiring.scene), presence(wiring.scene, wiring.frame, wiring.pool, identity)),
      time_(identity.epoch, wiring.scene.network.exercise, wiring.counters),
      remote_(wiring.frame, aoim_,
              {wiring.scene.hand.radius, wiring.scene.convergence,
               wiring.scene.dead_reckoning.acceleration},
              wiring.counters),
      decoder_(wiring.scene.network.exercise, wiring.counters),
      notices_(64),
      aoim_watch_(wiring.scene, wiring.counters),
      sending_(wiring.counters),
      datagrams_refused_(wiring.counters.make(
          "datagrams_refused",
          "datagrams doubled, of a former life, another scene or exercise, or a stranger")),
      lost_(
          wiring.counters.make("datagrams_lost", "datagrams missing in their senders' numbering")),
      doubled_(wiring.counters.make("datagrams_doubled", "datagrams that arrived again")),
      reordered_(wiring.counters.make("datagrams_reordered", "datagrams that were overtaken")),
      write_overflow_(
          wiring.counters.make("write_overflow", "datagrams dropped because the writer lags")) {}

void ModelLoop::start(nanoseconds now) {
  started_ = next_view_ = now_ = now;
  static_cast<void>(commands_.push({pool_.base(), true}));
  subscribe();
  if (!scene_.network.interop) aoim_.start(now);
}

void ModelLoop::begin(nanoseconds now, nanoseconds utc) noexcept {
  time_.begin(now, utc);
  now_ = now;
  utc_ = time_.utc();
  aoim_.set_utc_offset(utc_ - now_, time_.is_aligned());
  if (const auto leap = time_.leap()) tell("this host's clock leapt by {:+.3f} s", *leap);
}

void ModelLoop::step(nanoseconds now, nanoseconds utc) noexcept {
  begin(now, utc);
  drain();
  take_presence_events();
  remote_.expire(now_);
  const bool moved = snapshots_.update();
  find_near();
  if (moved) consider_own();
  publish_contacts();
  publish_shown();
  emit(false);
  if (now_ >= next_view_) {
    subscribe();
    publish_view();
    next_view_ = now_ + kViewPeriod;
  }
}

void ModelLoop::stop(nanoseconds now, nanoseconds utc) noexcept {
  begin(now, utc);
  hand_.set_deactivated();
  snapshots_.update();
  if (snapshots_.read().step > 0) send_own(SendReason::event);
  aoim_.stop();
  emit(true);
}

// In: datagrams
// --------------------------------------------------------------------------------------

void ModelLoop::drain() noexcept {
  while (const InboundDatagram* datagram = inbound_.front()) {
    take_datagram(*datagram);
    inbound_.pop();
  }
  const aoim::SequenceCounts& counts = aoim_.sequences().counts();
  lost_.set(counts.lost);
  doubled_.set(counts.duplicated);
  reordered_.set(counts.reordered);
}

void ModelLoop::take_datagram(const InboundDatagram& datagram) noexcept {
  const auto index = pool_.index(datagram.group);
  const aoim::GroupIndex group =
      index ? aoim::GroupIndex{static_cast<std::uint16_t>(*index + 1)} : aoim::kBaseGroup;
  const std::span<const std::byte> octets(datagram.octets.data(), datagram.size);
  const aoim::Incoming incoming = aoim_.receive(group, octets, now_);
  // One that has not announced itself yet may run another scene; it will be introduced once it has.
  const bool stranger = incoming.verdict == aoim::IncomingVerdict::use &&
                        aoim_.presence().standing(incoming.trailer.epoch) != aoim::Standing::member;
  if (!aoim::is_usable(incoming.verdict) || stranger) return datagrams_refused_.add();

  const nanoseconds came = std::min(datagram.arrival, now_);
  const Arrival arrival{now_, utc_, came, incoming.trailer.epoch,
                        time_.hear(incoming.trailer, index ? octets.first(0) : octets, came)};
  for (const Inbound& update : decoder_.decode(octets, hand_.id())) {
    if (update.kind == Inbound::Kind::entity) {
      remote_.take(update, arrival, snapshots_.read());
    } else {
      take_control(update);
    }
  }
}

void ModelLoop::take_control(const Inbound& update) noexcept {
  if (!names(update.entity, hand_.id())) return;
  frozen_ = update.kind == Inbound::Kind::stop_freeze;
  hand_.set_frozen(frozen_);
  pdu::Acknowledge answer;
  answer.header.exercise_id = scene_.network.exercise;
  answer.header.timestamp = time_.stamp(utc_);
  answer.originating_entity_id = hand_.id();
  answer.receiving_entity_id = update.originator;
  answer.acknowledge_flag =
      frozen_ ? pdu::AcknowledgeFlag::stop_freeze : pdu::AcknowledgeFlag::start_resume;
  answer.response_flag = pdu::ResponseFlag::able_to_comply;
  answer.request_id = update.request_id;
  queue(answer);
  tell("{} by {}:{}:{}", frozen_ ? "frozen" : "resumed", update.originator.site,
       update.originator.application, update.originator.entity);
}

// In: who is here
// ------------------------------------------------------------------------------------

void ModelLoop::take_presence_events() noexcept {
  for (const aoim::PresenceEvent& event : aoim_.take_events()) {
    const aoim::PeerId peer = event.peer();
    switch (event.kind) {
      case aoim::PresenceEventKind::newcomer:
        break;
      case aoim::PresenceEventKind::restarted:
      case aoim::PresenceEventKind::departed:
      case aoim::PresenceEventKind::scene_mismatch:
        remote_.drop_peer(peer, Gone::left);
        break;
      case aoim::PresenceEventKind::timed_out:
        remote_.drop_peer(peer, Gone::silent);
        break;
      case aoim::PresenceEventKind::identity_changed:
        hand_.rename({peer.site, peer.application, hand_.id().entity});
        break;
    }
    static_cast<void>(notices_.push(notice_of(event)));
  }
}

void ModelLoop::subscribe() noexcept {
  const haptics::ServoSnapshot& servo = snapshots_.read();
  const std::array<aoim::Focus, 1> focus{
      {{to_position(servo.scp), servo.velocity.norm(), scene_.aoim.radius}}};
  const aoim::SubscriptionChange change = aoim_.set_foci(focus, now_);
  const auto command = [&](std::span<const aoim::GroupIndex> groups, bool join) {
    for (const aoim::GroupIndex group : groups) {
      if (group == aoim::kBaseGroup) continue;
      static_cast<void>(commands_.push({pool_.address(group.value - 1u), join}));
    }
  };
  command(change.join, true);
  command(change.leave, false);
  aoim_watch_.look(aoim_, change, now_, notices_);
}

// Out: the own hand
// ----------------------------------------------------------------------------------

// The hands that ours could touch within an update, at most as many as a servo takes, nearest
// first.
void ModelLoop::find_near() noexcept {
  near_count_ = 0;
  const Eigen::Vector3d device = snapshots_.read().device;
  for (const RemoteEntity& row : remote_.rows()) {
    if (!row.haptic) continue;
    const deadreckon::Pose pose = row.predicted(now_);
    const Near found{&row, pose.position + pose.orientation * row.model.point, pose.velocity};
    const auto apart = [&](const Near& near) { return (near.centre - device).squaredNorm(); };
    const double reach = row.model.radius + scene_.hand.radius + kContactReach;
    if (!(apart(found) <= reach * reach)) continue;

    const auto end = near_.begin() + static_cast<std::ptrdiff_t>(near_count_);
    const auto place = std::find_if(near_.begin(), end,
                                    [&](const Near& near) { return apart(found) < apart(near); });
    if (place == near_.end()) continue;
    near_count_ = std::min(near_count_ + 1, near_.size());
    std::move_backward(place, near_.begin() + static_cast<std::ptrdiff_t>(near_count_) - 1,
                       near_.begin() + static_cast<std::ptrdiff_t>(near_count_));
    *place = found;
  }
}

void ModelLoop::consider_own() noexcept {
  const haptics::ServoSnapshot& servo = snapshots_.read();
  const aoim::Position position = to_position(servo.scp);
  if (!scene_.network.interop &&
      aoim_.must_send(hand_.id(), position, last_group_, last_sent_, now_)) {
    hand_.event();
  }
  std::array<deadreckon::ProbeState, haptics::kMaxRemoteHands> probes;
  for (std::size_t i = 0; i < near_count_; ++i) {
    probes[i] = {near_[i].centre, near_[i].velocity, near_[i].row->model.radius};
  }
  sending_.checks.add();
  const SendReason reason = hand_.decide(servo, std::span(probes.data(), near_count_));
  if (reason != SendReason::none) send_own(reason);
  tell_impacts();
}

void ModelLoop::send_own(SendReason reason) noexcept {
  const haptics::ServoSnapshot& servo = snapshots_.read();
  const nanoseconds utc = utc_ - (now_ - servo.time);
  if (!hand_.build(servo, utc, reason, outgoing_)) return;
  outgoing_.state.header.timestamp = time_.stamp(utc);

  std::array<std::byte, kMaxHandRecords> records;
  const std::size_t size = store_records(outgoing_, records);
  const aoim::Position position = to_position(servo.scp);
  static_cast<void>(
      aoim_.send(outgoing_.state, position, std::span(records.data(), size), now_ + hold(reason)));
  last_group_ = aoim_.route(position);
  last_sent_ = now_;
  sending_.sent(reason, pdu::wire_size(outgoing_.state) + size);
}

// A pose that is off a little, or repeated, may wait for company; what is new or felt may not.
ModelLoop::Nanoseconds ModelLoop::hold(SendReason reason) const noexcept {
  const bool patient = reason == SendReason::position || reason == SendReason::orientation ||
                       reason == SendReason::heartbeat;
  return patient && near_count_ == 0 ? scene_.network.bundle_hold : nanoseconds(0);
}

// A hand that strikes another says so once, for tools that know impacts but no force models.
void ModelLoop::tell_impacts() noexcept {
  const haptics::ServoSnapshot& servo = snapshots_.read();
  const auto before = touched_;
  const auto end = before.begin() + static_cast<std::ptrdiff_t>(touched_count_);
  touched_count_ = 0;
  for (std::size_t i = 0; i < servo.count; ++i) {
    const haptics::ContactAccount& contact = servo.contacts[i];
    if (contact.ungated_force.isZero()) continue;
    touched_[touched_count_++] = contact.id;
    const RemoteEntity* row = remote_.find(contact.id);
    if (row != nullptr && std::find(before.begin(), end, contact.id) == end) {
      send_impact(*row, contact);
    }
  }
}

void ModelLoop::send_impact(const RemoteEntity& row,
                            const haptics::ContactAccount& contact) noexcept {
  const haptics::ServoSnapshot& servo = snapshots_.read();
  auto impact = impact_of(servo, scene_.hand.radius, contact, row, frame_, now_);
  if (!impact) return;
  const pdu::EntityId own = hand_.id();
  impact->header.exercise_id = scene_.network.exercise;
  impact->header.timestamp = time_.stamp(utc_);
  impact->issuing_entity_id = own;
  impact->event_id = {own.site, own.application, ++impacts_};
  std::array<std::byte, 128> octets;
  const std::size_t size = pdu::encode(*impact, octets);
  static_cast<void>(aoim_.send(std::span(octets.data(), size), to_position(servo.scp), now_));
}

template <typename Pdu>
void ModelLoop::queue(const Pdu& pdu) noexcept {
  std::array<std::byte, 256> octets;
  const std::size_t size = pdu::encode(pdu, octets);
  static_cast<void>(aoim_.send_to_all(std::span(octets.data(), size), now_));
}

void ModelLoop::emit(bool everything) noexcept {
  const auto sink = [this](aoim::GroupIndex group, std::span<const std::byte> octets) {
    push_datagram(group, octets);
  };
  pdu::TimeExchange exchange;
  if (aoim_.presence().is_due(now_) && time_.echo(hand_.id().simulation(), exchange)) {
    queue(exchange);
  }
  aoim_.step(now_, sink);
  if (everything) aoim_.flush(now_, sink);
}

void ModelLoop::push_datagram(aoim::GroupIndex group, std::span<const std::byte> octets) noexcept {
  Outbound* slot = outbound_.claim();
  if (slot == nullptr || octets.size() > slot->octets.size()) return write_overflow_.add();
  slot->group = group == aoim::kBaseGroup ? pool_.base() : pool_.address(group.value - 1u);
  slot->size = octets.size();
  std::copy(octets.begin(), octets.end(), slot->octets.begin());
  outbound_.publish();
}

// Out: the servo and the watchers
// --------------------------------------------------------------------

void ModelLoop::publish_contacts() noexcept {
  haptics::ContactSet& set = contacts_.write_slot();
  set.count = 0;
  set.frozen = frozen_;
  for (std::size_t i = 0; i < near_count_; ++i) {
    const RemoteEntity& row = *near_[i].row;
    haptics::RemoteHand& hand = set.hands[set.count++];
    hand.id = row.id;
    hand.state = row.state;
    hand.state_time = row.state_time;
    hand.model = row.model;
    hand.valid_until = row.valid_until;
    hand.version = row.version;
    hand.given_to_us = row.given_to_us;
    hand.need = row.need;
    hand.epoch = row.epoch;
  }
  contacts_.publish();
}

void ModelLoop::publish_shown() noexcept {
  if (shown_ == nullptr) return;
  for (const RemoteEntity& row : remote_.rows()) {
    static_cast<void>(shown_->push({now_, row.id, row.shown(now_).position}));
  }
}

void ModelLoop::publish_view() noexcept {
  PeerView& view = views_.write_slot();
  view.time = now_;
  view.own = hand_.id();
  view.servo = snapshots_.read();
  view.entities = remote_.rows().size();
  view.peers = aoim_.presence().peers().size();
  view.groups = aoim_.subscription().joined().size();
  view.frozen = frozen_;
  const nanoseconds heard = remote_.first_heard();
  view.first_remote = heard < nanoseconds(0) ? heard : heard - started_;
  view.count = std::min(view.entities, PeerView::kRows);
  for (std::size_t i = 0; i < view.count; ++i) {
    view.rows[i] = view_of(remote_.rows()[i], view.servo, now_);
  }
  views_.publish();
}

template <typename... Arguments>
void ModelLoop::tell(std::string_view format, const Arguments&... arguments) noexcept {
  static_cast<void>(notices_.push(make_notice(format, arguments...)));
}

}  // namespace reckon::peer
