// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner's side of the predictors: decides when an entity of ours has to be sent, and builds the
// update. The same for a hand, a truck and a post. Part of the model loop.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/deadreckon/force/force_predictor.hpp"
#include "reckon/deadreckon/motion/articulation.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/sending/model_choice.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/energy_account_record.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"
#include "reckon/pdu/reckon/ownership_record.hpp"
#include "reckon/peer/compression/state_compressor.hpp"
#include "reckon/peer/world/audiences.hpp"
#include "reckon/peer/world/entity_description.hpp"

namespace reckon::peer {

/// Our side of the energy account between an entity of ours and one that touches it.
struct EnergyAccount {
  pdu::EntityId counterpart;
  double given = 0.0;        ///< [J], running total that we have given
  double need = 0.0;         ///< [J], our request
  double spring_need = 0.0;  ///< [J], our additional wish, see haptics::EnergyDemand
  bool pressed = false;      ///< sent even if all is 0, so that the owner repeats the body
};

/// Most counterparts of one entity at a time.
inline constexpr std::size_t kMostAccounts = haptics::kMaxRemoteHands;

/// Content of one update of an entity.
struct EntityUpdate {
  pdu::EntityState state;  ///< its variable parameters are a view of `parts`
  bool has_model = false;
  pdu::HapticRecord model;
  std::array<pdu::EnergyAccountRecord, kMostAccounts> accounts{};
  std::size_t account_count = 0;
  std::optional<pdu::OwnershipRecord> ownership = {};  ///< of a body of the scene
  std::array<std::byte, 32 * deadreckon::PartState::kCapacity> parts{};
};

/// Largest size of the records of an update [octets].
inline constexpr std::size_t kMaxEntityRecords = pdu::kHapticRecordLength +
                                                 kMostAccounts * pdu::kEnergyAccountRecordLength +
                                                 pdu::kOwnershipRecordLength;

/// Encodes the force model, the accounts and the ownership of `update` one after the other; returns
/// their octets.
std::size_t store_records(const EntityUpdate& update,
                          std::span<std::byte, kMaxEntityRecords> records) noexcept;

/// The felt side of an entity: made at registration, only for entities with a force model.
class TouchSide {
 public:
  explicit TouchSide(const deadreckon::ForceModel& model)
      : model_(model), k1_(model.k1), k3_(model.k3) {}

  [[nodiscard]] const deadreckon::ForceModel& model() const noexcept { return model_; }
  /// Distance of the model's point as peers predict it from its true place [m]; infinite before the
  /// first update. @param now [s], as of the predictor
  [[nodiscard]] double point_miss(const deadreckon::Pose& truth, double now) const noexcept;
  /// Moves the model's point within the body [m], body axes.
  void move_point(const Eigen::Vector3d& point) noexcept { model_.point = point; }

  /// Sets the surface that it holds; 0: none. @param stiffness of the spring that holds it [N/m]
  /// @return whether the surface is new
  bool hold(std::uint16_t surface, double stiffness) noexcept {
    model_.grip = static_cast<std::uint16_t>(std::clamp(std::round(stiffness), 0.0, 65535.0));
    return std::exchange(model_.surface, surface) != surface;
  }

  /// Softens the model to this share of its original stiffness, (0, 1], so that others feel the
  /// same stiffness that our device can show.
  void soften(double share) noexcept {
    model_.k1 = share * k1_;
    model_.k3 = share * k3_;
  }

  /// The probe at which the peers' force exceeds the tolerance the most.
  struct Miss {
    double error = 0;  ///< [N], of the force that peers compute
    double truth = 0;  ///< [N], of the true one
  };
  [[nodiscard]] Miss worst_miss(const deadreckon::Pose& truth, double now,
                                std::span<const deadreckon::ProbeState> probes,
                                const deadreckon::Thresholds& limits) const noexcept;

  /// Whether the accounts have changed enough for an update.
  [[nodiscard]] bool accounts_changed(std::span<const EnergyAccount> accounts) const noexcept;

 private:
  friend class OwnedEntity;
  deadreckon::ForceModel model_;
  double k1_, k3_;  // original values
  deadreckon::ForcePredictor predictor_;
  std::array<pdu::EnergyAccountRecord, kMostAccounts> sent_{};
  std::size_t sent_count_ = 0;
};

/// One owned entity. Runs the predictors that its peers run and detects threshold crossings. One
/// thread; allocates only at construction. A decision costs some 100 ns.
class OwnedEntity {
 public:
  /// @param frame outlives the entity.
  /// @param teleport_distance [m] > 0: a truth at this distance from both the last truth and its
  /// extrapolation is an event.
  OwnedEntity(const deadreckon::LocalFrame& frame, const EntityDescription& description,
              const pdu::EntityId& id, std::uint8_t exercise, double teleport_distance);

  [[nodiscard]] pdu::EntityId id() const noexcept { return template_.entity_id; }
  [[nodiscard]] const pdu::EntityType& type() const noexcept { return template_.entity_type; }
  /// Changes the number after an identity conflict; the next decide() returns `event`.
  void rename(const pdu::EntityId& id) noexcept;
  /// Makes it a body of the scene, whose ID names no owner: each update carries this record.
  /// @param ownership with owner 0: another peer owns it
  void own_by(const pdu::OwnershipRecord& ownership) noexcept { ownership_ = ownership; }
  /// Whether this peer owns it; else it is not sent.
  [[nodiscard]] bool is_ours() const noexcept { return !ownership_ || ownership_->owner != 0; }
  [[nodiscard]] bool is_body() const noexcept { return ownership_.has_value(); }
  /// Of a body.
  [[nodiscard]] const std::optional<pdu::OwnershipRecord>& ownership() const noexcept {
    return ownership_;
  }

  /// Makes the next decide() return `event`, for a new peer or an abrupt change.
  void event() noexcept { event(kAllAudiences); }
  /// The same for a recipient tier and the inner ones.
  void event(std::size_t audience) noexcept {
    policy_.event();
    if (audiences_) audiences_->event(audience);
  }
  /// The same for only the tier that may touch it.
  void felt_event() noexcept { policy_.event(); }
  /// Sets the appearance as on the wire, except for the bits that the peer sets itself. An event.
  void set_appearance(std::uint32_t appearance) noexcept;
  /// While frozen, updates state that it stays at its place, independent of its truth.
  void set_frozen(bool frozen) noexcept;
  [[nodiscard]] bool is_frozen() const noexcept { return frozen_; }
  void set_deactivated() noexcept;
  /// Sets its articulated parts; an event only if peers predict them wrongly. Allocates the first
  /// time.
  void set_parts(const deadreckon::PartState& parts);

  /// Sets the true state. Returns false and changes nothing if the state is not finite or is older
  /// than the present one.
  bool move(const EntityTruth& truth) noexcept;
  /// The last truth, extrapolated to `now` by its own rates.
  [[nodiscard]] EntityTruth truth_at(std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] const EntityTruth& truth() const noexcept { return truth_; }
  /// Whether its last truth is at rest.
  [[nodiscard]] bool is_resting() const noexcept;

  /// Null for an entity without a force model.
  [[nodiscard]] TouchSide* touch() noexcept { return touch_.get(); }
  [[nodiscard]] const TouchSide* touch() const noexcept { return touch_.get(); }

  /// Makes an event if the accounts have changed by more than the permitted error of peers, at most
  /// one in 20 ms. Returns true if it did.
  bool consider_accounts(std::chrono::nanoseconds now,
                         std::span<const EnergyAccount> accounts) noexcept;

  /// Reason to send the truth at `now`; `none` if peers still predict it well enough.
  /// @param probes at which the force has to be right, at their present positions
  [[nodiscard]] deadreckon::SendReason decide(
      std::chrono::nanoseconds now, std::span<const deadreckon::ProbeState> probes = {}) noexcept;

  /// From now on tiers receive different updates. There are `urgent` tiers for an entity that can
  /// be felt, and one tier for each row of channels if there are two or more. An entity that can be
  /// felt uses rows only if there is an urgent tier too.
  void set_tiers(std::size_t urgent, std::span<const aoim::Channel> rows);
  /// Null if all peers receive the same.
  [[nodiscard]] Audiences* audiences() noexcept { return audiences_.get(); }
  [[nodiscard]] const Audiences* audiences() const noexcept { return audiences_.get(); }
  /// Reason for an update to this tier, 1 or more; `none` if none is due.
  [[nodiscard]] deadreckon::SendReason decide_for(std::size_t audience,
                                                  std::chrono::nanoseconds now) const noexcept;
  /// Whether the receivers of a tier predict any motion, from the last update on.
  [[nodiscard]] bool is_shown_moving(std::size_t audience,
                                     std::chrono::nanoseconds now) const noexcept;
  /// Steady time of the last update to a tier.
  [[nodiscard]] std::chrono::nanoseconds last_sent_at(std::size_t audience) const noexcept;

  /// Fills `update` with the truth at `now` and records it as sent. `utc` is the same instant.
  /// Returns false and records nothing if the state exceeds the range of the wire.
  /// @param body an update without parts or without the felt side counts these as not sent
  /// @param audience recipient tier: parts that do not reach all interested peers count as not
  /// sent, too
  [[nodiscard]] bool build(std::chrono::nanoseconds now, std::chrono::nanoseconds utc,
                           deadreckon::SendReason reason, std::span<const EnergyAccount> accounts,
                           EntityUpdate& update, aoim::Body body = aoim::Body::full,
                           std::size_t audience = kAllAudiences) noexcept;

  /// Whether an update with this body omits something that the entity has: its parts or felt side.
  [[nodiscard]] bool is_thinned(aoim::Body body) const noexcept {
    return (touch_ && body != aoim::Body::full) || (parts_ && body == aoim::Body::rigid);
  }

  /// Whether a heartbeat to an audience is due. decide() may give a reason of higher priority.
  [[nodiscard]] bool is_heartbeat_due(std::size_t audience,
                                      std::chrono::nanoseconds now) const noexcept;
  /// Defers a due update to `time`, unless an update is sent before. True if nothing was deferred
  /// since the last update.
  bool hold_back(std::chrono::nanoseconds time) noexcept;
  /// Has it not checked before `time`, unless it changes.
  void withhold(std::chrono::nanoseconds time) noexcept { withheld_until_ = time; }
  [[nodiscard]] bool is_withheld(std::chrono::nanoseconds now) const noexcept {
    return now < withheld_until_;
  }
  /// Has it checked again at `time`, unless an update is sent before.
  void look_again(std::chrono::nanoseconds time) noexcept {
    held_until_ = std::min(held_until_, time);
  }
  /// Records a check: ends a deferral until `now`, unless the update is deferred again.
  void note_check(std::chrono::nanoseconds now) noexcept {
    if (held_until_ <= now) held_until_ = std::chrono::nanoseconds::max();
    checked_ = now;
  }

  /// The motion that an update at `now` states, S frame.
  [[nodiscard]] deadreckon::KinematicState motion_at(std::chrono::nanoseconds now) const noexcept;
  /// Steady time of the last update; far in the past before the first.
  [[nodiscard]] std::chrono::nanoseconds last_built() const noexcept { return last_built_; }
  /// Steady time at which it has to be checked again, even without a change.
  [[nodiscard]] std::chrono::nanoseconds next_heartbeat() const noexcept;

  /// From now on updates are rounded to quanta, so that a compressed form carries them exactly, and
  /// are sent in it; `none`: neither. Updates stay plain for felt entities and for entities with
  /// thresholds below four quanta. Not for a body of the scene: a compressed form has the address
  /// of its sender. Allocates.
  void compress(pdu::CompressedForm form);
  /// Null if they are sent plain.
  [[nodiscard]] StateCompressor* compressor() noexcept { return compressor_.get(); }

  aoim::GroupIndex last_group;  ///< of the last update for all peers
  /// Steady time of the pass of that update.
  std::chrono::nanoseconds last_sent{std::chrono::nanoseconds::min() / 2};
  /// The same of the last update that is complete for a newcomer: no part omitted for distance, no
  /// dependence on a key state that the newcomer lacks.
  std::chrono::nanoseconds last_whole{std::chrono::nanoseconds::min() / 2};

 private:
  struct Parts {
    deadreckon::PartState truth, sent;
  };
  [[nodiscard]] EntityTruth stated_truth(std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] deadreckon::KinematicState motion_of(const EntityTruth& truth) const noexcept;
  [[nodiscard]] pdu::DeadReckoningAlgorithm algorithm() const noexcept;
  [[nodiscard]] bool parts_are_off(double now) const noexcept;
  void note_touch(const pdu::HapticRecord& sent, const deadreckon::KinematicState& decoded,
                  double now) noexcept;
  void note_accounts(std::span<const EnergyAccount> accounts, EntityUpdate& update) noexcept;

  const deadreckon::LocalFrame* frame_;
  deadreckon::UpdatePolicy policy_;
  EntityTruth truth_;
  bool frozen_ = false;
  std::chrono::nanoseconds held_until_ = std::chrono::nanoseconds::max();
  std::chrono::nanoseconds withheld_until_ = std::chrono::nanoseconds::min();
  std::chrono::nanoseconds checked_ = std::chrono::nanoseconds::min();
  bool has_waited_ = false;  // an update was deferred since the last one
  std::chrono::nanoseconds last_built_{std::chrono::nanoseconds::min() / 2};
  DeadReckoningConfig config_;
  double teleport_distance_;
  std::unique_ptr<deadreckon::ModelChoice> choice_;  // if the configuration names no model
  std::unique_ptr<TouchSide> touch_;
  std::unique_ptr<Audiences> audiences_;  // if tiers receive different updates
  std::unique_ptr<StateCompressor> compressor_;
  std::unique_ptr<Parts> parts_;
  EntityTruth frozen_at_;
  std::optional<pdu::OwnershipRecord> ownership_;
  pdu::EntityState template_;
};

}  // namespace reckon::peer
