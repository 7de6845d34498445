// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How remote entities are read and shown.
#pragma once

#include <cstddef>
#include <vector>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/peer/scene/peer_config.hpp"
#include "reckon/peer/world/near_search.hpp"

namespace reckon::peer {

/// How remote entities are read and shown, and how many.
struct RemoteSettings {
  double probe_radius = 0.02;  ///< [m] of our own hand, for the force innovation; >= 0
  ConvergenceConfig convergence;
  deadreckon::AccelerationReading acceleration = deadreckon::AccelerationReading::component_rate;
  /// Most entities, 1 .. 2^24. Room is reserved for all, memory is touched as they come: some 900
  /// octets each, 1,500 in scenes of adaptive prediction.
  std::size_t capacity = 100'000;
  /// What is kept of the entities of plain DIS programs, which nobody vouches for, takes no more
  /// [octets].
  std::size_t strangers_memory = std::size_t{32} << 20;
  double contact_reach = kContactReach;  ///< [m], >= 0, within which find_near() finds
  bool record_changes = false;           ///< for take_changes()
  /// An update without articulated parts says nothing of them, for owners leave them out.
  bool bodies_in_part = false;
  std::vector<NimbusClass> nimbus = {};  ///< by type; the first that fits holds
  std::size_t near_rows = 0;             ///< of channels, that have groups
  TouchRule touch = {};                  ///< whose force models are taken
  /// [s] for which a force model is believed at most without an update, whatever it says.
  double longest_validity = 65.0;

  [[nodiscard]] bool is_adaptive() const noexcept {
    return convergence.prediction == Prediction::adaptive;
  }
};

}  // namespace reckon::peer
