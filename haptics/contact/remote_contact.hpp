// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One remote hand at our device: its predictor, its gate, and the energy account between its owner
// and us. Frame S, SI units, servo thread.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>

#include "reckon/haptics/contact/blow.hpp"
#include "reckon/haptics/contact/pair_account.hpp"
#include "reckon/haptics/contact/surface_tracker.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/passivity/contact_spring.hpp"
#include "reckon/haptics/passivity/energy_demand.hpp"
#include "reckon/haptics/passivity/energy_ledger.hpp"

namespace reckon::haptics {

/// State of the servo in one step.
struct StepContext {
  std::chrono::nanoseconds now{0};
  double dt = 0.001;      ///< [s], length of the last sample
  double period = 0.001;  ///< [s], nominal length of the next one
  Eigen::Vector3d probe = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double probe_radius = 0.0;
  double force_limit = 0.0;           ///< [N], for one contact
  double stiffness_limit = 0.0;       ///< [N/m], for one hand, without a damper
  double body_stiffness_limit = 0.0;  ///< [N/m], for a body that no hand holds
  double softening = 1.0;             ///< share of the stiffness that is shown
  double damping = 0.0;               ///< [N s/m], of the device
  std::size_t engaged = 0;            ///< contacts touched or nearly so in the last step
  bool transfer = true;
};

/// A step calls settle, accept (if a new set came), predict, advance, then the port's gifts and
/// hold, then shown. All of them are noexcept and bounded for any content of the record.
class RemoteContact {
 public:
  /// Time [s] in which a force fades in or out.
  static constexpr double kRamp = 0.1;
  /// A prediction that jumps farther than this [m] is a new surface and no motion.
  static constexpr double kTeleport = 0.1;

  /// Starts a contact with this hand.
  void begin(const RemoteHand& hand, PairAccount& account, const StepContext& step) noexcept;
  /// Takes over a record of a new version: predictor and account.
  void accept(const RemoteHand& hand, const StepContext& step) noexcept;
  /// The hand left the set: fades out with its last record. The slot is free after faded().
  void leave() noexcept { leaving_ = true; }
  /// The hand is in the set: takes its record if the version is new. Always takes its validity,
  /// because doubts about an owner change that without a new version.
  void come_back(const RemoteHand& hand, const StepContext& step) noexcept {
    leaving_ = false;
    hand_.valid_until = hand.valid_until;
    if (hand.version != hand_.version) accept(hand, step);
  }
  /// A solid has come between both hands: fades out with its record, and in again when it is gone.
  void set_apart(bool is) noexcept { apart_ = is; }
  [[nodiscard]] bool is_apart() const noexcept { return apart_; }
  /// Predicted position of the other hand [m]: on the surface that holds it, not below.
  [[nodiscard]] const Eigen::Vector3d& predicted_place() const noexcept { return pose_.position; }
  /// Depth of our hand below the predicted surface [m]; negative in front of it.
  [[nodiscard]] double depth() const noexcept { return usable_ ? there_.depth : -kTeleport; }
  /// Marks the account as in use in this servo step.
  void keep_account(std::uint64_t step) noexcept { account_->last_step = step; }

  /// Credits pending gifts of the owner, as far as the ledger accepts them now.
  void claim(EnergyLedger& ledger) noexcept {
    if (!leaving_) account_->claim(ledger);
  }

  /// Settles the spring at the present position of our hand.
  void settle(const StepContext& step) noexcept { spring_.settle(step.probe, step.dt); }
  /// Predicts the surface to the present. @param frozen stops the predictor's time.
  void predict(const StepContext& step, bool frozen) noexcept;
  /// Moves the shown surface towards the prediction.
  void advance(const StepContext& step) noexcept;
  /// Force of the record's damper [N]: along the normal, and never a pull.
  [[nodiscard]] Eigen::Vector3d damper(const StepContext& step) const noexcept;
  /// Force of the spring at the prediction [N], without friction.
  [[nodiscard]] const Eigen::Vector3d& coming_force() const noexcept { return coming_; }
  /// Largest force [N] of the spring: as shown, or at the prediction.
  [[nodiscard]] double greatest_force() const noexcept;
  /// Greatest storage of the spring [J]: as shown, or at the prediction.
  [[nodiscard]] double greatest_store() const noexcept;
  /// Answers a received account, if there is one. @param own our own need; lowered by the energy
  /// given @param spare see first_tier()  @param contested whether others request energy too
  void answer(EnergyLedger& ledger, EnergyDemand& own, double spare, bool contested) noexcept;
  /// Gives energy without a request if our hand strikes the remote one. @param dt [s], of this step
  void give_for_a_blow(EnergyLedger& ledger, EnergyDemand& own, double dt) noexcept;
  /// Requests energy of the owner [J].
  void ask(double need, double spring_need) noexcept;
  /// Neither requests nor answers.
  void ask_nothing() noexcept {
    ask(0.0, 0.0);
    answer_ = false;
  }
  /// Last request of the owner [J].
  [[nodiscard]] double asked() const noexcept { return asked_; }
  /// Takes the shares that the port held. @param share of the spring  @param ledger [J], free in
  /// the port
  void shown(double share, double ledger) noexcept;
  /// Whether energy may be exchanged: the hand is touched, or nearly.
  [[nodiscard]] bool engaged() const noexcept;
  /// The hand came to its place without feeling the surface: it was found inside, or again after
  /// its model had expired or the force had been cut to zero. A surface that jumps is not such a
  /// case.
  [[nodiscard]] bool began_inside() const noexcept { return began_inside_; }
  /// The force was cut to zero: it grows again from there.
  void drop() noexcept {
    lost_ = lost_ || touching();
    spring_.release();
  }
  /// The held force differs from the written one: discards what cannot be proved.
  void forfeit(const Eigen::Vector3d& probe) noexcept;

  [[nodiscard]] const pdu::EntityId& id() const noexcept { return hand_.id; }
  /// A hand with a device; else a body that no hand holds.
  [[nodiscard]] bool is_hand() const noexcept { return hand_.has_device; }
  /// A body of a plain DIS program, which keeps no account and has no energy to give.
  [[nodiscard]] bool is_guest() const noexcept { return !hand_.has_device && hand_.epoch == 0; }
  [[nodiscard]] bool occupied() const noexcept { return account_ != nullptr; }
  [[nodiscard]] bool faded() const noexcept { return leaving_ && fade_ <= 0; }
  void clear() noexcept { account_ = nullptr; }
  [[nodiscard]] bool touching() const noexcept { return spring_.stored() > 0; }
  [[nodiscard]] const ContactSpring& spring() const noexcept { return spring_; }
  [[nodiscard]] const SurfaceTracker& tracker() const noexcept { return tracker_; }
  [[nodiscard]] const PairAccount& pair() const noexcept { return *account_; }
  /// Whether the last record, or the present prediction from it, cannot be rendered.
  [[nodiscard]] bool refused() const noexcept;
  /// @param extra held share of its damper
  [[nodiscard]] ContactAccount account(const StepContext& step, double extra) const noexcept;

 private:
  [[nodiscard]] deadreckon::Pose stated_pose() const noexcept;
  [[nodiscard]] deadreckon::Pose pose_now(double before = 0.0) const noexcept;
  void expect_blow(const StepContext& step) noexcept;
  [[nodiscard]] ContactParameters target_at(const deadreckon::Pose& pose,
                                            const StepContext& step) const noexcept;
  void stop_before_centre(Eigen::Vector3d& centre, const Eigen::Vector3d& probe) const noexcept;
  [[nodiscard]] bool is_elsewhere(const ContactParameters& shown) const noexcept;
  void recede(ContactParameters& target, const StepContext& step) noexcept;
  void follow(const StepContext& step) noexcept;
  [[nodiscard]] double calm_share(const ContactParameters& shown,
                                  const StepContext& step) const noexcept;
  void fade_out(const StepContext& step) noexcept;
  void fade_to(double gain) noexcept;
  [[nodiscard]] bool release(const StepContext& step) noexcept;
  void show(const ContactParameters& target) noexcept;
  [[nodiscard]] Eigen::Vector3d slip(
      const StepContext& step) const noexcept;  // velocity of our hand over its surface [m/s]

  RemoteHand hand_;
  PairAccount* account_ = nullptr;
  ContactSpring spring_;
  SurfaceTracker tracker_;
  Blow blow_;
  deadreckon::Pose pose_;
  ContactParameters full_;                                  // present prediction, gain = fade_
  ContactPlace before_;                                     // from the same record one step ago
  ContactGeometry there_;                                   // geometry of full_ at our hand
  Eigen::Vector3d stated_point_ = Eigen::Vector3d::Zero();  // place stated by the owner [m]
  Eigen::Vector3d ungated_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d coming_ = Eigen::Vector3d::Zero();  // [N], see coming_force()
  double coming_store_ = 0.0;                         // [J], at that force
  std::chrono::nanoseconds predicted_at_{0};
  double fade_ = 0.0;       // 1 while valid, falls to 0 within kRamp after it
  double damping_ = 0.0;    // [N s/m], of the record, at most half of the device's
  double reshaping_ = 0.0;  // [s], remaining time of slow blending to the record's spring
  double asked_ = 0.0;      // [J], by the owner
  double need_ = 0.0;       // [J], our request
  double spring_need_ = 0.0;
  double share_ = 0.0;   // share of the spring that the port holds
  double ledger_ = 0.0;  // [J], free in the port
  bool began_inside_ = false;
  bool lost_ = true;  // the surface is not known, or no longer known
  bool usable_ = false;
  bool showable_ = false;  // full_ can be rendered
  bool unsound_ = false;   // the last record is invalid: the one before it stays
  bool leaving_ = false;
  bool apart_ = false;   // a solid is between both hands
  bool answer_ = false;  // an account was received and is not answered yet
};

}  // namespace reckon::haptics
