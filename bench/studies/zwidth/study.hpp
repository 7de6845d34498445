// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study `zwidth`: for each damping of a wall the limits of its stiffness, theoretical and
// measured.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "reckon/bench/studies/zwidth/device_border.hpp"

namespace reckon::bench {

/// Stiffnesses [N/m] at one damping of the wall.
struct ZWidthRow {
  double damping = 0;    ///< [N s/m]
  double undelayed = 0;  ///< (3.8), (3.9)
  double passive = 0;    ///< (3.5), with the delay
  double energy = 0;     ///< measured: with a stiffer wall a hand can extract energy
  double unstable = 0;   ///< measured: swings grow from here on; infinite if they never do
  double shown = 0;      ///< by the servo, for a wall of the scene

  /// Relative difference of the measured energy border from the theory.
  [[nodiscard]] double off() const { return passive > 0 ? energy / passive - 1 : 0; }
};

/// Called with the rows done and the total; false ends the study.
using ZWidthProgress = std::function<bool(std::size_t done, std::size_t all)>;

/// Rows in the order of `dampings` [N s/m], on all cores; empty if `progress` ended it.
[[nodiscard]] std::vector<ZWidthRow> run_zwidth(const ZWidthDevice& device,
                                                std::span<const double> dampings,
                                                const ZWidthProgress& progress = {});

}  // namespace reckon::bench
