// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a light peer says of an entity by which near group, as the loops of a peer do.
#pragma once

#include <chrono>
#include <cstddef>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/presence/introduction.hpp"
#include "reckon/bench/studies/scale/crowd.hpp"
#include "reckon/bench/studies/scale/light_peer.hpp"
#include "reckon/bench/studies/scale/near_others.hpp"
#include "reckon/bench/studies/scale/setting.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"

namespace reckon::bench {

/// The near rows of an exercise. One thread.
class LightRows {
 public:
  /// What rows look at; outlives them.
  struct World {
    const aoim::Introduction& introduction;
    NearOthers& others;
    Crowd& crowd;
  };
  /// @param channels the table  @param pool groups of cells
  LightRows(const ScaleChannels& channels, std::size_t pool, const World& world)
      : channels_(channels), pool_(pool), world_(world) {}

  [[nodiscard]] std::size_t near_rows() const noexcept { return channels_.near_rows; }
  /// The group of this near row of a cell, or that of the cell for near_rows().
  [[nodiscard]] aoim::GroupIndex group(std::size_t row, aoim::GroupIndex cell) const noexcept {
    const std::size_t pools = row < near_rows() ? row + 1 : 0;
    return {static_cast<std::uint16_t>(cell.value + pools * pool_)};
  }
  /// The pool that a group is of: 0 of cells, then those of near rows.
  [[nodiscard]] std::size_t pool_of(aoim::GroupIndex group) const noexcept {
    return group == aoim::kBaseGroup ? 0 : (group.value - 1u) / pool_;
  }
  [[nodiscard]] aoim::GroupIndex cell_of(aoim::GroupIndex group) const noexcept {
    return {static_cast<std::uint16_t>(group.value - pool_of(group) * pool_)};
  }

  /// Makes the audiences of an entity, which were told all that its policy was, at `told` [s].
  void set_tiers(LightEntity& entity, const deadreckon::KinematicState& state, double told,
                 deadreckon::SendReason reason, double first_heartbeat) const;
  /// One that is looked at.
  struct Looked {
    std::uint32_t entity;
    pdu::EntityId id;
    aoim::GroupIndex cell;
    bool is_asked;  ///< all are to be told
  };
  /// Whom to tell, and why: `none` where nobody need be told.
  struct Due {
    deadreckon::SendReason reason = deadreckon::SendReason::none;
    std::size_t row = 0;
    bool is_patient = false;  ///< it may wait for company
  };
  [[nodiscard]] Due consider(LightEntity& entity, const Looked& at, double time);

 private:
  [[nodiscard]] std::size_t asked_row(const LightEntity& entity, const Looked& at,
                                      double time) const;
  [[nodiscard]] Due choose(const LightEntity& entity, const deadreckon::Pose& truth, double time,
                           bool moves) const;

  ScaleChannels channels_;
  std::size_t pool_;
  World world_;
};

}  // namespace reckon::bench
