// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Packets that dead reckoning saves for a force. A recorded force uses the deadband with a held
// value, a straight line or a choice of these; a contact uses its force model, in simulated time.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/pose/pose_study.hpp"
#include "reckon/deadreckon/sending/deadband.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::bench {

/// A recorded signal of one to three components.
struct ForceSignal {
  std::string name;
  std::string unit = "N";
  std::vector<double> times;  ///< [s], strictly increasing
  std::vector<Eigen::Vector3d> values;
};

/// Reads a CSV table with a header, t_s and the `columns`; by default fx_n fy_n fz_n, or f_n. Rows
/// whose time does not increase are skipped. @throws UsageError or peer::CsvError with file, line,
/// column and the remedy.
[[nodiscard]] ForceSignal read_force_signal(const std::filesystem::path& path,
                                            std::span<const std::string> columns = {});

/// One setting for sending a force, and its result.
struct ForceRow {
  std::string name;     ///< of the signal or scene
  std::string setting;  ///< "line, 10 % Weber"
  double packets_per_s = 0;
  double octets_per_s = 0;
  ErrorSize error;  ///< in `unit`
  std::string unit = "N";
  double raw_packets_per_s = 0;  ///< if each sample, or each servo step, were sent
  double for_force_per_s = 0;    ///< of a contact: updates sent because of the force error
  std::uint64_t samples = 0;
  std::uint64_t outside = 0;  ///< samples at which receivers were off by more than the deadband

  /// Packets sent as a share of the raw packets.
  [[nodiscard]] double share() const noexcept {
    return raw_packets_per_s > 0 ? packets_per_s / raw_packets_per_s : 0;
  }
};

/// Size of one update of a signal alone in a datagram [octets]: an Attribute PDU with one record of
/// type, length, value and rate as float32, UDP and IPv4.
inline constexpr double kSignalOctets = 32 + 8 + 32 + peer::kUdpIpv4Headers;

/// Rows for held value, line and the choice of both at each of the `webers` (shares of the value).
/// Changes below `floor` [unit] are never sent. Errors are measured at receivers at the times of
/// the samples, directly after an update from that sample. About 100 ns a sample and row.
[[nodiscard]] std::vector<ForceRow> force_signal_rows(const ForceSignal& signal,
                                                      std::span<const double> webers, double floor);

/// Default thresholds [N].
inline constexpr std::array kForceThresholds{0.01, 0.015, 0.02, 0.03, 0.05, 0.1, 0.2};

/// Two peers of `scene` touch in simulated time for `seconds`, once for each threshold [N]. Packets
/// are all packets that the peers send, including poses; raw is an Entity State and an Attribute
/// PDU each millisecond from each peer. The error is the difference between the force between hands
/// after the gate and the owner's full model at the same position, in contact only. Deterministic.
/// About 0.1 s a second and threshold; all thresholds run in parallel.
[[nodiscard]] std::vector<ForceRow> force_model_rows(const peer::SceneFile& scene,
                                                     std::span<const double> thresholds,
                                                     double seconds);

}  // namespace reckon::bench
