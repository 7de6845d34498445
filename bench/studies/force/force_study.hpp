// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What dead reckoning saves of a force: of a recorded one by the deadband, with a held value, a
// straight line or the choice between them; of a contact by its force model, in simulated time.
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
  std::vector<double> times;  ///< [s], growing strictly
  std::vector<Eigen::Vector3d> values;
};

/// A CSV table with a header, t_s and the `columns`; without any: fx_n fy_n fz_n, or f_n. Rows
/// whose time does not grow are passed over. @throws UsageError or peer::CsvError with file, line,
/// column and the remedy.
[[nodiscard]] ForceSignal read_force_signal(const std::filesystem::path& path,
                                            std::span<const std::string> columns = {});

/// One setting of sending a force and what it gave.
struct ForceRow {
  std::string name;     ///< of signal or scene
  std::string setting;  ///< "line, 10 % Weber"
  double packets_per_s = 0;
  double octets_per_s = 0;
  ErrorSize error;  ///< in `unit`
  std::string unit = "N";
  double raw_packets_per_s = 0;  ///< each sample, or each servo step, sent
  double for_force_per_s = 0;    ///< of a contact: updates sent because the force was off
  std::uint64_t samples = 0;
  std::uint64_t outside = 0;  ///< samples where receivers were off by more than the deadband

  /// Share of the raw packets that were sent.
  [[nodiscard]] double share() const noexcept {
    return raw_packets_per_s > 0 ? packets_per_s / raw_packets_per_s : 0;
  }
};

/// Octets of one update of a signal alone in a datagram: an Attribute PDU with one record of type,
/// length, value and rate as float32, UDP and IPv4.
inline constexpr double kSignalOctets = 32 + 8 + 32 + peer::kUdpIpv4Headers;

/// Hold, line and their choice at each of the `webers` (shares of the value). `floor` [unit]: what
/// is never sent. Errors are those of receivers at the samples' times, right after an update of
/// that sample. Some 100 ns a sample and row.
[[nodiscard]] std::vector<ForceRow> force_signal_rows(const ForceSignal& signal,
                                                      std::span<const double> webers, double floor);

/// Thresholds [N] that studies try.
inline constexpr std::array kForceThresholds{0.01, 0.015, 0.02, 0.03, 0.05, 0.1, 0.2};

/// Two peers of `scene` touch in simulated time for `seconds`, once for each threshold [N]. The
/// packets are all that the peers send, poses too; raw is an Entity State and an Attribute PDU each
/// millisecond of each peer. The error is that of the force between hands, after the gate, against
/// the owner's full model at the same place, in contact only. The same every time. Some 0.1 s for a
/// second and threshold, all at once.
[[nodiscard]] std::vector<ForceRow> force_model_rows(const peer::SceneFile& scene,
                                                     std::span<const double> thresholds,
                                                     double seconds);

}  // namespace reckon::bench
