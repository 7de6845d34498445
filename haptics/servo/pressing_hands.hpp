// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hands of other peers that press the bodies which this peer simulates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "reckon/haptics/bodies/body_guest.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/contact/grab.hpp"
#include "reckon/haptics/contact/wall_contact.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Energy that a remote hand may put into the bodies here: a loan, plus what its own peer states
/// that it has put into them there, minus what it has put in here.
class PressingLedger final : public EnergyLedger {
 public:
  PressingLedger() = default;
};

/// Each remote hand is dead-reckoned and touches the bodies as our own hands do: by the springs,
/// friction and effects of the scene. Without energy in its ledger its springs become soft. A
/// damper between hand and body calms each contact. A hand that holds a body, as its force model
/// states by the number of the surface, pulls it by the spring of the scene's hands, at the point
/// where its peer shows it.
///
/// A prediction over a long delay makes two hands at one body swing, because each answers the
/// other's predicted answer. So a hand is predicted from the arrival of its state on, and over at
/// most kMostAhead of the delay; no part of it while it holds a body.
///
/// Servo thread; allocates at construction only. A step costs a contact search for each hand near a
/// body, and nothing but a look at the list without one.
class PressingHands final : public BodyGuest {
 public:
  /// Hands that press at the same time; the others are left out.
  static constexpr std::size_t kMost = 8;
  /// Default loan of a hand [J].
  static constexpr double kLoan = 0.02;
  static constexpr double kMostAhead = 0.02;  ///< [s]; less from a delay of 50 ms on, 0 at 100 ms

  /// @param world without a step so far; this outlives its last step @param plan not null
  /// @param config of the servos: period, radii, and the spring that holds a body
  /// @param loan of each hand [J]; a large value disables the ledgers
  PressingHands(BodyWorld& world, std::shared_ptr<const EffectPlan> plan, const ServoConfig& config,
                double loan = kLoan);

  void step(std::chrono::nanoseconds now, bool frozen) noexcept override;
  [[nodiscard]] bool is_pending() noexcept override;
  double take(double energy) noexcept override;

  /// The model loop writes the hands near bodies here, the nearest first. `given_to_us` is the
  /// energy that the hand has put into bodies, as its peer states it.
  [[nodiscard]] TripleBuffer<HandList>& hands() noexcept { return hands_; }

 private:
  struct Hand {
    bool is_used = false;
    bool restarts = true;  // its contact is not known
    RemoteHand record;
    double delay = 0.0;  // [s], of its states on arrival, smoothed
    double given = 0.0;  // [J], stated and booked
    PressingLedger ledger;
    std::optional<WallContact> walls;
    Grab grab;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();     // [m], of the handle
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // [m/s]
  };
  struct Push {
    std::size_t number = 0;  // in the world
    std::size_t hand = 0;
    std::uint32_t object = 0;
    std::size_t body = 0;
    double stiffness = 0.0;  // [N/m], of a wall; 0: it does not touch the body yet
    bool grips = false;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
  };

  void read(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] Hand* slot_of(const RemoteHand& hand) noexcept;
  void accept(Hand& hand, const RemoteHand& record, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] HandReach reach() const noexcept;
  void settle() noexcept;
  [[nodiscard]] deadreckon::Pose predicted(const Hand& hand,
                                           std::chrono::nanoseconds now) const noexcept;
  void move(Hand& hand, std::chrono::nanoseconds now) noexcept;
  void hold_body(Hand& hand, const deadreckon::Pose& pose, double dt) noexcept;
  void press(std::size_t hand) noexcept;
  void press_held(std::size_t hand) noexcept;
  void hold() noexcept;

  BodyWorld& world_;
  std::shared_ptr<const EffectPlan> plan_;
  double radius_, patch_, pad_, period_, loan_;  // [m], [m], [m], [s], [J]
  GrabSpring grab_;
  std::size_t number_;  // of the guest in the world
  TripleBuffer<HandList> hands_;
  bool is_fresh_ = false;  // hands_ has a list that was not read
  bool is_any_ = false;
  std::array<Hand, kMost> slots_{};
  std::vector<std::uint32_t> body_of_;  // by object of the plan; kNoBody: not a body
  std::vector<Push> pushes_;            // of the last period
  HandReach reach_;
  std::chrono::nanoseconds last_{0};
};

}  // namespace reckon::haptics
