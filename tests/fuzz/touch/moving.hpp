// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Moving objects beside the first hand of a scenario: a body that falls on it, a distant heap, and
// a paddle that pinches a cube; with their energy ledgers.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/scene/scene.hpp"
#include "reckon/tests/fuzz/touch/scenario.hpp"
#include "reckon/tests/fuzz/touch/trial.hpp"

namespace reckon::fuzz {

/// The falling body first, then the pinched cube, then the heap. @param home of the hand [m]
void add_moving(const Scenario& scenario, const Eigen::Vector3d& home, haptics::Scene& scene);
/// The mover of the paddle; null without one.
[[nodiscard]] std::shared_ptr<haptics::ObjectMover> paddle_of(const Scenario& scenario);

/// Motion of the bodies, step by step.
class MovingBooks {
 public:
  /// @param world null: no ledger
  /// @param stiffest [N/m] greatest stiffness of bodies that the hand's device shows
  MovingBooks(const Scenario& scenario, std::shared_ptr<const haptics::BodyWorld> world,
              double stiffest);

  /// @param dt [s], since the last step
  void note(const haptics::ServoSnapshot& hand, double dt);
  /// Energy of the falling body beyond its initial energy [J].
  [[nodiscard]] double gained() const { return has_body() ? energy() - begin_ : 0.0; }
  /// Whether gained() is exact: while the hand pushes the body, its speed is slightly old.
  [[nodiscard]] bool are_exact() const { return !is_pushed_; }
  /// Positions of the falling body and the pinched cube [m], where they exist.
  [[nodiscard]] std::vector<Eigen::Vector3d> places() const;
  /// See haptics::BodyWorld.
  [[nodiscard]] std::uint64_t approximated() const {
    return world_ == nullptr ? 0 : world_->approximated();
  }
  void judge(Outcome& out) const;

 private:
  [[nodiscard]] bool has_body() const { return world_ != nullptr && scenario_[Shared::body] > 0; }
  [[nodiscard]] double energy() const;
  [[nodiscard]] double clear_of(const Eigen::Vector3d& place) const;

  const Scenario& scenario_;
  std::shared_ptr<const haptics::BodyWorld> world_;
  double stiffness_;  // [N/m], of the falling body as shown
  bool is_pushed_ = false, was_pushed_ = false;
  double begin_ = 0, pushed_ = 0, clear_ = 0, haunted_ = 0, fastest_ = 0;
};

}  // namespace reckon::fuzz
