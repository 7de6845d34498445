// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy balance by Tellegen's theorem, thesis (4.11): the power through the ports equals the
// stored and dissipated power of the network, and ideal junctions take none. Off-line code;
// EnergyPort is the balance of the servo.
#pragma once

#include <span>

namespace reckon::bench {

/// Effort [N] and flow [m/s] of a port, means over a tick; effort x flow is the power into the
/// element.
struct PortValue {
  double effort = 0.0, flow = 0.0;
};

enum class Junction {
  common_effort,  ///< all efforts equal, flows add to 0 (springs in series, electrical parallel)
  common_flow,    ///< all flows equal, efforts add to 0 (one body with several forces)
};

/// Sum of effort x flow [W]. 0 over an ideal junction, whatever its kind.
[[nodiscard]] double power(std::span<const PortValue> ports);

/// Deviation of these ports from an ideal junction: the greater of the largest difference of the
/// common quantity and the sum of the other. [N] and [m/s] are mixed: for a check against rounding.
[[nodiscard]] double junction_residual(Junction kind, std::span<const PortValue> ports);

/// The energy balance of a network, tick by tick.
///
///     PowerLedger ledger(stored_at_start);
///     ledger.tick(ports, stored, dissipated, T);
///     ledger.worst_imbalance(); // [J], about 0: the network agrees with its elements
///     ledger.made(); // [J], above 0: it supplied more than it received
class PowerLedger {
 public:
  /// @param stored energy at the start [J]
  explicit PowerLedger(double stored) : start_(stored), stored_(stored) {}

  /// @param ports through which power enters @param stored energy at the end of the tick [J]
  /// @param dissipated during it [J] @param period length [s]
  /// @returns the imbalance: in - change of storage - dissipated [J]
  double tick(std::span<const PortValue> ports, double stored, double dissipated, double period);

  /// Greatest |imbalance| of one tick [J].
  [[nodiscard]] double worst_imbalance() const noexcept { return worst_; }
  /// Energy received through the ports so far [J].
  [[nodiscard]] double absorbed() const noexcept { return absorbed_; }
  /// Greatest energy that the ports ever supplied beyond the energy received and stored at the
  /// start [J]; 0 for a passive network.
  [[nodiscard]] double made() const noexcept { return made_; }

 private:
  double start_, stored_;
  double absorbed_ = 0.0, worst_ = 0.0, made_ = 0.0;
};

}  // namespace reckon::bench
