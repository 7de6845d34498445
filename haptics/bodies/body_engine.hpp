// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time integration of the bodies. An island of touching bodies that hands push is integrated in
// small steps; the hands' forces use their predicted result. The other bodies are integrated
// after these forces are written to the devices, so that no force waits for them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "reckon/haptics/bodies/body_book.hpp"
#include "reckon/haptics/bodies/body_exchange.hpp"
#include "reckon/haptics/bodies/body_solver.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/bodies/carried_objects.hpp"
#include "reckon/haptics/bodies/copied_bodies.hpp"
#include "reckon/haptics/bodies/hand_pushes.hpp"
#include "reckon/haptics/bodies/near_bodies.hpp"
#include "reckon/haptics/bodies/object_mover.hpp"
#include "reckon/haptics/bodies/ordered_bodies.hpp"

namespace reckon::haptics {

/// Advances the bodies in time and applies the pushes of hands within a period. BodyWorld publishes
/// the results. Servo thread.
class BodyEngine {
 public:
  BodyEngine(const EffectPlan& plan, const Eigen::Vector3d& gravity,
             std::shared_ptr<ObjectMover> mover, const WorkSpace& work_space);

  std::size_t add_hand() { return near_.add_hand(); }
  std::size_t add_guest() { return guest_ = near_.add_hand(); }

  /// BodyWorld documents this function and those below that have no comment; it calls them under
  /// the same names. @return whether the time has advanced
  bool advance_to(std::chrono::nanoseconds now, bool frozen) noexcept;

  /// Whether the next advance to `now` has an effect.
  [[nodiscard]] bool is_before(std::chrono::nanoseconds now) const noexcept {
    return !started_ || now > time_;
  }
  /// Carries out an order, before an advance. @param was state of the body before
  /// @return whether it had an effect
  bool obey(const BodyOrder& order, ObjectMotion& was) noexcept;
  /// A hand touches a body.
  void touch(std::uint32_t body) noexcept { book_.touch(body, time_); }
  [[nodiscard]] bool is_mixed() const noexcept {
    return !carried_.empty() && carried_.bodies().size() < book_.now().size();
  }
  void keep_carried(std::size_t body) noexcept { solver_.slots().keep_carried(body); }
  [[nodiscard]] bool can_own(std::size_t body) const noexcept {
    return solver_.slots().can_be_owned(body);
  }
  [[nodiscard]] bool is_any_moving() const noexcept { return book_.woken().is_any_moving(kSoon); }

  [[nodiscard]] std::span<const std::uint32_t> near(std::size_t hand, const HandReach& reach,
                                                    double period) noexcept;
  [[nodiscard]] const ObjectMotion& state_before(std::size_t body) const noexcept {
    return book_.next()[body];
  }
  [[nodiscard]] bool has_hands() const noexcept { return near_.hands() > 0; }
  /// Whether forces of hands are waited for; a guest has none.
  [[nodiscard]] bool has_devices() const noexcept {
    return near_.hands() > (guest_ == BodyWorld::kNoPush ? 0u : 1u);
  }

  /// @return whether all hands have written
  bool written(std::size_t hand, const HandReach& reach) noexcept;

  /// Moves the bodies that no hand touches to the end of the period.
  void go_ahead() noexcept;

  std::size_t push(std::size_t body, const Eigen::Vector3d& point,
                   const Eigen::Vector3d& force) noexcept;

  std::size_t press(std::size_t hand, const BodySpring& spring) noexcept;

  void foresee(std::size_t hand, double period) noexcept;

  [[nodiscard]] Eigen::Vector3d change(std::size_t push) const noexcept {
    return pushes_.change(push);
  }
  void hold(std::size_t push, double share, const Eigen::Vector3d& rest) noexcept {
    pushes_.hold(push, share, rest);
  }
  [[nodiscard]] double work(std::size_t push) const noexcept { return pushes_.work(push); }
  double take_back(std::size_t body, double energy) noexcept;
  [[nodiscard]] std::span<const BodyState> states() const noexcept { return book_.now(); }
  [[nodiscard]] std::chrono::nanoseconds time() const noexcept { return time_; }
  [[nodiscard]] const BodySolver& solver() const noexcept { return solver_; }
  [[nodiscard]] std::uint64_t coarse() const noexcept { return coarse_; }
  void set_pace(double pace) noexcept {
    pace_ = pace >= BodyWorld::kLeastPace ? std::min(pace, BodyWorld::kMostPace)
                                          : BodyWorld::kLeastPace;
  }
  [[nodiscard]] double pace() const noexcept { return pace_; }
  /// Bodies with a slot.
  [[nodiscard]] std::span<const std::uint32_t> with_slot() const noexcept {
    return woken().with_slot();
  }
  /// Number of changes of the states, from 1 on.
  [[nodiscard]] std::uint64_t version() const noexcept { return book_.version(); }
  [[nodiscard]] const WokenBodies& woken() const noexcept { return book_.woken(); }

 private:
  [[nodiscard]] bool is_quiet() const noexcept {
    return book_.is_quiet() && pushes_.is_quiet() && carried_.empty() && copied_.empty();
  }
  [[nodiscard]] BodiesAbout about(std::span<const BodyState> states) const noexcept;
  [[nodiscard]] std::size_t slot_for(std::size_t body) noexcept;
  void take_in_met() noexcept;
  void wake_near(std::uint32_t body) noexcept;
  void follow_carried(std::chrono::nanoseconds now, double gap) noexcept;

  void go_back() noexcept;
  void begin_period() noexcept;
  [[nodiscard]] BodySet apart() const noexcept;

  [[nodiscard]] bool is_small(BodySet island, std::size_t steps) const noexcept;
  [[nodiscard]] double time_before() const noexcept;
  void move_rest(BodySet rest, double from, double to) noexcept;
  void read_states(BodySet some, double step, BodySet fine = BodySolver::all()) noexcept;

  static constexpr double kSoon = 0.1;  // [s] in which a carried body may reach an owned one

  BodySolver solver_;
  CarriedObjects carried_;
  CopiedBodies copied_;
  OrderedBodies ordered_;
  BodyBook book_;
  NearBodies near_;
  std::size_t guest_ = BodyWorld::kNoPush;  // hand that counts only while it presses
  HandPushes pushes_;
  std::uint64_t written_ = 0;  // hands with a write in this period
  BodySet rest_ = 0;           // bodies moved to the end of the period
  bool is_coarse_ = false;     // the islands of hands need too much work before their forces
  int coarse_left_ = 0;        // further periods in which they do
  double ahead_ = 0.0;         // [s], from now to the states of these bodies
  double lead_ = 0.0;          // [s], what is left of that after a servo step that came early
  double period_ = 1e-3;       // [s]
  double pace_ = 1.0;          // see BodyWorld
  bool started_ = false;
  std::chrono::nanoseconds time_{0};
  std::uint64_t coarse_ = 0;
};

}  // namespace reckon::haptics
