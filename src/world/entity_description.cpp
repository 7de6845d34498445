// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/entity_description.hpp"

namespace reckon::peer {

DeadReckoningConfig EntityDescription::ordinary() {
  constexpr double kThreeDegrees = 0.05235987755982989;
  DeadReckoningConfig config;
  config.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  config.thresholds.position = 1.0;
  config.thresholds.angle = kThreeDegrees;
  config.heartbeat = std::chrono::nanoseconds(0);
  return config;
}

}  // namespace reckon::peer
