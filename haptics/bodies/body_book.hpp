// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The states of all bodies as hands and readers see them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/body_solver.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/bodies/carried_objects.hpp"
#include "reckon/haptics/bodies/touched_bodies.hpp"
#include "reckon/haptics/bodies/woken_bodies.hpp"

namespace reckon::haptics {

/// Present and next states. Servo thread; allocates at construction only.
class BodyBook {
 public:
  /// Both outlive this.
  BodyBook(BodySolver& solver, const CarriedObjects& carried);

  [[nodiscard]] std::span<const BodyState> now() const noexcept { return now_; }
  /// Of a body already integrated to the end of the period: its state there; of another body: its
  /// state before the last advance.
  [[nodiscard]] std::span<const BodyState> next() const noexcept { return next_; }
  /// Number of changes of the states, from 1 on.
  [[nodiscard]] std::uint64_t version() const noexcept { return version_; }
  /// Whether no body was awake in the last updates.
  [[nodiscard]] bool is_quiet() const noexcept { return quiet_ >= 2; }
  [[nodiscard]] WokenBodies& woken() noexcept { return woken_; }
  [[nodiscard]] const WokenBodies& woken() const noexcept { return woken_; }

  /// See WokenBodies::take_in().
  [[nodiscard]] std::size_t take_in(std::size_t body, BodySet pinned) noexcept;
  /// While frozen, owned bodies show no velocity.
  void freeze(bool frozen) noexcept { frozen_ = frozen; }
  [[nodiscard]] bool is_frozen() const noexcept { return frozen_; }
  /// Reads the states of `some` and of carried objects into next(), which becomes now().
  /// @param step [s], last step of the bodies `fine`, as of a usual one the others
  void read(BodySet some, double step, BodySet fine, double usual) noexcept;
  /// Reads the states of these bodies at the end of the period. @param step [s]
  void read_ahead(BodySet some, double step) noexcept;
  /// The velocities of a body have changed.
  void read_again(std::size_t body, std::size_t slot) noexcept;
  /// Shows an order's effect on a body.
  void show(std::uint32_t body) noexcept;
  /// See BodyState::copied; before show().
  void set_copied(std::uint32_t body, bool is_copied) noexcept {
    now_[body].copied = next_[body].copied = is_copied;
  }
  /// See ObjectMotion::drawn; after read().
  void note_drawn(std::uint32_t body, const Eigen::Vector3d& way,
                  const Eigen::Vector3d& turn) noexcept {
    now_[body].drawn = way;
    now_[body].drawn_turn = turn;
  }
  /// An order came, which may have had no effect.
  void note_order() noexcept { ++version_; }

  /// A hand touches a body.
  void touch(std::uint32_t body, std::chrono::nanoseconds now) noexcept {
    if (touched_.touch(body, now)) mark_touched(body, true);
  }
  void expire(std::chrono::nanoseconds now) noexcept {
    touched_.expire(now, [this](std::uint32_t body) { mark_touched(body, false); });
  }

 private:
  void read_state(std::size_t slot, double step, BodyState& out) const noexcept;
  void mark_touched(std::uint32_t body, bool is_touched) noexcept;

  const BodySolver& solver_;
  const CarriedObjects& carried_;
  WokenBodies woken_;
  TouchedBodies touched_;
  std::vector<BodyState> now_, next_;
  std::uint64_t version_ = 1;
  std::uint64_t quiet_ = 0;  // updates of the states since a body was awake
  bool frozen_ = false;
};

}  // namespace reckon::haptics
