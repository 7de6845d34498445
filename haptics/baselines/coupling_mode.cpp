// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/baselines/coupling_mode.hpp"

#include <cstddef>

namespace reckon::haptics {
namespace {

constexpr std::array<std::string_view, kCouplingModes.size()> kNames{"velocity_exchange",
                                                                     "effort_flow",
                                                                     "transmission_line",
                                                                     "gain_cut",
                                                                     "passivity_controller",
                                                                     "printed_dead_reckoning",
                                                                     "reckon"};

}  // namespace

std::string_view name_of(CouplingMode mode) noexcept {
  return kNames[static_cast<std::size_t>(mode)];
}

std::optional<CouplingMode> coupling_mode(std::string_view name) noexcept {
  for (const CouplingMode mode : kCouplingModes) {
    if (name_of(mode) == name) return mode;
  }
  return std::nullopt;
}

}  // namespace reckon::haptics
