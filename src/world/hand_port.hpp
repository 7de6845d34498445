// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand: an owned entity that a haptic device moves. Connects the servo's snapshots with the
// entity; part of the model loop.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>
#include <span>

#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/world/contact_recorder.hpp"
#include "reckon/peer/world/owned_entity.hpp"
#include "reckon/peer/world/velocity_trend.hpp"

namespace reckon::peer {

/// Most haptic devices of one peer: two hands with three fingers each, and two spare ones.
inline constexpr std::size_t kMaxDevices = 8;

/// Entity type of a hand: life form, land.
[[nodiscard]] pdu::EntityType hand_type() noexcept;

/// One haptic device in the model loop. One thread; no allocation.
class HandPort {
 public:
  /// Longest silence while hands touch. A longer one would make the loss of one update perceptible,
  /// and a peer that is silent for ten times as long is doubted (SilenceWatch).
  static constexpr std::chrono::milliseconds kContactPeriod{60};
  /// Longest silence for kBlow after a blow began. Without the update of our stop, a peer would
  /// show our hand as moving on into its own.
  static constexpr std::chrono::milliseconds kBlowPeriod{10}, kBlow{25};
  /// Longest silence for kAfterTouch, doubled with each update. Without the update of the end of a
  /// touch, a peer would continue to feel us.
  static constexpr std::chrono::milliseconds kAfterTouchPeriod{100}, kAfterTouch{600};
  /// Longest silence of a body without a device that a remote hand presses, and of that hand. The
  /// accounts of the hand name the body, which informs its owner of the contact.
  static constexpr std::chrono::milliseconds kBodyPeriod{100};

  /// Shortest and longest silence of a hand that touches or holds a body.
  static constexpr std::chrono::milliseconds kAtBodyGap{5}, kAtBodyPeriod{60};
  /// Greatest error of the handle of such a hand at its peers [m]: 40 mN at 400 N/m.
  static constexpr double kHandleMiss = 1e-4;

  /// @param snapshots, contacts of the device's servo; outlive the port.
  /// @param hand the entity that the device moves.
  HandPort(haptics::TripleBuffer<haptics::ServoSnapshot>& snapshots,
           haptics::TripleBuffer<haptics::ContactSet>& contacts, EntityNumber hand) noexcept
      : snapshots_(&snapshots), contacts_(&contacts), hand_(hand) {}

  [[nodiscard]] EntityNumber hand() const noexcept { return hand_; }
  /// Takes the newest snapshot; false if there is none since the last call.
  bool update() noexcept { return snapshots_->update(); }
  [[nodiscard]] const haptics::ServoSnapshot& servo() const noexcept { return snapshots_->read(); }
  /// Slot for the next set of hands nearby; publish_contacts() publishes it.
  [[nodiscard]] haptics::ContactSet& contact_slot() noexcept { return contacts_->write_slot(); }
  void publish_contacts(std::chrono::nanoseconds now) noexcept {
    recorder_.note(contacts_->write_slot(), now);
    contacts_->publish();
  }
  /// Records all sets published from now on, see ContactRecorder.
  void trace_contacts(haptics::ContactRing* ring) noexcept { recorder_.record_into(ring); }

  /// Updates the entity from the snapshot: its motion, the position of its sphere, begin and end of
  /// a touch, energy requested or given.
  void tell(OwnedEntity& entity) noexcept;
  /// Limits the silence, because a remote hand is so near that its owner may already feel ours.
  void note_near(OwnedEntity& entity) const noexcept;
  /// The energy accounts of the snapshot.
  [[nodiscard]] std::span<const EnergyAccount> accounts() const noexcept {
    return {accounts_.data(), account_count_};
  }

 private:
  void read_accounts(const pdu::EntityId& own) noexcept;
  void note_touch(OwnedEntity& entity) noexcept;
  void smooth_velocity() noexcept;
  void consider_accounts(OwnedEntity& entity) noexcept;
  void keep_handle(OwnedEntity& entity) const noexcept;
  [[nodiscard]] Eigen::Quaterniond orientation() const noexcept;  // body axes to S
  [[nodiscard]] EntityTruth truth() const noexcept;
  [[nodiscard]] Eigen::Vector3d free_acceleration() const noexcept;
  [[nodiscard]] Eigen::Vector3d lasting_velocity() const noexcept;
  [[nodiscard]] Eigen::Vector3d lasting_acceleration() const noexcept;

  haptics::TripleBuffer<haptics::ServoSnapshot>* snapshots_;
  haptics::TripleBuffer<haptics::ContactSet>* contacts_;
  EntityNumber hand_;
  ContactRecorder recorder_;
  std::array<EnergyAccount, kMostAccounts> accounts_{};
  std::size_t account_count_ = 0;
  std::chrono::nanoseconds last_seen_{0};
  Eigen::Vector3d contact_velocity_ = Eigen::Vector3d::Zero();  // slow part of the SCP's, S [m/s]
  std::chrono::nanoseconds felt_at_{-kAfterTouch};              // last touch
  std::chrono::nanoseconds blow_until_{0};
  VelocityTrend trend_;   // of the SCP, S
  double sliding_ = 0.0;  // over the hands nearby, the fastest [m/s]
  bool touching_ = false;
  bool presses_body_ = false;  // a remote one without a device
  double at_bodies_ = 0.0;     // [s], see ServoTally
  bool at_body_ = false;       // it touches or holds one of the scene, of any owner
};

}  // namespace reckon::peer
