// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the force models of a listener's picture do to the probes of other entities, fading after
// their validity as a peer's predictor does, and how far each new model changes that.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "reckon/deadreckon/force/force_predictor.hpp"
#include "reckon/tools/listener/jump_histogram.hpp"
#include "reckon/tools/listener/listener.hpp"

namespace reckon::tools {

/// Jumps of the forces of a picture's models; rows go with the places of the models. One thread.
class EntityForces {
 public:
  /// A force is evaluated at the probes of at most so many other entities.
  static constexpr std::size_t kMostProbes = 64;
  /// A new model counts as new where a coefficient differs by this share, or the force by this [N].
  static constexpr double kNewShare = 1e-3;
  static constexpr double kNewForce = 0.01;

  /// A state that will be taken: what its model foretold till now is remembered.
  void note_state(const Listener& listener, const StateUpdate& update);
  /// A model that will be taken; returns whether it says something new.
  [[nodiscard]] bool note_model(const Listener& listener, const ModelUpdate& update);
  /// The listener is about to forget the entity of this model.
  void forget_model(std::size_t model);

  /// How the force of this model jumped at updates, in contact only [N].
  [[nodiscard]] const JumpHistogram& jumps(std::size_t model) const { return rows_[model].jumps; }
  /// The largest force [N] that the entity's model gives at the probe of another; 0 without one.
  [[nodiscard]] double contact(const Listener& listener, const ReceivedEntity& entity,
                               std::chrono::nanoseconds now) const;

 private:
  struct Row {
    deadreckon::ForcePredictor before;   // as it was before the last update
    std::chrono::nanoseconds updated{};  // of that update
    JumpHistogram jumps;
  };
  [[nodiscard]] double seconds_of(std::chrono::nanoseconds time) const noexcept;
  [[nodiscard]] deadreckon::ForcePredictor predictor_of(
      const Listener& listener, const ReceivedEntity& entity) const noexcept;
  /// Calls `look(probe)` for the probes of the others.
  template <typename Look>
  void for_probes(const Listener& listener, const ReceivedEntity& entity,
                  std::chrono::nanoseconds now, Look&& look) const;

  std::vector<Row> rows_;
  std::optional<std::chrono::nanoseconds> start_;  // the predictors' seconds are since then
};

}  // namespace reckon::tools
