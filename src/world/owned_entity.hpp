// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner's side of the predictors: when has an entity of ours to be sent, and what goes out. The
// same for a hand, a truck and a post. Part of the model loop.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

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
#include "reckon/peer/compression/state_compressor.hpp"
#include "reckon/peer/world/audiences.hpp"
#include "reckon/peer/world/entity_description.hpp"

namespace reckon::peer {

/// Our side of the energy between an entity of ours and one that touches it.
struct EnergyAccount {
  pdu::EntityId counterpart;
  double given = 0.0;        ///< [J], running total that we have given
  double need = 0.0;         ///< [J], what we ask for
  double spring_need = 0.0;  ///< [J], what we would like beyond, see haptics::EnergyDemand
};

/// Most counterparts of one entity at a time.
inline constexpr std::size_t kMostAccounts = haptics::kMaxRemoteHands;

/// What one update of an entity consists of.
struct EntityUpdate {
  pdu::EntityState state;  ///< its variable parameters are a view of `parts`
  bool has_model = false;
  pdu::HapticRecord model;
  std::array<pdu::EnergyAccountRecord, kMostAccounts> accounts{};
  std::size_t account_count = 0;
  std::array<std::byte, 32 * deadreckon::PartState::kCapacity> parts{};
};

/// Octets that the records of any update fit into.
inline constexpr std::size_t kMaxEntityRecords =
    pdu::kHapticRecordLength + kMostAccounts * pdu::kEnergyAccountRecordLength;

/// Encodes the force model and the accounts of `update` one after the other; returns their octets.
std::size_t store_records(const EntityUpdate& update,
                          std::span<std::byte, kMaxEntityRecords> records) noexcept;

/// What of an entity hands feel: made at registration for entities with a force model alone.
class TouchSide {
 public:
  explicit TouchSide(const deadreckon::ForceModel& model)
      : model_(model), k1_(model.k1), k3_(model.k3) {}

  [[nodiscard]] const deadreckon::ForceModel& model() const noexcept { return model_; }
  /// The model's point moves within the body [m], body axes.
  void move_point(const Eigen::Vector3d& point) noexcept { model_.point = point; }

  /// The model is so much softer than it was made, (0, 1]: what our device shows, others show too.
  void soften(double share) noexcept {
    model_.k1 = share * k1_;
    model_.k3 = share * k3_;
  }

  /// The probe at which the force that peers compute is farthest beyond what is allowed there.
  struct Miss {
    double error = 0;  ///< [N], of the force that peers compute
    double truth = 0;  ///< [N], of the true one
  };
  [[nodiscard]] Miss worst_miss(const deadreckon::Pose& truth, double now,
                                std::span<const deadreckon::ProbeState> probes,
                                const deadreckon::Thresholds& limits) const noexcept;

  /// Whether the accounts are worth an update.
  [[nodiscard]] bool accounts_changed(std::span<const EnergyAccount> accounts) const noexcept;

 private:
  friend class OwnedEntity;
  deadreckon::ForceModel model_;
  double k1_, k3_;  // as made
  deadreckon::ForcePredictor predictor_;
  std::array<pdu::EnergyAccountRecord, kMostAccounts> sent_{};
  std::size_t sent_count_ = 0;
};

/// One owned entity. Runs the predictors that its peers run and tells when they are off. One
/// thread; allocates at construction alone. A decision costs some 100 ns.
class OwnedEntity {
 public:
  /// @param frame outlives the entity. @param teleport_distance [m] > 0: a truth so far from the
  /// one before, and from where that led, is an event.
  OwnedEntity(const deadreckon::LocalFrame& frame, const EntityDescription& description,
              const pdu::EntityId& id, std::uint8_t exercise, double teleport_distance);

  [[nodiscard]] pdu::EntityId id() const noexcept { return template_.entity_id; }
  [[nodiscard]] const pdu::EntityType& type() const noexcept { return template_.entity_type; }
  /// Another number after an identity conflict; the next decide() says `event`.
  void rename(const pdu::EntityId& id) noexcept;

  /// The next decide() says `event`: a newcomer has to hear of it, or something abrupt happened.
  void event() noexcept { event(kAllAudiences); }
  /// The same for an audience and those before it.
  void event(std::size_t audience) noexcept {
    policy_.event();
    if (audiences_) audiences_->event(audience);
  }
  /// The same of what concerns those alone who may touch it.
  void felt_event() noexcept { policy_.event(); }
  /// Appearance as on the wire, but for the bits that the peer sets itself. An event.
  void set_appearance(std::uint32_t appearance) noexcept;
  /// While frozen, updates state that it stays where it was, whatever its truth does.
  void set_frozen(bool frozen) noexcept;
  [[nodiscard]] bool is_frozen() const noexcept { return frozen_; }
  void set_deactivated() noexcept;
  /// Its articulated parts; an event only where peers are wrong about them. Allocates the first
  /// time.
  void set_parts(const deadreckon::PartState& parts);

  /// Where it truly is. False, and nothing changes, where that is not finite or older than what is
  /// known.
  bool move(const EntityTruth& truth) noexcept;
  /// The last truth, carried on to `now` by its own rates.
  [[nodiscard]] EntityTruth truth_at(std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] const EntityTruth& truth() const noexcept { return truth_; }
  /// Whether its last truth stands still.
  [[nodiscard]] bool is_resting() const noexcept;

  /// Null for what nobody feels.
  [[nodiscard]] TouchSide* touch() noexcept { return touch_.get(); }
  [[nodiscard]] const TouchSide* touch() const noexcept { return touch_.get(); }

  /// An event where the accounts have changed by more than peers should be left to guess, at most
  /// one in 20 ms. True where it is.
  bool consider_accounts(std::chrono::nanoseconds now,
                         std::span<const EnergyAccount> accounts) noexcept;

  /// Why to send what is true at `now`; `none` where peers still predict it well enough.
  /// @param probes at which the force has to be right, as they lie now
  [[nodiscard]] deadreckon::SendReason decide(
      std::chrono::nanoseconds now, std::span<const deadreckon::ProbeState> probes = {}) noexcept;

  /// From now on some receive what others do not: with `felt`, what is felt, by contact
  /// groups; with two rows of channels or more, by near groups. What hands feel is sent by near
  /// groups only where that is sent by contact groups.
  void tell_apart(bool felt, std::span<const aoim::Channel> rows);
  /// Null where all receive the same.
  [[nodiscard]] Audiences* audiences() noexcept { return audiences_.get(); }
  [[nodiscard]] const Audiences* audiences() const noexcept { return audiences_.get(); }
  /// Why an update is due to this audience, 1 or more; `none` where it is not.
  [[nodiscard]] deadreckon::SendReason decide_for(std::size_t audience,
                                                  std::chrono::nanoseconds now) const noexcept;
  /// Steady time at which an audience was sent its last update.
  [[nodiscard]] std::chrono::nanoseconds last_sent_at(std::size_t audience) const noexcept;

  /// Fills `update` with what is true at `now` and notes it as sent. `utc` is the same instant.
  /// False where the state cannot be sent (beyond the wire's range): nothing is noted.
  /// @param body what of it: without its parts, or without what is felt, these count as not said
  /// @param audience who hears it: parts that not all hear who want them count as not said, too
  [[nodiscard]] bool build(std::chrono::nanoseconds now, std::chrono::nanoseconds utc,
                           deadreckon::SendReason reason, std::span<const EnergyAccount> accounts,
                           EntityUpdate& update, aoim::Body body = aoim::Body::full,
                           std::size_t audience = kAllAudiences) noexcept;

  /// Whether an update with so much of the body leaves out what it has: its parts, what is felt.
  [[nodiscard]] bool is_thinned(aoim::Body body) const noexcept {
    return (touch_ && body != aoim::Body::full) || (parts_ && body == aoim::Body::rigid);
  }

  /// What would be sent now may wait: it is looked at again at `time`, if nothing goes out before.
  /// True where nothing has waited since the last update.
  bool hold_back(std::chrono::nanoseconds time) noexcept;
  /// It is looked at again at `time`, if nothing goes out before.
  void look_again(std::chrono::nanoseconds time) noexcept {
    held_until_ = std::min(held_until_, time);
  }
  /// It is looked at: what was held back until `now` waits no more, unless it is held back again.
  void let_go(std::chrono::nanoseconds now) noexcept {
    if (held_until_ <= now) held_until_ = std::chrono::nanoseconds::max();
  }

  /// The motion that an update says at `now`, S frame.
  [[nodiscard]] deadreckon::KinematicState motion_at(std::chrono::nanoseconds now) const noexcept;
  /// Steady time of the last update; far in the past before the first.
  [[nodiscard]] std::chrono::nanoseconds last_built() const noexcept { return last_built_; }
  /// Steady time at which it has to be looked at again though nothing changes.
  [[nodiscard]] std::chrono::nanoseconds next_heartbeat() const noexcept;

  /// From now on updates are rounded to quanta, so that a compressed form carries them exactly, and
  /// go out in it; `none`: neither. What hands feel, and what may be off by less than four quanta,
  /// stays plain. Allocates.
  void compress(pdu::CompressedForm form);
  /// Null where they go out plain.
  [[nodiscard]] StateCompressor* compressor() noexcept { return compressor_.get(); }

  aoim::GroupIndex last_group;  ///< where the last update for all went
  /// Steady time of the pass in which that was.
  std::chrono::nanoseconds last_sent{std::chrono::nanoseconds::min() / 2};
  /// The same of the last that tells a newcomer everything: no part left out for the distance, nor
  /// leaning on a key that it has not heard.
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
  bool has_waited_ = false;  // something, since the last update
  std::chrono::nanoseconds last_built_{std::chrono::nanoseconds::min() / 2};
  DeadReckoningConfig config_;
  double teleport_distance_;
  std::unique_ptr<deadreckon::ModelChoice> choice_;  // where the configuration names no model
  std::unique_ptr<TouchSide> touch_;
  std::unique_ptr<Audiences> audiences_;  // where some receive more than others
  std::unique_ptr<StateCompressor> compressor_;
  std::unique_ptr<Parts> parts_;
  EntityTruth frozen_at_;
  pdu::EntityState template_;
};

}  // namespace reckon::peer
