// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Simulates the objects of a scene that have a mass: hands, weight and collisions move them among
// the static objects.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/body_exchange.hpp"
#include "reckon/haptics/bodies/body_guest.hpp"
#include "reckon/haptics/bodies/near_bodies.hpp"
#include "reckon/haptics/bodies/object_mover.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Pose and motion of a body; its origin is its center of mass.
struct BodyState : ObjectMotion {
  std::uint32_t object = 0;  ///< index in the plan
  bool awake = true;
  bool carried = false;  ///< not owned by this peer: its mover moves it, and no push does
  bool copied = false;   ///< not owned by this peer: a copy that pushes move, see CopiedBodies
  bool touched = false;  ///< by a hand of this peer, within the last 50 ms
  /// A body of its contact island: the same for all its bodies, and for a carried body that touches
  /// one of them. Itself while it sleeps or touches no body.
  std::uint32_t island = 0;

  [[nodiscard]] bool is_owned() const noexcept { return !carried && !copied; }
};

struct BodySpring;
class BodyEngine;

/// All bodies at one time.
struct BodyStates {
  std::chrono::nanoseconds time{0};
  std::vector<BodyState> bodies;
  std::uint64_t crowded = 0;  ///< see BodyWorld
  std::uint64_t left = 0;     ///< see WokenBodies
  std::uint64_t serial = 0;   ///< of the last transaction that took effect, see BodyExchange
  std::uint64_t ignored = 0;  ///< orders without an effect, since the start

  /// Copies the members of a body's island, ascending, as far as there is room. @return their
  /// number
  std::size_t copy_island(std::size_t body, std::span<std::uint32_t> room) const noexcept;
};

/// One body after a step.
struct BodyStep {
  std::chrono::nanoseconds time{0};
  BodyState state;
};
using BodyRing = SpscRing<BodyStep>;

/// All bodies of one peer. Hands push them within their servo steps, all on one thread and at one
/// rate. The first servo of a period advances the world to it. A hand predicts its period, renders
/// the mean of its force, and pushes the body as predicted, so the body gets the energy that the
/// hand loses (docs/bodies.md).
///
/// Free flight and rebounds from the workspace are in closed form. Contacts are inelastic or bounce
/// by the greater of both restitutions; friction is the geometric mean of both. The solver is ODE's
/// exact step. Energy that it adds is taken out of the bodies' velocities in the same step, so a
/// pile never gains energy. A body at rest for kSleep sleeps until it is pushed or hit.
///
/// Each body is owned, and simulated here, or carried: its mover moves it, as the peer does that
/// owns it. Orders change that at run time. An owned body begins in the given state and no other
/// energy; bodies that it overlaps part at 0.1 m/s at most.
///
/// At most kMostActive bodies are active. A larger world starts asleep: a body that is pushed or
/// near a moving one wakes; the others cost nothing. While kMostActive are awake, the others
/// do not give way (crowded()).
///
/// Allocates at construction, and in the first steps until the number of contacts has reached its
/// maximum; then nothing. 3 us for an awake body, 20 us for ten in a pile; body_bench measures
/// hands.
class BodyWorld {
 public:
  static constexpr std::chrono::milliseconds kSleep{1000};
  static constexpr std::size_t kMostActive = 64;  ///< bodies
  static constexpr double kLeastPace = 0.25, kMostPace = 8.0;
  /// Limits of speed [m/s] and turn rate [rad/s] of a body.
  static constexpr double kFastest = 200.0;
  static constexpr double kFastestTurn = 200.0;
  /// Of a period: 8 hands of 8 probes, each in contact with 3 bodies and gripping one.
  static constexpr std::size_t kMostPushes = 256;

  /// Bodies are the objects of the plan whose Matter has a mass; they are owned first, if they are
  /// not carried in the plan. Carried objects follow their mover and carry what lies on them. All
  /// others are static.
  /// @param plan only read here  @param gravity [m/s^2], S
  /// @param mover of carried objects; null if there are none from the start. Servo thread
  /// @param work_space of bodies, or none
  /// @throws std::invalid_argument for an object that cannot be a body; names it and the remedy
  BodyWorld(const EffectPlan& plan, const Eigen::Vector3d& gravity,
            std::shared_ptr<ObjectMover> mover = nullptr, const WorkSpace& work_space = {});
  ~BodyWorld();
  BodyWorld(const BodyWorld&) = delete;
  BodyWorld& operator=(const BodyWorld&) = delete;

  /// Advances to `now`, if later. The first call only records the time. After more than 0.1 s
  /// without a call, it advances by 0.1 s.
  /// @param frozen the simulation is frozen: the time passes without motion
  void advance_to(std::chrono::nanoseconds now, bool frozen = false) noexcept;

  /// Gives an order that takes effect at the begin of the next advance. @return false: too many
  /// orders wait
  bool order(const BodyOrder& order) noexcept;
  bool own(std::uint32_t body, const ObjectMotion& state) noexcept {
    return this->order({BodyAct::own, body, state});
  }
  bool disown(std::uint32_t body) noexcept { return this->order({BodyAct::disown, body}); }
  /// Orders of another thread; they take effect at the same time.
  [[nodiscard]] BodyExchange& exchange() noexcept { return exchange_; }
  /// Whether orders wait for the next advance.
  [[nodiscard]] bool has_orders() const noexcept { return !orders_.empty() || !exchange_.empty(); }
  /// Whether an owned body is awake, or a carried one moves near an owned one.
  [[nodiscard]] bool is_any_moving() const noexcept;
  /// Whether the guest has something to press with.
  [[nodiscard]] bool has_guest_pending() noexcept {
    return guest_ != nullptr && guest_->is_pending();
  }
  /// Whether there are owned and carried ones.
  [[nodiscard]] bool is_mixed() const noexcept;
  /// This peer never owns that body. Call before the first advance.
  void keep_carried(std::size_t body) noexcept;
  /// Whether this peer can own it. Any thread after the first advance.
  [[nodiscard]] bool can_own(std::size_t body) const noexcept;
  /// Box around a body in its axes [m]. Any thread.
  [[nodiscard]] const Eigen::AlignedBox3d& box(std::size_t body) const noexcept {
    return boxes_[body];
  }
  /// A hand touches a body; for BodyState::touched.
  void touch(std::uint32_t body) noexcept;

  /// Applies `force` [N] at `point` [m] of a body until the next advance.
  /// @return the number of this push, for work(); kNoPush if there is no room for it
  std::size_t push(std::size_t body, const Eigen::Vector3d& point,
                   const Eigen::Vector3d& force) noexcept;
  static constexpr std::size_t kNoPush = static_cast<std::size_t>(-1);

  /// Adds a guest, which steps in each advance, and is a hand for the functions below. @param guest
  /// outlives this @return its number. Once, before the first advance. Allocates.
  [[nodiscard]] std::size_t add_guest(BodyGuest& guest);
  /// Takes energy from the guest, see BodyGuest. @return the energy taken [J]
  double take_from_guest(double energy) noexcept {
    return guest_ != nullptr ? guest_->take(energy) : 0.0;
  }
  /// Adds a hand. @return its number, for the functions below. Call before the first advance.
  /// Allocates.
  [[nodiscard]] std::size_t add_hand();
  /// Bodies that a hand at `reach` may touch before its next step, ascending, possibly with others.
  /// O(1) if the hand is where it was expected and no step was late.
  /// @param period [s] until its next step
  [[nodiscard]] std::span<const std::uint32_t> near(std::size_t hand, const HandReach& reach,
                                                    double period) noexcept;
  /// State of a body before the last advance. Valid until the last hand's written().
  [[nodiscard]] const ObjectMotion& state_before(std::size_t body) const noexcept;
  /// A hand touches a body until the next advance. The push has no force before hold().
  /// @return as push()
  std::size_t press(std::size_t hand, const BodySpring& spring) noexcept;
  /// Predicts how the springs of this hand relax in the period [s] that begins: in steps, with all
  /// bodies of the island, while the hands keep their velocities. Call each period, after all
  /// press(). An island that would take more than 0.3 ms of a period is stepped once, and the
  /// prediction has only the bodies that hands push: a light body in a large pile gives way too
  /// easily.
  void foresee(std::size_t hand, double period) noexcept;
  /// Mean force of a push over the period minus the force at its start [N].
  [[nodiscard]] Eigen::Vector3d change(std::size_t push) const noexcept;
  /// The body gets this share of a push, [0, 1], plus `rest` [N].
  void hold(std::size_t push, double share, const Eigen::Vector3d& rest) noexcept;
  /// The hand's force is written. After the last hand of a period, the states are published, and
  /// the untouched bodies move to the end of the period, so no force waits for them.
  void written(std::size_t hand, const HandReach& reach) noexcept;
  /// Work of a push of the last period on its body [J].
  [[nodiscard]] double work(std::size_t push) const noexcept;
  /// Slows a body by so much of its kinetic energy [J]. Call before any push of this period.
  /// @return the energy taken [J]
  double take_back(std::size_t body, double energy) noexcept;

  [[nodiscard]] std::span<const BodyState> states() const noexcept;
  /// All states, after each advance with an awake body, once all hands have written or the next
  /// advance begins; one reader thread.
  [[nodiscard]] TripleBuffer<BodyStates>& published() noexcept { return published_; }
  /// The same for the reader that sends them.
  [[nodiscard]] TripleBuffer<BodyStates>& outgoing() noexcept { return outgoing_; }
  /// Records each step of awake bodies, including the last one before sleep; null stops. Call while
  /// no step runs. A full ring drops new records.
  void trace(BodyRing* ring) noexcept { trace_ = ring; }
  /// Kinetic and potential energy, relative to the initial positions [J].
  [[nodiscard]] double energy() const noexcept;
  /// Counted work of all steps so far [s], an upper estimate of their time on the reference host.
  /// The same on each host.
  [[nodiscard]] double work() const noexcept;
  /// Sets the pace: time of this host over that of the reference host for the same work, from
  /// kLeastPace to kMostPace; 1 at construction. A greater one allows less work in a period. Call
  /// before the first step.
  void set_pace(double pace) noexcept;
  [[nodiscard]] double pace() const noexcept;
  /// Energy added by the solver and taken out again [J], since the start.
  [[nodiscard]] double taken_out() const noexcept;
  /// Steps in which the iterative solver replaced the exact one, which failed or would have taken
  /// too long, since the start.
  [[nodiscard]] std::uint64_t approximated() const noexcept;
  /// Periods of a hand with the reduced prediction, because the whole one needs too much work,
  /// since the start.
  [[nodiscard]] std::uint64_t coarse() const noexcept;
  /// Periods in which a body could not wake because all slots were awake.
  [[nodiscard]] std::uint64_t crowded() const noexcept;

 private:
  static constexpr std::size_t kMostOrders = 256;  // between two advances, of this thread

  void obey(std::uint64_t serial, const BodyOrder& order) noexcept;
  void publish() noexcept;
  void bring_up_to_date(BodyStates& out) const noexcept;
  void trace_steps() noexcept;

  std::unique_ptr<BodyEngine> engine_;
  TripleBuffer<BodyStates> published_;
  TripleBuffer<BodyStates> outgoing_;
  BodyExchange exchange_;
  BodyGuest* guest_ = nullptr;
  std::vector<BodyOrder> orders_;
  std::vector<Eigen::AlignedBox3d> boxes_;  // by body
  std::uint64_t serial_ = 0, ignored_ = 0;  // see BodyStates
  BodyRing* trace_ = nullptr;
  std::vector<char> was_awake_;  // by body, in the last step
  bool is_due_ = false;          // states are not published yet
  std::uint64_t published_version_ = 0;
};

/// The world of the moving objects in the plan of a scene; null: none. @throws as the constructor
[[nodiscard]] std::shared_ptr<BodyWorld> make_bodies(const EffectPlan& plan, const Scene& scene,
                                                     std::shared_ptr<ObjectMover> mover = nullptr);

/// Greatest stiffness of each of two hands that squeeze a body of `mass` [kg], for a servo period
/// [s]: dt sqrt(2 K / m) <= 0.15 with the effective mass of a rotating body (0.4 m) and 16 steps a
/// period.
[[nodiscard]] constexpr double stiffest_push(double mass, double period) noexcept {
  const double dt = period / 16.0;
  return 0.0225 * 0.4 * mass / (2.0 * dt * dt);
}

}  // namespace reckon::haptics
