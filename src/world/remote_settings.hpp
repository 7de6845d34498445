// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Settings for receiving and showing remote entities.
#pragma once

#include <cstddef>
#include <vector>

#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/peer/settings/aoim_config.hpp"
#include "reckon/peer/settings/convergence_config.hpp"
#include "reckon/peer/settings/network_config.hpp"
#include "reckon/peer/world/near_search.hpp"

namespace reckon::peer {

/// Settings for receiving and showing remote entities, and their limits.
struct RemoteSettings {
  double probe_radius = 0.02;  ///< [m] of our own hand, for the force innovation; >= 0
  ConvergenceConfig convergence;
  deadreckon::AccelerationReading acceleration = deadreckon::AccelerationReading::component_rate;
  /// Most entities, 1 .. 2^24. Address space is reserved for all, and memory is touched as they
  /// come: some 1,000 octets each, 1,500 in scenes with adaptive prediction.
  std::size_t capacity = NetworkConfig().entities;
  /// Most memory for entities of plain DIS programs, whose identity is unproven [octets].
  std::size_t strangers_memory = std::size_t{32} << 20;
  double contact_reach = kContactReach;  ///< [m], >= 0, reach of find_near()
  bool record_changes = false;           ///< for take_changes()
  /// An update without articulated parts does not remove them, because owners omit them.
  bool bodies_in_part = false;
  std::vector<NimbusClass> nimbus = {};  ///< by type; the first match applies
  std::size_t near_rows = 0;             ///< rows of channels with groups
  TouchRule touch = {};                  ///< which force models are taken
  /// Owners of the scene's bodies, which outlive the table; null in a plain DIS exercise.
  const aoim::BodyOwners* body_owners = nullptr;
  /// Longest time [s] for which a force model is believed without an update, regardless of its
  /// validity.
  double longest_validity = 65.0;

  [[nodiscard]] bool is_adaptive() const noexcept {
    return convergence.prediction == Prediction::adaptive;
  }
};

}  // namespace reckon::peer
