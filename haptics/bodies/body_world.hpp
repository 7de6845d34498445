// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The objects of a scene that have a mass, and how they move: pushed by hands, by their weight and
// by one another, among the objects that stand still.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/near_bodies.hpp"
#include "reckon/haptics/bodies/object_mover.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Where a body is and how it moves: its origin is its middle.
struct BodyState : ObjectMotion {
  std::uint32_t object = 0;  ///< its number in the plan
  bool awake = true;
  bool carried = false;  ///< pushes do not move it
};

struct BodySpring;
class BodyEngine;

/// All bodies at one time.
struct BodyStates {
  std::chrono::nanoseconds time{0};
  std::vector<BodyState> bodies;
  std::uint64_t crowded = 0;  ///< see BodyWorld
  std::uint64_t left = 0;     ///< bodies that had lost their slots when this was written
};

/// One body after a step.
struct BodyStep {
  std::chrono::nanoseconds time{0};
  BodyState state;
};
using BodyRing = SpscRing<BodyStep>;

/// All bodies of one peer. Hands push them from within their servo steps, all on one thread and at
/// one rate; the first servo of a period steps the world to it. A hand foresees the period that
/// begins, shows the mean of its force, and pushes the body as foreseen, so that what a hand gives
/// up and what a body gets are one (docs/bodies.md).
///
/// Free flight and rebounds from the work space are in closed form. Contacts are inelastic or
/// bounce by the greater of both restitutions, and rub by the geometric mean of both frictions. The
/// solver is ODE's exact step; what energy it makes beyond what was put in is taken out of the
/// bodies' speeds in the same step, so that a pile never gains any. A body that has been still for
/// kSleep sleeps until it is pushed or hit.
///
/// 64 take part at one time. A world of more begins asleep, as it stands: what is pushed or comes
/// near one that moves wakes, and the others cost nothing. While 64 are awake the rest does not
/// give way (crowded()).
///
/// Allocates at construction, and within the first steps until as many contacts were met as there
/// will be; then nothing. 3 us for a body that is awake, 20 us for ten in a pile; body_bench has
/// hands.
class BodyWorld {
 public:
  static constexpr std::chrono::milliseconds kSleep{1000};
  /// Greatest speed [m/s] and turn rate [rad/s]; a body that is pushed faster keeps to them.
  static constexpr double kFastest = 200.0;
  static constexpr double kFastestTurn = 200.0;
  /// Of a period: 8 hands of 8 probes, each held by 3 bodies and holding one.
  static constexpr std::size_t kMostPushes = 256;

  /// Bodies are the objects of the plan that have a Matter with a mass; what is carried goes its
  /// way and takes along what lies on it; all others stand still.
  /// @param plan only read here  @param gravity [m/s^2], S
  /// @param mover of carried objects; null if there are none. Servo thread
  /// @param work_space of bodies, or none
  /// @throws std::invalid_argument for a body that cannot be one; names it and the remedy
  BodyWorld(const EffectPlan& plan, const Eigen::Vector3d& gravity,
            std::shared_ptr<ObjectMover> mover = nullptr, const WorkSpace& work_space = {});
  ~BodyWorld();
  BodyWorld(const BodyWorld&) = delete;
  BodyWorld& operator=(const BodyWorld&) = delete;

  /// Steps to `now`; does nothing if it is there already. The first call only notes the time. After
  /// more than 0.1 s without a call the rest of that time is left out.
  /// @param frozen that time is left out: the simulation is frozen
  void advance_to(std::chrono::nanoseconds now, bool frozen = false) noexcept;

  /// Holds `force` [N] at `point` [m] of a body from now until the next advance.
  /// @return the number of this push, for work(); kNoPush if there is no room for it
  std::size_t push(std::size_t body, const Eigen::Vector3d& point,
                   const Eigen::Vector3d& force) noexcept;
  static constexpr std::size_t kNoPush = static_cast<std::size_t>(-1);

  /// A hand's number, for the following. Before the first advance. Allocates.
  [[nodiscard]] std::size_t add_hand();
  /// Bodies that a hand there may meet before its next step, ascending, and perhaps others. Looks
  /// at no body where the hand is as was to be expected and nothing came late.
  /// @param period [s], until then
  [[nodiscard]] std::span<const std::uint32_t> near(std::size_t hand, const HandReach& reach,
                                                    double period) noexcept;
  /// How a body stood before the last advance. Until the last hand's written().
  [[nodiscard]] const ObjectMotion& state_before(std::size_t body) const noexcept;
  /// A hand is at a body from now until the next advance. Nothing is pushed before hold().
  /// @return as push()
  std::size_t press(std::size_t hand, const BodySpring& spring) noexcept;
  /// Foresees how the springs of this hand give way in the period [s] that begins: in steps, with
  /// all that the bodies lie against, while the hands go on at their speeds. To be called each
  /// period, after all press(). An island that would take more than 0.3 ms of a period is stepped
  /// once, and only those of its bodies that hands push are foreseen: a light body in a large pile
  /// gives way too easily.
  void foresee(std::size_t hand, double period) noexcept;
  /// Mean force of a push over the period, less what it was at its begin [N].
  [[nodiscard]] Eigen::Vector3d change(std::size_t push) const noexcept;
  /// The body gets this share of a push, [0, 1], and `rest` [N] besides.
  void hold(std::size_t push, double share, const Eigen::Vector3d& rest) noexcept;
  /// The hand's force is written. After the last hand of a period the states are published, and the
  /// bodies that no hand touches go on to its end, so that no force waits for them.
  void written(std::size_t hand, const HandReach& reach) noexcept;
  /// Work that a push of the period before did on its body [J].
  [[nodiscard]] double work(std::size_t push) const noexcept;
  /// Slows a body by so much of its kinetic energy [J], before anything is pushed in this period.
  /// @return what was there to be taken
  double take_back(std::size_t body, double energy) noexcept;

  [[nodiscard]] std::span<const BodyState> states() const noexcept;
  /// The same after each advance in which one was awake, once all hands have written or the next
  /// one begins; one reader thread.
  [[nodiscard]] TripleBuffer<BodyStates>& published() noexcept { return published_; }
  /// The same for another reader, which sends them.
  [[nodiscard]] TripleBuffer<BodyStates>& outgoing() noexcept { return outgoing_; }
  /// Records each step of those that are awake, and their last one, from now on; null stops. Call
  /// while no step runs. A full ring loses the newest.
  void trace(BodyRing* ring) noexcept { trace_ = ring; }
  /// Kinetic energy and that of the weight, above the places at the start [J].
  [[nodiscard]] double energy() const noexcept;
  /// Energy that was taken out because the solver had made it [J], since the start.
  [[nodiscard]] double taken_out() const noexcept;
  /// Steps in which the exact solver was lost, or would have taken too long, and an iterative one
  /// answered, since the start.
  [[nodiscard]] std::uint64_t approximated() const noexcept;
  /// Periods of a hand whose island was too large to be foreseen as a whole, since the start.
  [[nodiscard]] std::uint64_t coarse() const noexcept;
  /// Periods in which one was to wake and did not, since as many as can be were awake.
  [[nodiscard]] std::uint64_t crowded() const noexcept;

 private:
  void publish() noexcept;
  void bring_up_to_date(BodyStates& out) const noexcept;
  void trace_steps() noexcept;

  std::unique_ptr<BodyEngine> engine_;
  TripleBuffer<BodyStates> published_;
  TripleBuffer<BodyStates> outgoing_;
  BodyRing* trace_ = nullptr;
  std::vector<char> was_awake_;  // in the last step
  bool is_due_ = false;          // to be published
  std::uint64_t published_version_ = 0;
};

/// The world of the objects that move in the plan of a scene; null if there are none. @throws as
/// the constructor
[[nodiscard]] std::shared_ptr<BodyWorld> make_bodies(const EffectPlan& plan, const Scene& scene,
                                                     std::shared_ptr<ObjectMover> mover = nullptr);

/// Stiffest spring of each of two hands that a body of `mass` [kg] can be squeezed with at a rate
/// of `period` [s]: dt sqrt(2 K / m) <= 0.15 for the lighter resistance of a body that turns under
/// it (0.4 m), in 16 steps a period.
[[nodiscard]] constexpr double stiffest_push(double mass, double period) noexcept {
  const double dt = period / 16.0;
  return 0.0225 * 0.4 * mass / (2.0 * dt * dt);
}

}  // namespace reckon::haptics
