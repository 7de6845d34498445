// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/touch_stage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/peer/loops/contact_publisher.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/loops/send_pdu.hpp"
#include "reckon/peer/world/impact.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

// Largest position error of copies, by their threshold, at which hands may touch [m].
constexpr double kNearlyTouching = 0.002;

}  // namespace

void report_softened(std::string_view marking, const DeviceStiffness& device,
                     haptics::SpscRing<Notice>& notices) noexcept {
  const auto report = [&](std::string_view format, double shown, double asked) {
    static_cast<void>(
        notices.push(make_notice(NoticeKind::softened, format, marking, shown, asked)));
  };
  if (device.hand_asked > device.hands)
    report("hand '{}' shows others {:.6g} N/m instead of {:.6g}: the limit of its device",
           device.hands, device.hand_asked);
  if (device.softens_hand() && device.hand_limit() < device.hands)
    report("hand '{}' feels hands at {:.6g} N/m instead of {:.6g}: the limit of its device",
           device.hand_shown(), device.hand_asked);
  if (!device.softens_hand() && std::isfinite(device.straight_from()))
    report("hand '{}' feels hands harden up to {:.6g} N/m, {:.3g} mm deep: the limit of its device",
           device.hand_limit(), 1e3 * device.straight_from());
  if (device.softens_walls())
    report("hand '{}' feels walls at {:.6g} N/m instead of {:.6g}: the limit of its device",
           device.walls_shown(), device.walls_asked);
  if (device.softens_regions())
    report("hand '{}' feels regions at {:.6g} N/m instead of {:.6g}: the limit of its device",
           device.regions_shown(), device.regions_asked);
}

TouchStage::TouchStage(const ModelWiring& wiring, std::uint32_t epoch, const TouchParts& parts)
    : scene_(wiring.scene),
      frame_(wiring.frame),
      epoch_(epoch),
      owned_(parts.owned),
      remote_(parts.remote),
      aoim_(parts.aoim),
      sender_(parts.sender),
      time_(parts.time),
      counted_(parts.counted),
      felt_sources_(wiring.felt) {}

void TouchStage::add_hand(EntityNumber number,
                          haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots,
                          haptics::TripleBuffer<haptics::ContactSet>& contacts,
                          const DeviceStiffness& stiffness) {
  if (hands_.size() == kMaxDevices)
    throw std::invalid_argument("a peer has at most " + std::to_string(kMaxDevices) + " devices");
  hands_.emplace_back(snapshots, contacts, number);
  touches_.emplace_back();
  stiffness_.push_back(stiffness);
}

void TouchStage::add_body(EntityNumber number, double power) {
  bodies_.emplace_back(number, power);
  moving_.reserve(bodies_.size());
  remote_.expect_bodies(bodies_.size());
}

void TouchStage::remove_body(EntityNumber number) noexcept {
  std::erase_if(bodies_, [&](const PortlessBody& body) { return body.number() == number; });
  books_.forget(number);
}

bool TouchStage::read_hands() noexcept {
  bool moved = false;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    touches_[i].moved = hands_[i].update();
    if (!touches_[i].moved) continue;
    moved = true;
    hands_[i].tell(*owned_.find(hands_[i].hand()));
  }
  return moved;
}

void TouchStage::answer_bodies(const Pass& pass) noexcept {
  moving_.clear();
  if (bodies_.empty()) return;
  note_own_needs(hands_, owned_, books_, pass.now);
  double given = 0.0;
  for (PortlessBody& body : bodies_) {
    OwnedEntity& entity = *owned_.find(body.number());
    given += body.answer(entity, books_, pass.now);
    if (entity.consider_accounts(pass.now, body.accounts())) owned_.look_at(body.number());
    if (body.is_pressed(pass.now) && pass.now - entity.last_built() >= HandPort::kBodyPeriod) {
      entity.felt_event();
      owned_.look_at(body.number());
    }
    if (!body.moves()) continue;
    const EntityTruth truth = entity.truth_at(pass.now);
    moving_.push_back(
        {&entity.touch()->model(),
         {truth.position, truth.orientation, truth.velocity, truth.angular_velocity}});
  }
  power_given_j_ += given;
  counted_.power_given.set(static_cast<std::uint64_t>(1e6 * power_given_j_));
}

void TouchStage::find_near(const Pass& pass) noexcept {
  std::array<deadreckon::ProbeState, kMaxDevices> probes;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const haptics::ServoSnapshot& servo = hands_[i].servo();
    probes[i] = {servo.device, servo.device_velocity, scene_.hand.radius};
  }
  remote_.find_near(std::span(probes.data(), hands_.size()), pass.now,
                    std::span(near_.data(), hands_.size()), moving_, hands_near_);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    near_[i].add_own(owned_, hands_[i].hand(), probes[i], pass.now);
    if (const RemoteEntity* row = near_[i].crowding()) crowder_ = remote_.owner(*row);
  }
}

bool TouchStage::has_near() const noexcept {
  const auto is_remote = [](const NearBody& body) { return body.row != nullptr; };
  const auto has_remote = [&](const NearBodies& bodies) {
    return std::ranges::any_of(bodies.bodies(), is_remote);
  };
  return hands_near_.size() > 0 || std::ranges::any_of(bodies_in_reach(), has_remote);
}

void TouchStage::consider(const Pass& pass) noexcept {
  consider_hands(pass);
  consider_bodies(pass);
}

void TouchStage::consider_hands(const Pass& pass) noexcept {
  const double nearly = std::min(scene_.dead_reckoning.thresholds.position, kNearlyTouching);
  // Within this distance, a hand may be felt on one side only: at rest, copies have an error up to
  // the threshold of force.
  const double maybe = std::min(nearly, scene_.dead_reckoning.thresholds.force / scene_.hand.k1);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    if (!touches_[i].moved) continue;
    const HandPort& port = hands_[i];
    std::array<deadreckon::ProbeState, haptics::kMaxRemoteHands> probes;
    const std::size_t count = to_probes(near_[i].bodies(), nearly, probes);
    OwnedEntity& hand = *owned_.find(port.hand());
    if (near_[i].has_hand(maybe)) port.note_near(hand);
    sender_.consider(hand, pass, port.servo().time, std::span(probes.data(), count),
                     port.accounts());
    send_impacts(i, pass);
  }
}

// A moving body is felt like a hand; one at rest needs no checks until its heartbeat.
void TouchStage::consider_bodies(const Pass& pass) noexcept {
  std::size_t place = 0;
  for (PortlessBody& body : bodies_) {
    if (!body.moves()) continue;
    std::array<deadreckon::ProbeState, haptics::kMaxRemoteHands> probes;
    const std::size_t count = hands_near_.of(place++, probes);
    if (sender_.consider(*owned_.find(body.number()), pass, pass.now,
                         std::span(probes.data(), count), body.accounts())) {
      owned_.note_sent(body.number());
    }
  }
}

// The impact of a hand on another is sent once, for tools that use impacts but no force models.
void TouchStage::send_impacts(std::size_t hand, const Pass& pass) noexcept {
  const haptics::ServoSnapshot& servo = hands_[hand].servo();
  Touch& touch = touches_[hand];
  const auto before = touch.touched;
  const auto end = before.begin() + static_cast<std::ptrdiff_t>(touch.touched_count);
  touch.touched_count = 0;
  for (std::size_t i = 0; i < servo.count; ++i) {
    const haptics::ContactAccount& contact = servo.contacts[i];
    if (contact.ungated_force.isZero() && contact.force.isZero()) continue;
    const auto known = std::find_if(
        before.begin(), end, [&](const Touched& touched) { return touched.id == contact.id; });
    touch.touched[touch.touched_count++] = known != end ? *known : Touched{contact.id, pass.now};
    const RemoteEntity* row = remote_.find(contact.id);
    if (row != nullptr && known == end) {
      send_impact(hands_[hand], *row, contact, pass);
    }
  }
}

void TouchStage::send_impact(const HandPort& port, const RemoteEntity& row,
                             const haptics::ContactAccount& contact, const Pass& pass) noexcept {
  const haptics::ServoSnapshot& servo = port.servo();
  auto impact = impact_of(servo, scene_.hand.radius, contact, row, frame_, pass.now);
  if (!impact) return;
  const pdu::EntityId own = owned_.find(port.hand())->id();
  impact->header.exercise_id = scene_.network.exercise;
  impact->header.timestamp = time_.stamp(pass.utc);
  impact->issuing_entity_id = own;
  impact->event_id = {own.site, own.application, ++impacts_};
  send_pdu(aoim_, *impact, to_position(servo.scp), pass.now);
}

void TouchStage::publish_contacts(const Pass& pass) noexcept {
  const ContactSources sources{books_, hands_, bodies_, pass.now, epoch_, scene_.network.interop};
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const OwnedEntity& hand = *owned_.find(hands_[i].hand());
    peer::publish_contacts(hands_[i], hand.id(), near_[i], hand.is_frozen(), sources);
  }
}

void TouchStage::publish_felt_sources() noexcept {
  felt_sources_.publish(bodies_in_reach(), hands_near_.size() > 0, remote_);
}

void TouchStage::note_accounts(const Inbound& update, const Pass& pass) noexcept {
  if (update.has_model && update.body_energy != 0.0)
    books_.pair(kOfBodies, update.entity, pass.now).given = update.body_energy;
  for (std::size_t i = 0; i < update.account_count; ++i) {
    const pdu::EnergyAccountRecord& account = update.accounts[i];
    const OwnedEntity* own = owned_.find(account.counterpart.entity);
    if (own == nullptr || own->touch() == nullptr) continue;
    ReceivedAccount& pair = books_.pair(account.counterpart.entity, update.entity, pass.now);
    pair.given = account.given;
    pair.need = pdu::from_microjoules(account.need);
    pair.spring_need = pdu::from_microjoules(account.spring_need);
    pair.unanswered = true;
  }
}

const HandPort* TouchStage::port_of(EntityNumber number) const noexcept {
  const auto port = std::find_if(hands_.begin(), hands_.end(),
                                 [&](const HandPort& p) { return p.hand() == number; });
  return port == hands_.end() ? nullptr : &*port;
}

const PortlessBody* TouchStage::body_of(EntityNumber number) const noexcept {
  const auto body = std::find_if(bodies_.begin(), bodies_.end(),
                                 [&](const PortlessBody& b) { return b.number() == number; });
  return body == bodies_.end() ? nullptr : &*body;
}

const haptics::ServoSnapshot& TouchStage::servo() const noexcept {
  static const haptics::ServoSnapshot none;
  return hands_.empty() ? none : hands_.front().servo();
}

std::size_t TouchStage::copy_hands(std::span<ApproachingHand, kMaxDevices> out) const noexcept {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const haptics::ServoSnapshot& servo = hands_[i].servo();
    double radius = 0.0;
    for (const Eigen::Vector3d& probe : std::span(servo.tool.probes).first(servo.tool.count))
      radius = std::max(radius, (probe - servo.device).norm());
    out[i] = {servo.device, servo.device_velocity, scene_.hand.radius + radius};
  }
  return hands_.size();
}

std::size_t TouchStage::copy_touched(
    std::span<Touched, kMaxDevices * haptics::kMaxRemoteHands> out) const noexcept {
  auto end = out.begin();
  for (const Touch& touch : touches_)
    end = std::copy_n(touch.touched.begin(), touch.touched_count, end);
  return static_cast<std::size_t>(end - out.begin());
}

std::size_t TouchStage::show(PeerView& view) const noexcept {
  std::size_t unfelt = 0;
  view.power_given = power_given_j_;
  view.hand_count = hands_.size();
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    view.hands[i] = {owned_.find(hands_[i].hand())->id(), hands_[i].servo(), stiffness_[i]};
    unfelt = std::max(unfelt, hands_[i].servo().left_out);
  }
  return unfelt;
}

}  // namespace reckon::peer
