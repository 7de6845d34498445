// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What one setting of dead reckoning costs and how far off it shows things: owners replay tracks,
// send by the setting over an impaired network, and a viewer looks at each sample's time.
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

/// Models of IEEE 1278.1, by their numbers 0 to 9.
inline constexpr std::size_t kModelCount = 10;

/// Octets of an update alone in its datagram: an Entity State without further records, UDP and
/// IPv4.
inline constexpr double kUpdateOctets = 144 + 8 + 20;

/// How the viewer predicts between updates.
enum class Prediction : std::uint8_t {
  as_sent,  ///< by the model of the update: the owner knows the error
  adaptive  ///< by deadreckon::AdaptiveOrder
};

/// How owners send and viewers show.
struct PoseSetting {
  /// None: deadreckon::ModelChoice, the default of the program.
  std::optional<pdu::DeadReckoningAlgorithm> model;
  deadreckon::Thresholds thresholds;
  const deadreckon::SendRule* rule = &deadreckon::kDefaultSendRule;
  double heartbeat = 5.0;  ///< [s] > 0
  /// [s] silence after a change until it is said again, each repetition waiting twice as long, up
  /// to `heartbeat`; 0: `heartbeat`.
  double first_heartbeat = 0;
  double period = 0;  ///< [s] send at this period and not by thresholds; 0: by thresholds
  deadreckon::ConvergenceSettings convergence;
  Prediction prediction = Prediction::as_sent;
};

/// Size of a list of errors.
struct ErrorSize {
  double rms = 0, p99 = 0, max = 0;
};

/// Of these errors; all 0 where there are none. p99 is the smallest with at least 99 % at or below
/// it. The order of `errors` is lost.
[[nodiscard]] ErrorSize size_of(std::vector<double>& errors);

/// What a viewer saw and what it cost. Errors are those at the times of the samples, before an
/// update sent at the same sample can have arrived; none for an entity before its first update.
struct PoseResult {
  std::uint64_t updates = 0;                          ///< sent
  std::array<std::uint64_t, kModelCount> by_model{};  ///< of these, with each model
  std::uint64_t samples = 0;                          ///< looked at
  double entity_seconds = 0;                          ///< sum of the tracks' lengths [s]
  ErrorSize position;                                 ///< shown against true [m]
  ErrorSize angle;                                    ///< true angle [rad]
  ErrorSize velocity_step;  ///< change of drawn velocity from sample to sample [m/s]

  [[nodiscard]] double updates_per_second() const noexcept {  ///< of one entity, on average
    return entity_seconds > 0 ? static_cast<double>(updates) / entity_seconds : 0;
  }
};

/// What a viewer draws at one sample.
struct PoseSample {
  std::size_t track = 0;  ///< index of its track
  const deadreckon::MotionSample& truth;
  const deadreckon::Pose& shown;
  double error = 0;                   ///< shown against true [m]
  double angle = 0;                   ///< true angle between both orientations [rad]
  std::optional<double> drawn_speed;  ///< since the sample before [m/s]; none at the first
  /// Updates of this track until now. An update of this very sample is sent, and lost, but has not
  /// arrived. One that another overtook has arrived, though it is not used.
  std::uint64_t sent = 0, lost = 0, arrived = 0;
};

/// Told of each sample that counts as an error, track by track; the references hold for the call.
using PoseObserver = std::function<void(const PoseSample&)>;

/// Runs one setting over all tracks. An update that another overtook is dropped: the newest wins.
/// Deterministic: equal arguments give equal results on every
/// machine with IEEE doubles. Cost: some 300 ns a sample; `observer` costs nothing where it is
/// none.
[[nodiscard]] PoseResult run_pose_study(std::span<const Track> tracks, const PoseSetting& setting,
                                        const peer::ImpairmentConfig& network,
                                        const PoseObserver& observer = {});

}  // namespace reckon::bench
