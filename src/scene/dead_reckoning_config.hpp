// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How an owner sends what moves. Filled by scene_file.hpp, and by programs.
#pragma once

#include <chrono>
#include <optional>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/sending/send_rules.hpp"
#include "reckon/pdu/codec/enumerations.hpp"

namespace reckon::peer {

/// How far a remote copy may be off before an update is sent.
struct DeadReckoningConfig {
  /// None: the one that needs the fewest updates, as the motion goes (deadreckon::ModelChoice).
  std::optional<pdu::DeadReckoningAlgorithm> algorithm;
  /// [m], [rad], [N], each > 0; raising one sends less and shows more of that error.
  deadreckon::Thresholds thresholds = {0.0005, 0.05235987755982989, 0.05};
  /// Row of kSendRules: how an error of position is held against the threshold.
  const deadreckon::SendRule* rule = &deadreckon::kDefaultSendRule;
  /// What peers mean by the acceleration of RVB; all peers of a scene have to agree.
  deadreckon::AccelerationReading acceleration = deadreckon::AccelerationReading::component_rate;
  std::chrono::nanoseconds heartbeat = std::chrono::seconds(5);  ///< time-out is 2.4 of these
};

}  // namespace reckon::peer
