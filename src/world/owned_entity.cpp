// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/owned_entity.hpp"

#include <algorithm>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/world/shared_bodies.hpp"

namespace reckon::peer {
namespace {

using deadreckon::ConversionError;
using deadreckon::SendReason;
using std::chrono::nanoseconds;

// A change is repeated after this [s] without another one, then after twice as long, and so on,
// which quickly repairs a loss. A felt change cannot wait as long as a visible one.
constexpr double kFirstRepeatFelt = 0.2;
constexpr double kFirstRepeat = 1.0;
constexpr double kFirstRepeatBody = 0.05;  // its motion has steps, and a lost one is seen at once
// Accounts alone cause at most one packet in this time. The next repetition repairs a loss, because
// accounts are totals, not differences.
constexpr std::chrono::milliseconds kAccountPeriod{20};

// An update with an account for every hand that there is room for fits one datagram of the default
// size of a scene file.
constexpr std::size_t kBareEntityState = 144;
constexpr std::size_t kUsualDatagram = 1288;
static_assert(kBareEntityState + pdu::kAttributeFixedSize + pdu::kAttributeSetHeaderSize +
                  kMaxEntityRecords + pdu::kDatagramTrailerSize <=
              kUsualDatagram);

constexpr double kLeastValidity = deadreckon::timeout(deadreckon::kHapticHeartbeat);  // [s]

constexpr std::uint32_t kOwnBits = pdu::kAppearanceFrozen | pdu::kAppearanceDeactivated;

// Shorter heartbeats are sent individually, because waiting for a common time would delay them too
// often.
constexpr double kLeastAligned = 5.0;  // [s]

// As it is sent: an entity without repetitions is believed for at least that time.
deadreckon::ForceModel believed(deadreckon::ForceModel model) {
  model.validity = std::max(model.validity, kLeastValidity);
  return model;
}

double heartbeat_of(const EntityDescription& description) {
  const nanoseconds stated = description.dead_reckoning.heartbeat;
  if (!description.model) {
    return stated > nanoseconds(0) ? pdu::to_seconds(stated)
                                   : deadreckon::nominal_heartbeat(description.type);
  }
  // A force that fades out before its repetition would alternate; one update may be lost.
  const double wanted =
      stated > nanoseconds(0) ? pdu::to_seconds(stated) : deadreckon::kHapticHeartbeat;
  return std::min(wanted, believed(*description.model).validity / deadreckon::kTimeoutMultiplier);
}

deadreckon::UpdatePolicy policy_of(const EntityDescription& description, const pdu::EntityId& id) {
  const double heartbeat = heartbeat_of(description);
  const double visible = body_of(description.type) ? kFirstRepeatBody : kFirstRepeat;
  deadreckon::UpdatePolicy policy(description.dead_reckoning.thresholds,
                                  deadreckon::jittered_heartbeat(heartbeat, id),
                                  description.model ? kFirstRepeatFelt : visible,
                                  *description.dead_reckoning.rule, deadreckon::kEventRepeat);
  if (description.model || heartbeat < kLeastAligned) return policy;
  const deadreckon::HeartbeatGrid grid = deadreckon::heartbeat_grid(heartbeat, id.simulation());
  policy.align_heartbeats(grid.step, grid.phase);
  return policy;
}

bool is_finite(const EntityTruth& truth) {
  return truth.position.allFinite() && truth.orientation.coeffs().allFinite() &&
         truth.velocity.allFinite() && truth.acceleration.allFinite() &&
         truth.angular_velocity.allFinite() &&
         (!truth.lasting_velocity || truth.lasting_velocity->allFinite());
}

deadreckon::Pose pose_of(const EntityTruth& truth) {
  return {truth.position, truth.orientation, truth.velocity, truth.angular_velocity};
}

}  // namespace

std::size_t store_records(const EntityUpdate& update,
                          std::span<std::byte, kMaxEntityRecords> records) noexcept {
  std::size_t size = update.has_model ? pdu::store_record(update.model, records) : 0;
  for (std::size_t i = 0; i < update.account_count; ++i) {
    size += pdu::store_record(update.accounts[i], records.subspan(size));
  }
  if (update.ownership) size += pdu::store_record(*update.ownership, records.subspan(size));
  return size;
}

OwnedEntity::OwnedEntity(const deadreckon::LocalFrame& frame, const EntityDescription& description,
                         const pdu::EntityId& id, std::uint8_t exercise, double teleport_distance)
    : frame_(&frame),
      policy_(policy_of(description, id)),
      config_(description.dead_reckoning),
      teleport_distance_(teleport_distance) {
  if (!config_.algorithm) choice_ = std::make_unique<deadreckon::ModelChoice>();
  if (description.model) touch_ = std::make_unique<TouchSide>(believed(*description.model));
  template_.header.exercise_id = exercise;
  template_.entity_id = id;
  template_.force_id = description.force_id;
  template_.entity_type = template_.alternative_entity_type = description.type;
  template_.marking.set(description.marking);
  template_.appearance = description.appearance & ~kOwnBits;
  template_.capabilities = description.capabilities;
}

void OwnedEntity::compress(pdu::CompressedForm form) {
  compressor_.reset();
  const pdu::StateScale scale;
  const bool is_coarse = config_.thresholds.position >= 4.0 * scale.position &&
                         config_.thresholds.angle >= 4.0 * scale.angle;
  if (form == pdu::CompressedForm::none || touch_ || !is_coarse) return;
  compressor_ = std::make_unique<StateCompressor>(form);
}

void OwnedEntity::set_tiers(std::size_t urgent, std::span<const aoim::Channel> rows) {
  const bool is_felt = touch_ != nullptr;
  if (is_felt ? urgent == 0 : rows.size() < 2) return;
  audiences_ =
      std::make_unique<Audiences>(is_felt ? urgent : 0, rows, policy_, *config_.rule, kFirstRepeat);
}

void OwnedEntity::rename(const pdu::EntityId& id) noexcept {
  template_.entity_id = id;
  event();
}

void OwnedEntity::set_appearance(std::uint32_t appearance) noexcept {
  const std::uint32_t next = (template_.appearance & kOwnBits) | (appearance & ~kOwnBits);
  if (next == template_.appearance) return;
  template_.appearance = next;
  event();
}

void OwnedEntity::set_frozen(bool frozen) noexcept {
  if (frozen && !frozen_) {
    frozen_at_ = truth_;
    frozen_at_.velocity.setZero();
    frozen_at_.acceleration.setZero();
    frozen_at_.angular_velocity.setZero();
    frozen_at_.lasting_velocity.reset();
  }
  frozen_ = frozen;
  template_.appearance = frozen ? template_.appearance | pdu::kAppearanceFrozen
                                : template_.appearance & ~pdu::kAppearanceFrozen;
  event();
}

void OwnedEntity::set_deactivated() noexcept {
  template_.appearance |= pdu::kAppearanceDeactivated;
  event();
}

void OwnedEntity::set_parts(const deadreckon::PartState& parts) {
  if (!parts_) parts_ = std::make_unique<Parts>();
  parts_->truth = parts;
}

bool OwnedEntity::move(const EntityTruth& truth) noexcept {
  if (!is_finite(truth) || truth.time < truth_.time) return false;
  const auto far_from = [&](const Eigen::Vector3d& place) {
    return !((truth.position - place).norm() <= teleport_distance_);
  };
  const bool known = truth_.time > nanoseconds(0);
  if (known && far_from(truth_.position) && far_from(truth_at(truth.time).position)) {
    event();
  }
  truth_ = truth;
  return true;
}

bool OwnedEntity::is_resting() const noexcept {
  return truth_.velocity.isZero(0) && truth_.acceleration.isZero(0) &&
         truth_.angular_velocity.isZero(0);
}

bool OwnedEntity::is_shown_moving(std::size_t audience, nanoseconds now) const noexcept {
  return peer::is_shown_moving(policy_, audiences(), audience, pdu::to_seconds(now));
}

EntityTruth OwnedEntity::truth_at(nanoseconds now) const noexcept {
  if (now <= truth_.time || is_resting()) {
    EntityTruth same = truth_;
    same.time = std::max(now, truth_.time);
    return same;
  }
  deadreckon::KinematicState state;
  state.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  state.position = truth_.position;
  state.orientation = truth_.orientation;
  state.velocity = truth_.velocity;
  state.acceleration = truth_.acceleration;
  state.angular_velocity = truth_.angular_velocity;
  const deadreckon::Pose pose = deadreckon::extrapolate(state, pdu::to_seconds(now - truth_.time));
  EntityTruth later = truth_;
  later.time = now;
  later.position = pose.position;
  later.orientation = pose.orientation;
  later.velocity = pose.velocity;
  return later;
}

// The motion for the peers' prediction: the truth, or the state in which the entity was frozen.
EntityTruth OwnedEntity::stated_truth(nanoseconds now) const noexcept {
  if (!frozen_) return truth_at(now);
  EntityTruth stated = frozen_at_;
  stated.time = now;
  return stated;
}

pdu::DeadReckoningAlgorithm OwnedEntity::algorithm() const noexcept {
  return config_.algorithm ? *config_.algorithm : choice_->chosen();
}

deadreckon::KinematicState OwnedEntity::motion_at(nanoseconds now) const noexcept {
  return motion_of(stated_truth(now));
}

deadreckon::KinematicState OwnedEntity::motion_of(const EntityTruth& truth) const noexcept {
  deadreckon::KinematicState state;
  state.position = truth.position;
  state.orientation = truth.orientation;
  if (truth.lasting_velocity) {
    state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    state.velocity = *truth.lasting_velocity;
    if (truth.acceleration.isZero(0)) return state;
    state.algorithm = pdu::DeadReckoningAlgorithm::fvw;
    state.acceleration = truth.acceleration;
    return state;
  }
  state.algorithm = algorithm();
  state.velocity = truth.velocity;
  state.acceleration = truth.acceleration;
  state.angular_velocity = truth.angular_velocity;
  if (deadreckon::drm_terms(state.algorithm).body_axes) {
    const Eigen::Quaterniond to_body = truth.orientation.conjugate();
    state.velocity = to_body * state.velocity;
    // In body axes: the rate of the body's components.
    state.acceleration =
        to_body * state.acceleration - state.angular_velocity.cross(state.velocity);
  }
  return state;
}

bool OwnedEntity::consider_accounts(nanoseconds now,
                                    std::span<const EnergyAccount> accounts) noexcept {
  if (!touch_ || now - last_built_ < kAccountPeriod) return false;
  if (!touch_->accounts_changed(accounts)) return false;
  felt_event();
  return true;
}

SendReason OwnedEntity::decide(nanoseconds now,
                               std::span<const deadreckon::ProbeState> probes) noexcept {
  const EntityTruth stated = stated_truth(now);
  const double seconds = pdu::to_seconds(stated.time);
  const deadreckon::Pose truth = pose_of(stated);
  if (choice_ && !stated.lasting_velocity) {
    choice_->note({seconds, stated.position, stated.orientation, stated.velocity,
                   stated.acceleration, stated.angular_velocity},
                  config_.thresholds, *config_.rule);
  }
  if (parts_ && parts_are_off(seconds)) event(audiences_ ? audiences_->receive_parts() : 0);
  TouchSide::Miss miss;
  if (touch_ && !probes.empty()) {
    miss = touch_->worst_miss(truth, seconds, probes, config_.thresholds);
  }
  return policy_.decide(truth, seconds, miss.error, miss.truth);
}

SendReason OwnedEntity::decide_for(std::size_t audience, nanoseconds now) const noexcept {
  const EntityTruth stated = stated_truth(now);
  return audiences_->decide(audience, pose_of(stated), pdu::to_seconds(stated.time));
}

nanoseconds OwnedEntity::last_sent_at(std::size_t audience) const noexcept {
  return audience == 0 ? last_built_ : pdu::from_seconds(audiences_->last_sent_at(audience));
}

bool OwnedEntity::parts_are_off(double now) const noexcept {
  const double since = now - pdu::to_seconds(last_built_);
  return deadreckon::should_send(parts_->truth, parts_->sent, since);
}

bool OwnedEntity::build(nanoseconds now, nanoseconds utc, SendReason reason,
                        std::span<const EnergyAccount> accounts, EntityUpdate& update,
                        aoim::Body body, std::size_t audience) noexcept {
  const bool is_felt = touch_ && body == aoim::Body::full;
  const bool has_parts = parts_ && body != aoim::Body::rigid;
  update.state = template_;
  const EntityTruth stated = stated_truth(now);
  if (deadreckon::to_wire(motion_of(stated), *frame_, update.state, config_.acceleration) !=
      ConversionError::none) {
    return false;
  }
  update.has_model = is_felt;
  update.account_count = 0;
  update.ownership = ownership_;
  if (is_felt && deadreckon::to_wire(touch_->model_, update.model) != ConversionError::none)
    return false;
  update.state.header.timestamp = pdu::to_dis_timestamp(utc, true);
  if (has_parts) {
    const std::size_t size = deadreckon::to_wire(parts_->truth, update.parts);
    update.state.variable_parameters = {update.parts.data(), size};
  }

  if (compressor_) static_cast<void>(pdu::quantise(update.state, {}));

  // Predicts from the values that peers will decode, because the wire rounds to float32.
  deadreckon::KinematicState decoded;
  if (deadreckon::from_wire(update.state, *frame_, decoded, config_.acceleration) !=
      ConversionError::none) {
    return false;
  }
  const double seconds = pdu::to_seconds(stated.time);
  policy_.sent(decoded, seconds, reason);
  if (audiences_) audiences_->note_sent(audience, decoded, seconds, reason, !is_thinned(body));
  if (is_felt) {
    note_touch(update.model, decoded, seconds);
    note_accounts(accounts, update);
  } else if (touch_) {
    touch_->predictor_.update_entity(decoded, seconds);
  }
  const bool all_know = !audiences_ || audience >= audiences_->receive_parts();
  if (has_parts && all_know) deadreckon::from_wire(update.state.variable_parameters, parts_->sent);
  last_built_ = stated.time;
  held_until_ = nanoseconds::max();
  has_waited_ = false;
  return true;
}

void OwnedEntity::note_touch(const pdu::HapticRecord& sent,
                             const deadreckon::KinematicState& decoded, double now) noexcept {
  deadreckon::ForceModel model;
  if (deadreckon::from_wire(sent, model) != ConversionError::none)
    return touch_->predictor_.clear();
  touch_->predictor_.update(model, decoded, now);
}

void OwnedEntity::note_accounts(std::span<const EnergyAccount> accounts,
                                EntityUpdate& update) noexcept {
  for (const EnergyAccount& account : accounts) {
    const bool exchanges = account.given > 0.0 || account.need > 0.0 || account.spring_need > 0.0;
    if (!exchanges && !account.pressed) continue;
    if (update.account_count == update.accounts.size()) break;
    pdu::EnergyAccountRecord& record = update.accounts[update.account_count++];
    record = {};
    record.counterpart = account.counterpart;
    record.given = account.given;
    record.need = pdu::to_microjoules(account.need);
    record.spring_need = pdu::to_microjoules(account.spring_need);
  }
  touch_->sent_ = update.accounts;
  touch_->sent_count_ = update.account_count;
}

bool OwnedEntity::is_heartbeat_due(std::size_t audience, nanoseconds now) const noexcept {
  return audience == 0 ? now >= last_built_ + pdu::from_seconds(policy_.silence())
                       : pdu::to_seconds(now) >= audiences_->heartbeat(audience);
}

bool OwnedEntity::hold_back(nanoseconds time) noexcept {
  const bool first = !has_waited_;
  has_waited_ = true;
  look_again(time);
  return first;
}

// Without listeners nothing is due. What was due at the last check was deferred, if anything was.
nanoseconds OwnedEntity::next_heartbeat() const noexcept {
  if (!is_ours()) return nanoseconds::max();
  nanoseconds due = last_built_ + pdu::from_seconds(policy_.silence());
  if (audiences_) {
    const std::size_t served = audiences_->served();
    const nanoseconds others = pdu::from_seconds(audiences_->next(served));
    due = served == 0 ? std::min(due, others) : others;
  }
  const bool is_deferred = due <= checked_ && held_until_ < nanoseconds::max();
  return std::max(withheld_until_, is_deferred ? held_until_ : std::min(held_until_, due));
}

}  // namespace reckon::peer
