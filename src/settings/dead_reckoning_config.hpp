// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Settings for sending a moving entity. Filled by scene_file.hpp, and by programs.
#pragma once

#include <chrono>
#include <optional>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/sending/send_rules.hpp"
#include "reckon/pdu/codec/enumerations.hpp"

namespace reckon::peer {

/// Tolerated error of a remote copy before an update is sent.
struct DeadReckoningConfig {
  /// None: the algorithm that needs the fewest updates for the present motion
  /// (deadreckon::ModelChoice).
  std::optional<pdu::DeadReckoningAlgorithm> algorithm;
  /// [m], [rad], [N], each > 0; a larger threshold sends less and shows a larger error.
  deadreckon::Thresholds thresholds = {0.0005, 0.05235987755982989, 0.05};
  /// Row of kSendRules: how an error of position is compared with the threshold.
  const deadreckon::SendRule* rule = &deadreckon::kDefaultSendRule;
  /// Meaning of the acceleration of RVB; all peers of a scene must have the same.
  deadreckon::AccelerationReading acceleration = deadreckon::AccelerationReading::component_rate;
  std::chrono::nanoseconds heartbeat = std::chrono::seconds(5);  ///< the time-out is 2.4 heartbeats
};

}  // namespace reckon::peer
