// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One remote hand at our device: its predictor, the gate in front of it, and the energy account
// between its owner and us. Frame S, SI units, servo thread.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>

#include "reckon/haptics/contact/surface_tracker.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/passivity/force_gate.hpp"

namespace reckon::haptics {

/// Energy between us and the owner of one remote hand. Outlives the contact, so that a hand which
/// leaves and comes back is not credited twice.
struct PairAccount {
  pdu::EntityId id;
  std::uint32_t epoch = 0;
  bool used = false;
  std::uint64_t last_step = 0;  ///< of the servo, when it was last in a contact set
  double given = 0.0;           ///< [J], running total from us
  double received = 0.0;        ///< [J], credited to us
  double seen = 0.0;            ///< [J], greatest total heard from the owner
};

/// What the servo knows in one step.
struct StepContext {
  std::chrono::nanoseconds now{0};
  double dt = 0.001;      ///< [s], length of the sample that ended
  double period = 0.001;  ///< [s], nominal length of the next one
  Eigen::Vector3d probe = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double probe_radius = 0.0;
  double force_limit = 0.0;  ///< [N], for one contact
  bool transfer = true;
};

/// Steps in order: accept (when a new set came), settle, predict, advance, render, attenuate.
/// All of it noexcept and bounded for any content of the record.
class RemoteContact {
 public:
  /// Seconds for a force to fade in or out.
  static constexpr double kRamp = 0.1;
  /// A prediction that jumps farther than this [m] is a new surface, not motion.
  static constexpr double kTeleport = 0.1;

  /// Starts for this hand with an empty ledger.
  void begin(const RemoteHand& hand, PairAccount& account, const StepContext& step) noexcept;
  /// Takes over a record with a new version: predictor, account.
  void accept(const RemoteHand& hand, const StepContext& step) noexcept;
  /// The hand left the set: fades out with its last record. Free again when faded().
  void leave() noexcept { leaving_ = true; }
  /// The hand is in the set: takes its record where the version is new.
  void come_back(const RemoteHand& hand, const StepContext& step) noexcept {
    leaving_ = false;
    if (hand.version != hand_.version) accept(hand, step);
  }
  /// Marks the account as in use in this servo step.
  void keep_account(std::uint64_t step) noexcept { account_->last_step = step; }

  /// Books the sample that ended; see ForceGate::settle.
  void settle(const StepContext& step) noexcept { gate_.settle(step.probe, share(), step.dt); }
  /// Where the surface is now. @param frozen holds the predictor still.
  void predict(const StepContext& step, bool frozen) noexcept;
  /// Damping [N s/m] that this contact would use; 0 when the hand is far off.
  [[nodiscard]] double wanted_share(double stiffness_per_damping) const noexcept;
  /// @param own [N s/m], reserved for spring and damper  @param income the same plus what lies idle
  void grant(double own, double income, double stiffness_per_damping) noexcept;
  /// Moves the gate and the accounts.
  void advance(const StepContext& step) noexcept;
  [[nodiscard]] const Eigen::Vector3d& render(const StepContext& step) noexcept;
  void attenuate(double factor) noexcept { gate_.attenuate(factor); }
  /// The held force is not what was written: forgets what cannot be proved.
  void forfeit(const Eigen::Vector3d& probe) noexcept;
  /// The device holds no force from here to the next render().
  void let_go() noexcept { gate_.let_go(); }

  [[nodiscard]] const pdu::EntityId& id() const noexcept { return hand_.id; }
  [[nodiscard]] bool occupied() const noexcept { return account_ != nullptr; }
  [[nodiscard]] bool faded() const noexcept { return leaving_ && fade_ <= 0; }
  void clear() noexcept { account_ = nullptr; }
  [[nodiscard]] bool touching() const noexcept { return gate_.stored() > 0; }
  [[nodiscard]] double own_share() const noexcept { return own_share_; }
  [[nodiscard]] double share() const noexcept { return income_; }
  [[nodiscard]] const ForceGate& gate() const noexcept { return gate_; }
  [[nodiscard]] const SurfaceTracker& tracker() const noexcept { return tracker_; }
  [[nodiscard]] const PairAccount& pair() const noexcept { return *account_; }
  [[nodiscard]] ContactAccount account() const noexcept;

 private:
  [[nodiscard]] deadreckon::Pose pose_at(std::chrono::nanoseconds time) const noexcept;
  [[nodiscard]] ContactParameters target_at(const deadreckon::Pose& pose,
                                            const StepContext& step) const noexcept;
  void follow(const StepContext& step) noexcept;
  void fade_out(const StepContext& step) noexcept;
  void credit(const RemoteHand& hand) noexcept;
  void give() noexcept;
  [[nodiscard]] double need(const StepContext& step) const noexcept;

  RemoteHand hand_;
  PairAccount* account_ = nullptr;
  ForceGate gate_;
  SurfaceTracker tracker_;
  deadreckon::Pose pose_;
  ContactParameters full_;    // of the prediction now, gain = fade_
  ContactParameters before_;  // of the same record one step ago
  Eigen::Vector3d ungated_ = Eigen::Vector3d::Zero();
  std::chrono::nanoseconds predicted_at_{0};
  double fade_ = 0.0;     // 1 while valid, to 0 within kRamp after it
  double damping_ = 0.0;  // [N s/m], of the record, as far as granted
  double own_share_ = 0.0;
  double income_ = 0.0;
  double short_ = 0.0;  // [J], missing for the full target
  double need_ = 0.0;   // [J], what is asked for: that, and a reserve
  bool usable_ = false;
  bool leaving_ = false;
  bool answer_ = false;  // an account came and was not answered yet
};

}  // namespace reckon::haptics
