// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study `zwidth`: for each damping of a wall the border of its stiffness, by theory and
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
  double energy = 0;     ///< measured: stiffer, and a hand can take energy
  double unstable = 0;   ///< measured: from here on swings grow; infinite where none do
  double shown = 0;      ///< by the servo, of a wall of the scene

  /// Share of the theory by which the measured energy border is off.
  [[nodiscard]] double off() const { return passive > 0 ? energy / passive - 1 : 0; }
};

/// Asked with rows done and all; false ends the study.
using ZWidthProgress = std::function<bool(std::size_t done, std::size_t all)>;

/// Rows in the order of `dampings` [N s/m], on all cores; empty where `progress` ended it.
[[nodiscard]] std::vector<ZWidthRow> run_zwidth(const ZWidthDevice& device,
                                                std::span<const double> dampings,
                                                const ZWidthProgress& progress = {});

}  // namespace reckon::bench
