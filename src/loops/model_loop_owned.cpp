// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The half of the model loop that looks after the entities of this peer.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/peer/loops/contact_publisher.hpp"
#include "reckon/peer/loops/model_loop.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/world/impact.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

using deadreckon::SendReason;
using std::chrono::nanoseconds;

// Where newcomers are to be told, every entity is asked about within so many passes.
constexpr std::size_t kIntroductionPasses = 8;
constexpr std::size_t kLeastAsked = 1024;  // in one pass
// Hands may be as far off as their threshold of position, at most this [m], and touch already.
constexpr double kNearlyTouching = 0.002;

}  // namespace

// The entities of this peer
// ------------------------------------------------------------------------

EntityNumber ModelLoop::add_hand(std::string_view marking,
                                 haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots,
                                 haptics::TripleBuffer<haptics::ContactSet>& contacts,
                                 const DeviceStiffness& stiffness) {
  if (hands_.size() == kMaxDevices)
    throw std::invalid_argument("a peer has at most " + std::to_string(kMaxDevices) + " devices");
  EntityDescription hand;
  hand.marking = marking;
  hand.type = hand_type();
  hand.force_id = pdu::ForceId::friendly;
  hand.dead_reckoning = scene_.dead_reckoning;
  hand.model = to_force_model(scene_.hand);
  // Both sides of a contact show the softer of two hands, else one would feel what the other
  // cannot.
  hand.model->k1 = std::min(hand.model->k1, stiffness.hands);
  tell_softened(hand.marking, stiffness);
  const auto number = static_cast<EntityNumber>(hands_.size() + 1);
  owned_.add(number, hand);
  aoim_.introductions().set_owned(owned_.size());
  hands_.emplace_back(snapshots, contacts, number);
  touches_.emplace_back();
  stiffness_.push_back(stiffness);
  return number;
}

void ModelLoop::tell_softened(std::string_view marking, const DeviceStiffness& device) noexcept {
  const auto tell = [&](std::string_view format, double shown, double asked) {
    static_cast<void>(notices_.push(make_notice(format, marking, shown, asked)));
  };
  if (device.hand_asked > device.hands)
    tell("hand '{}' is {:.6g} N/m to others, of {:.6g} asked: its device holds no more",
         device.hands, device.hand_asked);
  if (device.softens_hand() && device.hand_limit() < device.hands)
    tell("hand '{}' feels hands of {:.6g} N/m, of {:.6g} asked: its device holds no more",
         device.hand_shown(), device.hand_asked);
  if (!device.softens_hand() && std::isfinite(device.straight_from()))
    tell("hand '{}' feels hands harden up to {:.6g} N/m, {:.3g} mm deep: its device holds no more",
         device.hand_limit(), 1e3 * device.straight_from());
  if (device.softens_walls())
    tell("hand '{}' feels walls of {:.6g} N/m, of {:.6g} asked: its device holds no more",
         device.walls_shown(), device.walls_asked);
}

bool ModelLoop::add(EntityNumber number, const EntityDescription& description,
                    const EntityTruth& truth) {
  if (!owned_.add(number, description, truth)) return false;
  aoim_.introductions().set_owned(owned_.size());
  moved_ = true;
  if (!description.beacon.empty()) beacon_watch_.add(number, description.beacon);
  if (description.model) {
    bodies_.emplace_back(number, description.power);
    moving_.reserve(bodies_.size());
    remote_.expect_bodies(bodies_.size());
  }
  return true;
}

void ModelLoop::follow(EntityNumber number, const EntityTrack& track) {
  const OwnedEntity* entity = owned_.find(number);
  if (entity != nullptr) tracked_.add(number, track, entity->touch() != nullptr);
}

bool ModelLoop::move(EntityNumber number, const EntityTruth& truth) noexcept {
  OwnedEntity* entity = owned_.find(number);
  if (entity == nullptr || !entity->move(truth)) return false;
  moved_ = true;
  owned_.look_at(number);
  return true;
}

bool ModelLoop::remove(EntityNumber number) noexcept {
  OwnedEntity* entity = owned_.find(number);
  if (entity == nullptr || port_of(number) != nullptr) return false;
  entity->set_deactivated();
  if (entity->last_built() > nanoseconds(0)) {
    sender_.send(*entity, pass_, pass_.now, {});
  }
  beacon_watch_.remove(number);
  std::erase_if(bodies_, [&](const PortlessBody& body) { return body.number() == number; });
  books_.forget(number);
  owned_.remove(number);
  aoim_.introductions().set_owned(owned_.size());
  moved_ = true;
  return true;
}

aoim::AddResult ModelLoop::say(std::span<const std::byte> pdu,
                               const std::optional<aoim::Position>& place) {
  const std::size_t tier = place ? aoim::kCellTier : aoim::kEverybody;
  return aoim_.send(tier, aoim::PduPayload{pdu}, place.value_or(aoim::Position{}), pass_.now);
}

pdu::EntityId ModelLoop::own_id() const noexcept {
  for (EntityNumber number = 1; number <= owned_.last_number(); ++number) {
    if (const OwnedEntity* entity = owned_.find(number)) return entity->id();
  }
  return owned_.simulation();
}

HandPort* ModelLoop::port_of(EntityNumber number) noexcept {
  const auto port = std::find_if(hands_.begin(), hands_.end(),
                                 [&](const HandPort& p) { return p.hand() == number; });
  return port == hands_.end() ? nullptr : &*port;
}

PortlessBody* ModelLoop::body_of(EntityNumber number) noexcept {
  const auto body = std::find_if(bodies_.begin(), bodies_.end(),
                                 [&](const PortlessBody& b) { return b.number() == number; });
  return body == bodies_.end() ? nullptr : &*body;
}

// Out: our entities
// ------------------------------------------------------------------------------------

void ModelLoop::read_hands() noexcept {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    touches_[i].moved = hands_[i].update();
    if (!touches_[i].moved) continue;
    moved_ = true;
    hands_[i].tell(*owned_.find(hands_[i].hand()));
  }
}

void ModelLoop::answer_bodies() noexcept {
  moving_.clear();
  if (bodies_.empty()) return;
  note_own_needs(hands_, owned_, books_, pass_.now);
  double given = 0.0;
  for (PortlessBody& body : bodies_) {
    OwnedEntity& entity = *owned_.find(body.number());
    given += body.answer(entity, books_, pass_.now);
    if (entity.consider_accounts(pass_.now, body.accounts())) owned_.look_at(body.number());
    if (!body.moves()) continue;
    const EntityTruth truth = entity.truth_at(pass_.now);
    moving_.push_back(
        {&entity.touch()->model(),
         {truth.position, truth.orientation, truth.velocity, truth.angular_velocity}});
  }
  power_given_j_ += given;
  counted_.power_given.set(static_cast<std::uint64_t>(1e6 * power_given_j_));
}

void ModelLoop::find_near() noexcept {
  std::array<deadreckon::ProbeState, kMaxDevices> probes;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const haptics::ServoSnapshot& servo = hands_[i].servo();
    probes[i] = {servo.device, servo.device_velocity, scene_.hand.radius};
  }
  remote_.find_near(std::span(probes.data(), hands_.size()), pass_.now,
                    std::span(near_.data(), hands_.size()), moving_, hands_near_);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    near_[i].add_own(owned_, hands_[i].hand(), probes[i], pass_.now);
    if (const RemoteEntity* row = near_[i].crowding()) crowder_ = remote_.owner(*row);
  }
}

void ModelLoop::consider_hands() noexcept {
  const double nearly = std::min(scene_.dead_reckoning.thresholds.position, kNearlyTouching);
  // So little apart, one may be felt where the other is not: at rest copies are off by the
  // threshold of force.
  const double maybe = std::min(nearly, scene_.dead_reckoning.thresholds.force / scene_.hand.k1);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    if (!touches_[i].moved) continue;
    const HandPort& port = hands_[i];
    std::array<deadreckon::ProbeState, haptics::kMaxRemoteHands> probes;
    const std::size_t count = to_probes(near_[i].bodies(), nearly, probes);
    OwnedEntity& hand = *owned_.find(port.hand());
    if (near_[i].has_hand(maybe)) port.note_near(hand);
    sender_.consider(hand, pass_, port.servo().time, std::span(probes.data(), count),
                     port.accounts());
    tell_impacts(i);
  }
}

// What moves by itself is felt like a hand; what stands needs no looking after until its heartbeat.
void ModelLoop::consider_bodies() noexcept {
  std::size_t place = 0;
  for (PortlessBody& body : bodies_) {
    if (!body.moves()) continue;
    std::array<deadreckon::ProbeState, haptics::kMaxRemoteHands> probes;
    const std::size_t count = hands_near_.of(place++, probes);
    if (sender_.consider(*owned_.find(body.number()), pass_, pass_.now,
                         std::span(probes.data(), count), body.accounts())) {
      owned_.note_sent(body.number());
    }
  }
}

void ModelLoop::consider_others() noexcept {
  if (aoim_.introductions().is_pending()) {
    const std::size_t asked = std::max(owned_.last_number() / kIntroductionPasses, kLeastAsked);
    owned_.for_each_next(asked, [&](OwnedEntity& entity, EntityNumber number) {
      if (sender_.asked_tier(entity, pass_)) owned_.look_at(number);
    });
  }
  std::size_t room = outbound_.room();
  owned_.for_each_waiting(pass_.now, [&](OwnedEntity& entity, EntityNumber number) {
    if (room == 0) return false;
    if (consider_other(entity, number)) --room;
    return true;
  });
}

bool ModelLoop::consider_other(OwnedEntity& entity, EntityNumber number) noexcept {
  if (entity.truth().time <= nanoseconds(0) || port_of(number) != nullptr) return false;
  const PortlessBody* body = entity.touch() == nullptr ? nullptr : body_of(number);
  return sender_.consider(entity, pass_, pass_.now, {},
                          body == nullptr ? std::span<const EnergyAccount>() : body->accounts());
}

// A hand that strikes another says so once, for tools that know impacts but no force models.
void ModelLoop::tell_impacts(std::size_t hand) noexcept {
  const haptics::ServoSnapshot& servo = hands_[hand].servo();
  Touch& touch = touches_[hand];
  const auto before = touch.touched;
  const auto end = before.begin() + static_cast<std::ptrdiff_t>(touch.touched_count);
  touch.touched_count = 0;
  for (std::size_t i = 0; i < servo.count; ++i) {
    const haptics::ContactAccount& contact = servo.contacts[i];
    if (contact.ungated_force.isZero()) continue;
    const auto known = std::find_if(
        before.begin(), end, [&](const Touched& touched) { return touched.id == contact.id; });
    touch.touched[touch.touched_count++] = known != end ? *known : Touched{contact.id, pass_.now};
    const RemoteEntity* row = remote_.find(contact.id);
    if (row != nullptr && known == end) {
      send_impact(hands_[hand], *row, contact);
    }
  }
}

void ModelLoop::send_impact(const HandPort& port, const RemoteEntity& row,
                            const haptics::ContactAccount& contact) noexcept {
  const haptics::ServoSnapshot& servo = port.servo();
  auto impact = impact_of(servo, scene_.hand.radius, contact, row, frame_, pass_.now);
  if (!impact) return;
  const pdu::EntityId own = owned_.find(port.hand())->id();
  impact->header.exercise_id = scene_.network.exercise;
  impact->header.timestamp = time_.stamp(pass_.utc);
  impact->issuing_entity_id = own;
  impact->event_id = {own.site, own.application, ++impacts_};
  std::array<std::byte, 128> octets;
  const std::size_t size = pdu::encode(*impact, octets);
  static_cast<void>(say(std::span(octets.data(), size), to_position(servo.scp)));
}

void ModelLoop::publish_all_contacts() noexcept {
  const ContactSources sources{books_, hands_, bodies_, pass_.now, epoch_};
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const OwnedEntity& hand = *owned_.find(hands_[i].hand());
    publish_contacts(hands_[i], hand.id(), near_[i], hand.is_frozen(), sources);
  }
}

}  // namespace reckon::peer
