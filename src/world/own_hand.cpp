// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/own_hand.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {
namespace {

using deadreckon::SendReason;

// Body axes of a hand in the scene: forward = east, right = south, down = -up.
// Three-degree-of-freedom devices do not turn, so this never changes.
const Eigen::Quaterniond kHandOrientation(0.0, 1.0, 0.0, 0.0);

// Time constant [s] of the velocity that is sent while hands touch. Below it two hands of 0.1 kg
// over 500 N/m ring at 16 Hz, above it they lag behind a common motion; docs/haptic_stability.md
// has the table.
constexpr double kContactSmoothing = 0.05;
// A change is said again after this [s] without another one, then after twice as long, and so on.
constexpr double kFirstHeartbeat = 0.2;
// Energy below this is not worth a packet [J]: 0.045 N of a 500 N/m contact. A full ledger holds
// 0.02.
constexpr double kSmallEnergy = 2e-6;
// While hands touch, no silence is longer: the loss of one update would be felt.
constexpr std::chrono::milliseconds kContactPeriod{60};
// Accounts alone make at most one packet in this time. What is lost on the way goes out again with
// the next repetition: totals are said, not differences.
constexpr std::chrono::milliseconds kAccountPeriod{20};
// A need is told again when it has changed by this share.
constexpr double kNeedChange = 0.25;

pdu::EntityType hand_type() {
  pdu::EntityType type{};
  type.kind = pdu::EntityKind::life_form;
  type.domain = pdu::EntityDomain::land;
  return type;
}

// An update that tells every hand there is room for what it was given travels in one datagram, of
// the size that a scene file has unless it says otherwise.
constexpr std::size_t kBareEntityState = 144;
constexpr std::size_t kUsualDatagram = 1288;
static_assert(kBareEntityState + pdu::kAttributeFixedSize + pdu::kAttributeSetHeaderSize +
                  kMaxHandRecords + pdu::kDatagramTrailerSize <=
              kUsualDatagram);

bool touches(const haptics::ServoSnapshot& snapshot) {
  return std::any_of(snapshot.contacts.begin(), snapshot.contacts.begin() + snapshot.count,
                     [](const auto& contact) { return contact.ungated_force.squaredNorm() > 0.0; });
}

}  // namespace

std::size_t store_records(const HandUpdate& update,
                          std::span<std::byte, kMaxHandRecords> records) noexcept {
  std::size_t size = pdu::store_record(update.model, records);
  for (std::size_t i = 0; i < update.account_count; ++i) {
    size += pdu::store_record(update.accounts[i], records.subspan(size));
  }
  return size;
}

OwnHand::OwnHand(const deadreckon::LocalFrame& frame, const deadreckon::ForceModel& model,
                 const DeadReckoningConfig& config, double teleport_distance, pdu::EntityId id,
                 std::string_view marking, std::uint8_t exercise)
    : frame_(frame),
      model_(model),
      config_(config),
      teleport_distance_(teleport_distance),
      policy_(config.thresholds,
              deadreckon::jittered_heartbeat(pdu::to_seconds(config.heartbeat), id),
              kFirstHeartbeat, *config.rule) {
  template_.header.exercise_id = exercise;
  template_.entity_id = id;
  template_.force_id = pdu::ForceId::friendly;
  template_.entity_type = template_.alternative_entity_type = hand_type();
  template_.marking.set(marking);
}

void OwnHand::rename(pdu::EntityId id) noexcept {
  template_.entity_id = id;
  policy_.event();
}

void OwnHand::set_frozen(bool frozen) noexcept {
  frozen_ = frozen;
  frozen_at_ = {};
  template_.appearance = frozen ? template_.appearance | pdu::kAppearanceFrozen
                                : template_.appearance & ~pdu::kAppearanceFrozen;
  policy_.event();
}

const haptics::ServoSnapshot& OwnHand::as_told(const haptics::ServoSnapshot& snapshot) noexcept {
  if (!frozen_) return snapshot;
  if (frozen_at_.step == 0) {
    frozen_at_ = snapshot;
    frozen_at_.velocity.setZero();
    frozen_at_.acceleration.setZero();
  }
  frozen_at_.time = snapshot.time;
  return frozen_at_;
}

void OwnHand::set_deactivated() noexcept {
  template_.appearance |= pdu::kAppearanceDeactivated;
  policy_.event();
}

deadreckon::ForceModel OwnHand::model_at(const haptics::ServoSnapshot& snapshot) const noexcept {
  deadreckon::ForceModel model = model_;
  model.point = kHandOrientation.conjugate() * (snapshot.device - snapshot.scp);
  return model;
}

deadreckon::KinematicState OwnHand::motion_at(
    const haptics::ServoSnapshot& snapshot) const noexcept {
  deadreckon::KinematicState state;
  state.position = snapshot.scp;
  state.orientation = kHandOrientation;
  if (touching_) {
    state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    state.velocity = contact_velocity_;
    return state;
  }
  state.algorithm = algorithm();
  state.velocity = snapshot.velocity;
  state.acceleration = snapshot.acceleration;
  if (deadreckon::drm_terms(state.algorithm).body_axes) {
    state.velocity = kHandOrientation.conjugate() * state.velocity;
    state.acceleration = kHandOrientation.conjugate() * state.acceleration;
  }
  return state;
}

pdu::DeadReckoningAlgorithm OwnHand::algorithm() const noexcept {
  return config_.algorithm.value_or(choice_.chosen());
}

SendReason OwnHand::decide(const haptics::ServoSnapshot& servo,
                           std::span<const deadreckon::ProbeState> probes) noexcept {
  const haptics::ServoSnapshot& snapshot = as_told(servo);
  const double now = pdu::to_seconds(snapshot.time);
  const deadreckon::KinematicState motion = motion_at(snapshot);
  const deadreckon::Pose truth{motion.position, motion.orientation, snapshot.velocity,
                               Eigen::Vector3d::Zero()};

  note_events(snapshot);
  if (!config_.algorithm && !touching_) {
    choice_.note({now, snapshot.scp, kHandOrientation, snapshot.velocity, snapshot.acceleration,
                  Eigen::Vector3d::Zero()},
                 config_.thresholds, *config_.rule);
  }
  const ForceMiss miss = worst_miss(snapshot, truth, probes);
  return policy_.decide(truth, now, miss.error, miss.truth);
}

// Make and break of a touch are events; so are energy asked for or given, and a hand that is put
// elsewhere.
void OwnHand::note_events(const haptics::ServoSnapshot& snapshot) noexcept {
  const bool touching = touches(snapshot);
  if (touching != touching_) policy_.event();
  touching_ = touching;
  if ((snapshot.scp - last_place_).norm() > teleport_distance_) policy_.event();
  last_place_ = snapshot.scp;
  smooth_velocity(snapshot);
  if (accounts_changed(snapshot)) policy_.event();
  if (touching && snapshot.time - last_sent_ >= kContactPeriod) policy_.event();
}

// The probe at which the force is farthest beyond what is allowed there.
OwnHand::ForceMiss OwnHand::worst_miss(
    const haptics::ServoSnapshot& snapshot, const deadreckon::Pose& truth,
    std::span<const deadreckon::ProbeState> probes) const noexcept {
  const deadreckon::ForceModel model = model_at(snapshot);
  const double now = pdu::to_seconds(snapshot.time);
  const deadreckon::Thresholds& limits = config_.thresholds;
  if (limits.weber <= 0) return {force_.error(model, truth, probes, now), 0};
  const auto share = [&](const ForceMiss& miss) {
    return miss.error / std::max(limits.force, limits.weber * miss.truth);
  };
  ForceMiss worst;
  for (const deadreckon::ProbeState& probe : probes) {
    const ForceMiss miss{force_.error(model, truth, std::span(&probe, 1), now),
                         deadreckon::evaluate(model, truth, probe).norm()};
    if (!(share(miss) <= share(worst))) worst = miss;
  }
  return worst;
}

// While hands touch, the quick part of the motion of each is the other's doing: extrapolated, it
// would come back through the contact too late for a spring's force, and the pair would ring until
// its ledgers are empty. The slow part, which both make together, is what a prediction is for.
void OwnHand::smooth_velocity(const haptics::ServoSnapshot& snapshot) noexcept {
  const double dt = std::clamp(pdu::to_seconds(snapshot.time - last_seen_), 0.0, kContactSmoothing);
  last_seen_ = snapshot.time;
  const double share = touching_ ? dt / (kContactSmoothing + dt) : 1.0;
  contact_velocity_ += share * (snapshot.velocity - contact_velocity_);
}

bool OwnHand::accounts_changed(const haptics::ServoSnapshot& snapshot) const noexcept {
  if (snapshot.time - last_sent_ < kAccountPeriod) return false;
  for (std::size_t i = 0; i < snapshot.count; ++i) {
    const haptics::ContactAccount& now = snapshot.contacts[i];
    const auto end = accounts_sent_.begin() + static_cast<std::ptrdiff_t>(accounts_sent_count_);
    const auto sent = std::find_if(accounts_sent_.begin(), end, [&](const auto& account) {
      return account.counterpart == now.id;
    });
    const double given = sent == end ? 0.0 : sent->given;
    const double need = sent == end ? 0.0 : static_cast<double>(sent->need);
    if (now.given - given > kSmallEnergy) return true;
    const double change = std::abs(now.need - need);
    if (change > kSmallEnergy && change > kNeedChange * std::max(now.need, need)) return true;
  }
  return false;
}

bool OwnHand::build(const haptics::ServoSnapshot& servo, std::chrono::nanoseconds utc,
                    SendReason reason, HandUpdate& update) noexcept {
  const haptics::ServoSnapshot& snapshot = as_told(servo);
  update.state = template_;
  const deadreckon::ForceModel model = model_at(snapshot);
  if (deadreckon::to_wire(motion_at(snapshot), frame_, update.state, config_.acceleration) !=
          deadreckon::ConversionError::none ||
      deadreckon::to_wire(model, update.model) != deadreckon::ConversionError::none) {
    return false;
  }
  update.state.header.timestamp = pdu::to_dis_timestamp(utc, true);
  note_accounts(snapshot, update);

  // Predict from what peers will decode, not from what we had: the wire rounds to float32.
  deadreckon::KinematicState decoded;
  deadreckon::ForceModel decoded_model;
  if (deadreckon::from_wire(update.state, frame_, decoded, config_.acceleration) !=
          deadreckon::ConversionError::none ||
      deadreckon::from_wire(update.model, decoded_model) != deadreckon::ConversionError::none) {
    return false;
  }
  const double now = pdu::to_seconds(snapshot.time);
  policy_.sent(decoded, now, reason);
  force_.update(decoded_model, decoded, now);
  last_sent_ = snapshot.time;
  return true;
}

void OwnHand::note_accounts(const haptics::ServoSnapshot& snapshot, HandUpdate& update) noexcept {
  update.account_count = 0;
  for (std::size_t i = 0; i < snapshot.count; ++i) {
    const haptics::ContactAccount& account = snapshot.contacts[i];
    if (account.given <= 0.0 && account.need <= 0.0) continue;
    pdu::EnergyAccountRecord& record = update.accounts[update.account_count++];
    record = {};
    record.counterpart = account.id;
    record.given = account.given;
    record.need = static_cast<float>(account.need);
  }
  accounts_sent_ = update.accounts;
  accounts_sent_count_ = update.account_count;
}

}  // namespace reckon::peer
