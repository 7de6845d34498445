// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner's side of the predictors: when has this peer's hand to be sent, and what goes out.
// Between the servo's snapshots and the aggregator; part of the model loop.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/deadreckon/force/force_predictor.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/sending/model_choice.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/energy_account_record.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"
#include "reckon/peer/scene/peer_config.hpp"

namespace reckon::peer {

/// What one update of the hand consists of.
struct HandUpdate {
  pdu::EntityState state;
  pdu::HapticRecord model;
  std::array<pdu::EnergyAccountRecord, haptics::kMaxRemoteHands> accounts{};
  std::size_t account_count = 0;
};

/// Octets that the records of any update fit into.
inline constexpr std::size_t kMaxHandRecords =
    pdu::kHapticRecordLength + haptics::kMaxRemoteHands * pdu::kEnergyAccountRecordLength;

/// Encodes the force model and the accounts of `update` one after the other; returns their octets.
std::size_t store_records(const HandUpdate& update,
                          std::span<std::byte, kMaxHandRecords> records) noexcept;

/// The hand that this peer owns. Runs the predictors that its peers run and tells when they are
/// off. One thread; no allocation.
class OwnHand {
 public:
  /// @param frame outlives the hand. @param model what the hand shows to others, sphere at its
  /// origin. @param teleport_distance [m] > 0: a move so far between two decisions is an event.
  OwnHand(const deadreckon::LocalFrame& frame, const deadreckon::ForceModel& model,
          const DeadReckoningConfig& config, double teleport_distance, pdu::EntityId id,
          std::string_view marking, std::uint8_t exercise);

  /// Another number after an identity conflict; the next decide() says `event`.
  void rename(pdu::EntityId id) noexcept;
  [[nodiscard]] pdu::EntityId id() const noexcept { return template_.entity_id; }

  /// The next decide() says `event`: a newcomer has to hear of us, or an appearance changed.
  void event() noexcept { policy_.event(); }
  /// While frozen, peers are told that the hand stays where it was, whatever the person does.
  void set_frozen(bool frozen) noexcept;
  void set_deactivated() noexcept;

  /// Why to send what `snapshot` shows; `none` where peers still predict it well enough. `probes`:
  /// the remote hands as they lie now, at which the force has to be right.
  [[nodiscard]] deadreckon::SendReason decide(
      const haptics::ServoSnapshot& snapshot,
      std::span<const deadreckon::ProbeState> probes) noexcept;

  /// Fills `update` from the snapshot and notes it as sent. `utc` belongs to snapshot.time. False
  /// where the state cannot be sent (not finite): nothing is noted.
  [[nodiscard]] bool build(const haptics::ServoSnapshot& snapshot, std::chrono::nanoseconds utc,
                           deadreckon::SendReason reason, HandUpdate& update) noexcept;

  /// The hand's force model with its sphere where the device now is: body axes, at the SCP.
  [[nodiscard]] deadreckon::ForceModel model_at(
      const haptics::ServoSnapshot& snapshot) const noexcept;
  /// The true motion at the snapshot's time, S frame.
  [[nodiscard]] deadreckon::KinematicState motion_at(
      const haptics::ServoSnapshot& snapshot) const noexcept;

 private:
  [[nodiscard]] const haptics::ServoSnapshot& as_told(
      const haptics::ServoSnapshot& snapshot) noexcept;
  struct ForceMiss {
    double error = 0;  // [N], of the force that peers compute
    double truth = 0;  // [N], of the true one
  };
  [[nodiscard]] ForceMiss worst_miss(const haptics::ServoSnapshot& snapshot,
                                     const deadreckon::Pose& truth,
                                     std::span<const deadreckon::ProbeState> probes) const noexcept;
  [[nodiscard]] pdu::DeadReckoningAlgorithm algorithm() const noexcept;
  void note_events(const haptics::ServoSnapshot& snapshot) noexcept;
  [[nodiscard]] bool accounts_changed(const haptics::ServoSnapshot& snapshot) const noexcept;
  void smooth_velocity(const haptics::ServoSnapshot& snapshot) noexcept;
  void note_accounts(const haptics::ServoSnapshot& snapshot, HandUpdate& update) noexcept;

  const deadreckon::LocalFrame& frame_;
  deadreckon::ForceModel model_;
  DeadReckoningConfig config_;
  double teleport_distance_;
  deadreckon::UpdatePolicy policy_;
  deadreckon::ModelChoice choice_;  // asked where the configuration names no model
  deadreckon::ForcePredictor force_;
  pdu::EntityState template_;
  std::array<pdu::EnergyAccountRecord, haptics::kMaxRemoteHands> accounts_sent_{};
  std::size_t accounts_sent_count_ = 0;
  std::chrono::nanoseconds last_sent_{std::chrono::nanoseconds::min() / 2};
  std::chrono::nanoseconds last_seen_{0};
  Eigen::Vector3d contact_velocity_ = Eigen::Vector3d::Zero();  // slow part of the SCP's, S [m/s]
  Eigen::Vector3d last_place_ = Eigen::Vector3d::Zero();        // of the SCP at last_seen_, S [m]
  bool frozen_ = false;
  haptics::ServoSnapshot frozen_at_;  // with step > 0 once taken
  bool touching_ = false;
};

}  // namespace reckon::peer
