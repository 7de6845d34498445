// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Couplings of two ends over a delayed line, for studies. All but the last are only for comparison:
// docs/baselines.md explains each and its failures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace reckon::bench {

enum class CouplingMode : std::uint8_t {
  velocity_exchange,       ///< thesis (4.1): own speed minus the other's drives a local environment
  effort_flow,             ///< (4.12): flow is sent, effort returns, both delayed
  transmission_line,       ///< (4.14): the same as waves of a lossless line
  gain_cut,                ///< a stiffness low enough to be passive with the known delay
  passivity_controller,    ///< dead reckoning as printed, with an energy observer and a damper
  printed_dead_reckoning,  ///< a received model, each update applied on arrival
  reckon,                  ///< the product: the same model behind the energy port
};

inline constexpr std::array kCouplingModes{CouplingMode::velocity_exchange,
                                           CouplingMode::effort_flow,
                                           CouplingMode::transmission_line,
                                           CouplingMode::gain_cut,
                                           CouplingMode::passivity_controller,
                                           CouplingMode::printed_dead_reckoning,
                                           CouplingMode::reckon};

/// Name in flags and tables: "velocity_exchange", .., "reckon".
[[nodiscard]] constexpr std::string_view name_of(CouplingMode mode) noexcept {
  constexpr std::array<std::string_view, kCouplingModes.size()> kNames{"velocity_exchange",
                                                                       "effort_flow",
                                                                       "transmission_line",
                                                                       "gain_cut",
                                                                       "passivity_controller",
                                                                       "printed_dead_reckoning",
                                                                       "reckon"};
  return kNames[static_cast<std::size_t>(mode)];
}

/// No value if no mode has that name.
[[nodiscard]] constexpr std::optional<CouplingMode> coupling_mode(std::string_view name) noexcept {
  for (const CouplingMode mode : kCouplingModes) {
    if (name_of(mode) == name) return mode;
  }
  return std::nullopt;
}

}  // namespace reckon::bench
