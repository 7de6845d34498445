// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time integration of the bodies. An island of touching bodies that hands push is integrated in
// small steps, whose result is predicted for the hands' forces. The other bodies are integrated
// after these forces are written to the devices, so that no force waits for them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/body_push.hpp"
#include "reckon/haptics/bodies/body_solver.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/bodies/carried_objects.hpp"
#include "reckon/haptics/bodies/near_bodies.hpp"
#include "reckon/haptics/bodies/object_mover.hpp"

namespace reckon::haptics {

/// Advances the bodies in time and applies the pushes of hands within a period. BodyWorld publishes
/// the results. Servo thread.
class BodyEngine {
 public:
  BodyEngine(const EffectPlan& plan, const Eigen::Vector3d& gravity,
             std::shared_ptr<ObjectMover> mover, const WorkSpace& work_space);

  std::size_t add_hand() { return near_.add_hand(); }

  /// BodyWorld documents this function and those below that have no comment; it calls them under
  /// the same names. @return whether the time has advanced
  bool advance_to(std::chrono::nanoseconds now, bool frozen) noexcept;

  [[nodiscard]] std::span<const std::uint32_t> near(std::size_t hand, const HandReach& reach,
                                                    double period) noexcept;
  [[nodiscard]] const ObjectMotion& state_before(std::size_t body) const noexcept {
    return next_[body];
  }
  [[nodiscard]] bool has_hands() const noexcept { return near_.hands() > 0; }

  /// @return whether all hands have written
  bool written(std::size_t hand, const HandReach& reach) noexcept;

  /// Moves the bodies that no hand touches to the end of the period.
  void go_ahead() noexcept;

  std::size_t push(std::size_t body, const Eigen::Vector3d& point,
                   const Eigen::Vector3d& force) noexcept;

  std::size_t press(std::size_t hand, const BodySpring& spring) noexcept;

  void foresee(std::size_t hand, double period) noexcept;

  [[nodiscard]] Eigen::Vector3d change(std::size_t push) const noexcept {
    return push < pushes_.size() ? pushes_[push].change() : Eigen::Vector3d::Zero();
  }
  void hold(std::size_t push, double share, const Eigen::Vector3d& rest) noexcept;
  [[nodiscard]] double work(std::size_t push) const noexcept {
    return push < works_.size() ? works_[push] : 0.0;
  }
  double take_back(std::size_t body, double energy) noexcept;
  [[nodiscard]] std::span<const BodyState> states() const noexcept { return states_; }
  [[nodiscard]] std::chrono::nanoseconds time() const noexcept { return time_; }
  [[nodiscard]] const BodySolver& solver() const noexcept { return solver_; }
  [[nodiscard]] std::uint64_t coarse() const noexcept { return coarse_; }
  [[nodiscard]] std::uint64_t crowded() const noexcept { return crowded_; }
  /// Bodies with a slot.
  [[nodiscard]] std::span<const std::uint32_t> with_slot() const noexcept {
    return {in_slot_.data(), solver_.size()};
  }
  /// Number of changes of the states, from 1 on.
  [[nodiscard]] std::uint64_t version() const noexcept { return version_; }
  /// Number of bodies that have lost their slot, and the last of them.
  [[nodiscard]] std::uint64_t left() const noexcept { return left_count_; }
  [[nodiscard]] std::span<const std::uint32_t> last_left() const noexcept { return left_; }

 private:
  [[nodiscard]] bool is_quiet() const noexcept {
    return quiet_ >= 2 && pushes_.empty() && last_.empty() && carried_.empty();
  }
  [[nodiscard]] BodiesAbout about(std::span<const BodyState> states) const noexcept;
  [[nodiscard]] std::size_t slot_for(std::size_t body) noexcept;
  void take_in_met() noexcept;

  void go_back() noexcept;
  void begin_period() noexcept;
  [[nodiscard]] BodySet apart() const noexcept;

  [[nodiscard]] bool is_small(BodySet island, std::size_t steps) const noexcept;
  [[nodiscard]] bool is_due(const BodyPush& push) const noexcept;
  [[nodiscard]] BodySet still_pushed() const noexcept;

  [[nodiscard]] std::size_t steps_for(double period) const noexcept;

  void foresee_step(std::size_t hand, double time, double dt) noexcept;

  void add_force(BodyPush& push, const Eigen::Vector3d& force, double share) noexcept;
  void follow(BodyPush& push, double dt) noexcept;

  double push_for(double whole, double dt) noexcept;
  void go_on(double whole) noexcept;

  void read_states(BodySet some, double step, BodySet fine = BodySolver::all()) noexcept;
  void read_state(std::size_t slot, double step, BodyState& out) const noexcept;

  static constexpr std::uint32_t kNobody = 0xFFFFFFFF;
  static constexpr std::array<std::uint32_t, BodySlots::kMost> all_nobody() noexcept {
    std::array<std::uint32_t, BodySlots::kMost> out{};
    out.fill(kNobody);
    return out;
  }

  BodySolver solver_;
  CarriedObjects carried_;
  std::vector<BodyState> states_;
  // Of a body already integrated to the end of the period: its state there; of another body: its
  // state before the last advance.
  std::vector<BodyState> next_;
  NearBodies near_;
  std::array<std::uint32_t, BodySlots::kMost> in_slot_ = all_nobody();  // bodies, by their slots
  std::vector<std::uint32_t> met_;
  std::vector<std::uint32_t> left_;  // the last bodies that lost their slots
  std::uint64_t left_count_ = 0, crowded_ = 0;
  bool is_crowded_ = false;        // a body found no slot in this period
  std::uint64_t version_ = 1;      // of the states
  std::uint64_t quiet_ = 0;        // updates of the states since a body was awake
  std::vector<BodyPush> pushes_;   // pushes of this period
  std::vector<BodyPush> last_;     // pushes of the last period
  std::vector<BodyForce> forces_;  // forces of a step
  std::vector<double> works_;
  std::uint64_t stepped_ = 0, written_ = 0;  // hands with a step, and with a write, in this period
  BodySet rest_ = 0;                         // bodies moved to the end of the period
  double ahead_ = 0.0;                       // [s], from now to the states of these bodies
  double lead_ = 0.0;     // [s], the same for pushed bodies, if a servo step came early
  double period_ = 1e-3;  // [s]
  bool started_ = false;
  bool frozen_ = false;
  std::chrono::nanoseconds time_{0};
  std::uint64_t coarse_ = 0;
};

}  // namespace reckon::haptics
