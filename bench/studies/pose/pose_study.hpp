// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost and error of one setting of dead reckoning: owners replay tracks and send by the setting
// over an impaired network, and a viewer is evaluated at the time of each sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/tracks/track.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/sending/send_rules.hpp"
#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/peer/network/impairment.hpp"

namespace reckon::bench {

/// Models of IEEE 1278.1, numbers 0 to 9.
inline constexpr std::size_t kModelCount = 10;

/// Size of an update alone in its datagram [octets]: an Entity State without further records, UDP
/// and IPv4.
inline constexpr double kUpdateOctets = 144 + 8 + 20;

/// How the viewer predicts between updates.
enum class Prediction : std::uint8_t {
  as_sent,  ///< by the model of the update, whose error the owner knows
  adaptive  ///< by deadreckon::AdaptiveOrder
};

/// Settings of owners and viewers.
struct PoseSetting {
  /// Empty: deadreckon::ModelChoice, the default of the program.
  std::optional<pdu::DeadReckoningAlgorithm> model;
  deadreckon::Thresholds thresholds;
  const deadreckon::SendRule* rule = &deadreckon::kDefaultSendRule;
  double heartbeat = 5.0;  ///< [s] > 0
  /// [s] of silence after a change until the state is sent again, doubled with each repetition up
  /// to `heartbeat`; 0: `heartbeat`.
  double first_heartbeat = 0;
  double period = 0;  ///< [s] send at this period instead of by thresholds; 0: by thresholds
  deadreckon::ConvergenceSettings convergence;
  Prediction prediction = Prediction::as_sent;
};

/// Size of a list of errors.
struct ErrorSize {
  double rms = 0, p99 = 0, max = 0;
};

/// Size of these errors; all 0 if there are none. p99 is the smallest value with at least 99 % at
/// or below it. The order of `errors` is lost.
[[nodiscard]] ErrorSize size_of(std::vector<double>& errors);

/// Result for a viewer, and its cost. Errors are evaluated at the times of the samples, before an
/// update sent at the same sample can have arrived; an entity has none before its first update.
struct PoseResult {
  std::uint64_t updates = 0;                          ///< sent
  std::array<std::uint64_t, kModelCount> by_model{};  ///< of these, for each model
  std::uint64_t samples = 0;                          ///< evaluated
  double entity_seconds = 0;                          ///< sum of the lengths of the tracks [s]
  ErrorSize position;                                 ///< between shown and true [m]
  ErrorSize angle;                                    ///< rotation angle [rad]
  ErrorSize velocity_step;  ///< change of drawn velocity from sample to sample [m/s]

  [[nodiscard]] double updates_per_second() const noexcept {  ///< for one entity, on average
    return entity_seconds > 0 ? static_cast<double>(updates) / entity_seconds : 0;
  }
};

/// What a viewer draws at one sample.
struct PoseSample {
  std::size_t track = 0;  ///< index of its track
  const deadreckon::MotionSample& truth;
  const deadreckon::Pose& shown;
  double error = 0;                   ///< between shown and true [m]
  double angle = 0;                   ///< rotation angle between both orientations [rad]
  std::optional<double> drawn_speed;  ///< since the sample before [m/s]; none at the first
  /// Updates of this track so far. An update of this sample is counted as sent, and as lost, but
  /// has not arrived. An update that was overtaken counts as arrived, although it is not used.
  std::uint64_t sent = 0, lost = 0, arrived = 0;
};

/// Called for each sample that counts as an error, track by track; the references are valid during
/// the call.
using PoseObserver = std::function<void(const PoseSample&)>;

/// Runs one setting over all tracks. An update that was overtaken is dropped: the newest wins.
/// Deterministic: equal arguments give equal results on every machine with IEEE doubles. Cost:
/// about 300 ns a sample; an empty `observer` costs nothing.
[[nodiscard]] PoseResult run_pose_study(std::span<const Track> tracks, const PoseSetting& setting,
                                        const peer::ImpairmentConfig& network,
                                        const PoseObserver& observer = {});

}  // namespace reckon::bench
