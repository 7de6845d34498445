// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Gives slots to bodies that are pushed, met or ordered, and wakes bodies.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/body_slots.hpp"

namespace reckon::haptics {

/// Which bodies have slots, and which have lost them. Servo thread; allocates at construction only.
class WokenBodies {
 public:
  /// @param slots outlives this
  explicit WokenBodies(BodySlots& slots);

  /// A body that lost its slot, if any.
  static constexpr std::uint32_t kNobody = 0xFFFFFFFF;
  /// A slot of a body, and the body that lost it.
  struct Taken {
    std::size_t slot = BodySlots::kNone;  ///< kNone: all slots are awake, which is counted
    std::uint32_t lost = kNobody;
  };
  /// Gives a body without a slot one. @param pinned slots that stay
  [[nodiscard]] Taken take_in(std::size_t body, BodySet pinned) noexcept;
  /// Bodies without a slot that moving ones may reach within `time` [s], ascending. Valid until the
  /// next call. Call before the steps of a period: it forgets what touched carried bodies.
  [[nodiscard]] std::span<const std::uint32_t> met(double time) noexcept;
  /// The same for all that touch `box` [m, S].
  [[nodiscard]] std::span<const std::uint32_t> touching(const Eigen::AlignedBox3d& box) noexcept;
  /// See BodyState::island.
  [[nodiscard]] std::uint32_t island_of(std::size_t slot) const noexcept;
  /// Wakes the sleeping bodies with a slot that touch `box` [m, S].
  void wake(const Eigen::AlignedBox3d& box) noexcept;
  /// Whether an owned body is awake, or a carried one moves and may reach an owned one within
  /// `time` [s].
  [[nodiscard]] bool is_any_moving(double time) const noexcept;
  /// Starts a period, for crowded().
  void begin_period() noexcept { is_crowded_ = false; }
  /// The state of a body without a slot has changed.
  void note_changed(std::uint32_t body) noexcept;

  /// Bodies with a slot, by their slots.
  [[nodiscard]] std::span<const std::uint32_t> with_slot() const noexcept {
    return {in_slot_.data(), slots_.size()};
  }
  /// Number of bodies that have lost their slot or changed without one, and the last of them.
  [[nodiscard]] std::uint64_t left() const noexcept { return left_count_; }
  [[nodiscard]] std::span<const std::uint32_t> last_left() const noexcept { return left_; }
  /// See BodyWorld.
  [[nodiscard]] std::uint64_t crowded() const noexcept { return crowded_; }

 private:
  [[nodiscard]] Eigen::AlignedBox3d reach_of(std::size_t slot, double time) const noexcept;

  BodySlots& slots_;
  std::array<std::uint32_t, BodySlots::kMost> in_slot_;
  std::vector<std::uint32_t> met_;
  std::vector<std::uint32_t> left_;  // the last ones
  std::uint64_t left_count_ = 0, crowded_ = 0;
  bool is_crowded_ = false;  // a body found no slot in this period
};

}  // namespace reckon::haptics
