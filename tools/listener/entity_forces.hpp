// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The forces of a listener's models at the probes of other entities, fading after their validity as
// in a peer's predictor, and their changes by new models.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "reckon/deadreckon/force/force_predictor.hpp"
#include "reckon/tools/listener/jump_histogram.hpp"
#include "reckon/tools/listener/listener.hpp"

namespace reckon::tools {

/// Force changes by the models of a listener; rows have the indices of the models. One thread.
class EntityForces {
 public:
  /// Limit of other entities at whose probes a force is evaluated.
  static constexpr std::size_t kMostProbes = 64;
  /// A model is new if a coefficient differs by this share, or the force by this [N].
  static constexpr double kNewShare = 1e-3;
  static constexpr double kNewForce = 0.01;

  /// Called before a state is taken: keeps the present prediction of its model.
  void note_state(const Listener& listener, const StateUpdate& update);
  /// Called before a model is taken. @return whether it is new, see kNewShare
  [[nodiscard]] bool note_model(const Listener& listener, const ModelUpdate& update);
  /// Called before the listener drops the entity of this model.
  void forget_model(std::size_t model);

  /// Force changes of this model at updates, in contact only [N].
  [[nodiscard]] const JumpHistogram& jumps(std::size_t model) const { return rows_[model].jumps; }
  /// The largest force [N] of the entity's model at the probe of another entity; 0 without one.
  [[nodiscard]] double contact(const Listener& listener, const ReceivedEntity& entity,
                               std::chrono::nanoseconds now) const;

 private:
  struct Row {
    deadreckon::ForcePredictor before;   // prediction before the last update
    std::chrono::nanoseconds updated{};  // time of the last update
    JumpHistogram jumps;
  };
  [[nodiscard]] double seconds_of(std::chrono::nanoseconds time) const noexcept;
  [[nodiscard]] deadreckon::ForcePredictor predictor_of(
      const Listener& listener, const ReceivedEntity& entity) const noexcept;
  /// Calls `look(probe)` for the probes of other entities.
  void for_probes(const Listener& listener, const ReceivedEntity& entity,
                  std::chrono::nanoseconds now, auto&& look) const;

  std::vector<Row> rows_;
  std::optional<std::chrono::nanoseconds> start_;  // zero of the predictors' time
};

}  // namespace reckon::tools
