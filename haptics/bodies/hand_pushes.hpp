// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The pushes of hands on bodies in this period and the last, and steps of bodies under them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/body_push.hpp"
#include "reckon/haptics/bodies/body_solver.hpp"

namespace reckon::haptics {

/// Bodies to step in the prediction of a period.
struct Prediction {
  BodySet bodies = 0;
  std::size_t steps = 0;
  double most = std::numeric_limits<double>::infinity();  ///< [s], of counted work
  bool has_impacts = true;
};

/// Servo thread. Every pushed body keeps its slot. It allocates at construction only.
class HandPushes {
 public:
  explicit HandPushes(BodySolver& solver);

  [[nodiscard]] std::size_t size() const noexcept { return pushes_.size(); }
  /// Whether no hand pushes in this period or has pushed in the last.
  [[nodiscard]] bool is_quiet() const noexcept { return pushes_.empty() && last_.empty(); }
  [[nodiscard]] bool has_any_of(std::size_t hand) const noexcept;
  /// Slots of the bodies pushed in this period.
  [[nodiscard]] BodySet pushed() const noexcept { return slots_of(pushes_, solver_.slots()); }
  /// In this period or the last.
  [[nodiscard]] BodySet pinned() const noexcept {
    return pushed() | slots_of(last_, solver_.slots());
  }
  /// In this period, or in the last by a hand that has not stepped yet.
  [[nodiscard]] BodySet present() const noexcept;
  /// Substeps of the predictions of this period, at least 1.
  [[nodiscard]] std::size_t steps() const noexcept { return most_steps(pushes_); }
  /// Number of steps that is accurate for the lightest pushed body, at least 2.
  [[nodiscard]] std::size_t steps_for(double period) const noexcept;

  /// Adds a push. @return its number in this period, below BodyWorld::kMostPushes
  std::size_t add(const BodyPush& push) noexcept;
  /// The springs on this body end.
  void end(std::size_t body) noexcept;
  /// A hand steps in this period: its pushes of the last one no longer act.
  void note_step(std::size_t hand) noexcept { stepped_ |= std::uint64_t{1} << hand % 64; }
  /// Predicts the pushes of a hand over the period [s].
  /// @return false, without a result: it needs more work than `of` allows
  bool foresee(std::size_t hand, double period, const Prediction& of) noexcept;
  /// Mean force over the period minus the force at its start [N].
  [[nodiscard]] Eigen::Vector3d change(std::size_t push) const noexcept {
    return push < pushes_.size() ? pushes_[push].change() : Eigen::Vector3d::Zero();
  }
  void hold(std::size_t push, double share, const Eigen::Vector3d& rest) noexcept {
    if (push < pushes_.size()) pushes_[push].hold(share, rest);
  }

  /// Moves some bodies from one time of the period to another [s], by the held pushes on them.
  void move(BodySet some, double from, double to, double steps) noexcept;
  /// Sets the work of all pushes to 0.
  void begin_works() noexcept { works_.assign(pushes_.size(), 0.0); }
  /// Work of a push on its body [J], until the next begin_works().
  [[nodiscard]] double work(std::size_t push) const noexcept {
    return push < works_.size() ? works_[push] : 0.0;
  }
  /// Saves the pushes, and restores them.
  void keep() noexcept { kept_ = pushes_; }
  void restore() noexcept { pushes_ = kept_; }

  /// Begins the next period.
  void end_period() noexcept;
  void begin_period() noexcept { stepped_ = 0; }
  /// Forgets all pushes.
  void clear() noexcept;

 private:
  [[nodiscard]] bool is_due(const BodyPush& push) const noexcept;
  void foresee_step(std::size_t hand, double time, double dt) noexcept;
  void add_force(BodyPush& push, const Eigen::Vector3d& force, double share) noexcept;
  void follow(BodyPush& push, double dt) noexcept;

  BodySolver& solver_;
  std::vector<BodyPush> pushes_;   // of this period
  std::vector<BodyPush> last_;     // of the last period
  std::vector<BodyPush> kept_;     // of keep()
  std::vector<BodyForce> forces_;  // of a step
  std::vector<double> works_;
  std::uint64_t stepped_ = 0;  // hands with a step in this period
};

}  // namespace reckon::haptics
