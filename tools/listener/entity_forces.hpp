// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The force models that a listener has heard, on their dead-reckoned entities: what they do to each
// other's probes, and how far each new model changes that.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "reckon/deadreckon/force/force_predictor.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"
#include "reckon/tools/listener/jump_histogram.hpp"

namespace reckon::tools {

/// What is remembered of one haptic entity.
struct EntityForce {
  deadreckon::ForcePredictor predictor;
  deadreckon::ForcePredictor before;  ///< as it was before the entity's last update
  double updated = 0;                 ///< of that update [s]
  JumpHistogram jumps;                ///< of the force, in contact only [N]
};

/// All of them, by place: places are given from 0 on and stay until keep(). One thread; times are
/// seconds of any steady clock of the caller's.
class EntityForces {
 public:
  /// A force is evaluated at the probes of at most so many other entities.
  static constexpr std::size_t kMostProbes = 64;
  /// A new model counts as new where a coefficient differs by this share, or the force by this [N].
  static constexpr double kNewShare = 1e-3;
  static constexpr double kNewForce = 0.01;

  /// A new entity that has had a force model.
  [[nodiscard]] std::size_t add();
  /// Takes its motion at `now`.
  void update_entity(std::size_t place, const deadreckon::KinematicState& state, double now);
  /// Takes its model and returns whether that says something new; nothing where the record is not
  /// to be used.
  std::optional<bool> update_model(std::size_t place, const pdu::HapticRecord& record,
                                   const deadreckon::KinematicState& state, double now);

  [[nodiscard]] const EntityForce& at(std::size_t place) const { return forces_[place]; }
  /// The largest force [N] that the entity's model gives at the probe of another haptic entity.
  [[nodiscard]] double contact(std::size_t place, double now) const;
  /// Keeps these places alone, in this order.
  void keep(const std::vector<std::size_t>& places);

 private:
  [[nodiscard]] double change(std::size_t place, const deadreckon::ForcePredictor& before,
                              double now, double& largest) const;

  std::vector<EntityForce> forces_;
};

}  // namespace reckon::tools
