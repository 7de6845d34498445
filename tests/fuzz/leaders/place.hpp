// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A host's place in a run: the trial changes it, and the watch reads it.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/leaders/simulated_host.hpp"

namespace reckon::fuzz::leaders {

struct Place {
  std::unique_ptr<SimulatedHost> host;  ///< null: not running
  nanoseconds clock{};
  nanoseconds asleep{};     ///< frozen since then
  nanoseconds awake{};      ///< frozen until then
  nanoseconds disturbed{};  ///< when it last started, froze, or was cut off from others
  std::uint32_t lives = 0;
  std::size_t waiting = 0;  ///< datagrams in its socket
};

/// The scene and the cells that the host has joined.
[[nodiscard]] inline std::vector<aoim::CellId> cells_of(const SimulatedHost& host) {
  std::vector<aoim::CellId> cells{aoim::kWholeScene};
  for (const aoim::GroupIndex group : host.aoim().subscriptions().cells().joined()) {
    cells.push_back(host.aoim().cells().cell_of(group));
  }
  return cells;
}

[[nodiscard]] inline std::string name(aoim::CellId cell) {
  return cell == aoim::kWholeScene ? "the scene" : fmt::format("cell {} {}", cell.q, cell.r);
}

}  // namespace reckon::fuzz::leaders
