// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One remote hand at our device: its predictor, the gate in front of it, and the energy account
// between its owner and us. Frame S, SI units, servo thread.
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
#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics {

/// What the servo knows in one step.
struct StepContext {
  std::chrono::nanoseconds now{0};
  double dt = 0.001;      ///< [s], length of the sample that ended
  double period = 0.001;  ///< [s], nominal length of the next one
  Eigen::Vector3d probe = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double probe_radius = 0.0;
  double force_limit = 0.0;           ///< [N], for one contact
  double stiffness_limit = 0.0;       ///< [N/m], for one hand, without a damper
  double body_stiffness_limit = 0.0;  ///< [N/m], for a body that nobody holds
  double softening = 1.0;             ///< share of the stiffness that is shown
  double damping = 0.0;               ///< [N s/m], of the device
  std::size_t engaged = 0;            ///< contacts that were touched or nearly so in the last step
  bool transfer = true;
};

/// Steps in order: settle, accept (when a new set came), predict, advance, then the port's gifts
/// and hold, then shown. All of it noexcept and bounded for any content of the record.
class RemoteContact {
 public:
  /// Seconds for a force to fade in or out.
  static constexpr double kRamp = 0.1;
  /// A prediction that jumps farther than this [m] is a new surface, not motion.
  static constexpr double kTeleport = 0.1;

  /// Starts for this hand.
  void begin(const RemoteHand& hand, PairAccount& account, const StepContext& step) noexcept;
  /// Takes over a record with a new version: predictor, account.
  void accept(const RemoteHand& hand, const StepContext& step) noexcept;
  /// The hand left the set: fades out with its last record. Free again when faded().
  void leave() noexcept { leaving_ = true; }
  /// The hand is in the set: takes its record where the version is new, and how long it holds
  /// always, for its owner may be doubted without a word.
  void come_back(const RemoteHand& hand, const StepContext& step) noexcept {
    leaving_ = false;
    hand_.valid_until = hand.valid_until;
    if (hand.version != hand_.version) accept(hand, step);
  }
  /// Marks the account as in use in this servo step.
  void keep_account(std::uint64_t step) noexcept { account_->last_step = step; }

  /// Takes what waits of the owner's gifts, as far as the port receives it now.
  void claim(EnergyPort& port) noexcept {
    if (!leaving_) account_->claim(port);
  }

  /// The hand is there now.
  void settle(const StepContext& step) noexcept { spring_.settle(step.probe, step.dt); }
  /// Where the surface is now. @param frozen holds the predictor still.
  void predict(const StepContext& step, bool frozen) noexcept;
  /// Moves what is shown towards it.
  void advance(const StepContext& step) noexcept;
  /// Of the record's damper [N]: along the normal, and never a pull.
  [[nodiscard]] Eigen::Vector3d damper(const StepContext& step) const noexcept;
  /// Of the spring where it is going [N], without friction.
  [[nodiscard]] const Eigen::Vector3d& coming_force() const noexcept { return coming_; }
  /// Largest force [N] of the spring: as shown, and where it is going.
  [[nodiscard]] double greatest_force() const noexcept;
  /// Most that the spring stores [J]: as shown, and where it is going.
  [[nodiscard]] double greatest_store() const noexcept;
  /// Answers the account that came, if one did. @param own what we want ourselves; lowered by what
  /// is given. @param spare see first_tier()  @param contested whether others ask us too
  void answer(EnergyPort& port, EnergyDemand& own, double spare, bool contested) noexcept;
  /// Gives, unasked, where our hand strikes its hand. @param dt [s], of this step
  void give_for_a_blow(EnergyPort& port, EnergyDemand& own, double dt) noexcept;
  /// What we ask of the owner [J].
  void ask(double need, double spring_need) noexcept;
  /// Neither asks nor answers.
  void ask_nothing() noexcept {
    ask(0.0, 0.0);
    answer_ = false;
  }
  /// What its owner asked of us last [J].
  [[nodiscard]] double asked() const noexcept { return asked_; }
  /// What the port holds of it. @param share of the spring  @param ledger [J], free in the port
  void shown(double share, double ledger) noexcept;
  /// Whether energy may go to and fro: it is touched, or about to be.
  [[nodiscard]] bool engaged() const noexcept;
  /// Nothing was felt of the surface when the hand came to where it is: it was found inside, or
  /// found again there after its model had expired or the force had been cut to nothing. A surface
  /// that jumps is known all the time.
  [[nodiscard]] bool began_inside() const noexcept { return began_inside_; }
  /// The force was cut to nothing: it grows again from there.
  void drop() noexcept {
    lost_ = lost_ || touching();
    spring_.release();
  }
  /// The held force is not what was written: forgets what cannot be proved.
  void forfeit(const Eigen::Vector3d& probe) noexcept;

  [[nodiscard]] const pdu::EntityId& id() const noexcept { return hand_.id; }
  /// Of a device; else a body that nobody holds.
  [[nodiscard]] bool is_hand() const noexcept { return hand_.has_device; }
  [[nodiscard]] bool occupied() const noexcept { return account_ != nullptr; }
  [[nodiscard]] bool faded() const noexcept { return leaving_ && fade_ <= 0; }
  void clear() noexcept { account_ = nullptr; }
  [[nodiscard]] bool touching() const noexcept { return spring_.stored() > 0; }
  [[nodiscard]] const ContactSpring& spring() const noexcept { return spring_; }
  [[nodiscard]] const SurfaceTracker& tracker() const noexcept { return tracker_; }
  [[nodiscard]] const PairAccount& pair() const noexcept { return *account_; }
  /// The record that came last, or what follows from it by now, is nothing that can be shown.
  [[nodiscard]] bool refused() const noexcept;
  /// @param extra share of its damper that is held
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
  [[nodiscard]] bool let_go(const StepContext& step) noexcept;
  void show(const ContactParameters& target) noexcept;
  [[nodiscard]] Eigen::Vector3d slip(const StepContext& step) const noexcept;  // ours to it [m/s]

  RemoteHand hand_;
  PairAccount* account_ = nullptr;
  ContactSpring spring_;
  SurfaceTracker tracker_;
  Blow blow_;
  deadreckon::Pose pose_;
  ContactParameters full_;                                  // of the prediction now, gain = fade_
  ContactPlace before_;                                     // of the same record one step ago
  ContactGeometry there_;                                   // of full_, at our hand
  Eigen::Vector3d stated_point_ = Eigen::Vector3d::Zero();  // where its owner said it was [m]
  Eigen::Vector3d ungated_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d coming_ = Eigen::Vector3d::Zero();  // [N], see coming_force()
  double coming_store_ = 0.0;                         // [J], with that force
  std::chrono::nanoseconds predicted_at_{0};
  double fade_ = 0.0;       // 1 while valid, to 0 within kRamp after it
  double damping_ = 0.0;    // [N s/m], of the record, at most half of the device's
  double reshaping_ = 0.0;  // [s], for which the record's spring is blended in slowly
  double asked_ = 0.0;      // [J], by the owner
  double need_ = 0.0;       // [J], what we ask of it
  double spring_need_ = 0.0;
  double share_ = 0.0;   // of the spring that the port held
  double ledger_ = 0.0;  // [J], free in the port
  bool began_inside_ = false;
  bool lost_ = true;  // not known, or not known any more
  bool usable_ = false;
  bool showable_ = false;  // full_ is a surface that can be shown
  bool unsound_ = false;   // the last record: the one before it goes on
  bool leaving_ = false;
  bool answer_ = false;  // an account came and was not answered yet
};

}  // namespace reckon::haptics
