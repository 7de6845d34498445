// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sample of the positions of an exercise's entities, used to divide a quad-tree.
#pragma once

#include <filesystem>
#include <vector>

#include "reckon/aoim/cells/quad_tree.hpp"

namespace reckon::peer {

/// Limits of places in total and at one instant: more would take too long to divide a square.
inline constexpr std::size_t kMostPlaces = 50'000, kMostAtOnce = 10'000;

/// Reads a CSV table with a header: columns x_m and y_m, or px_m and py_m, in S; also t_s if there
/// are several instants. Other columns are ignored, so recorded traffic and tracks can be used.
/// Each place receives within `reach` [m] at its instant.
/// @throws CsvError "file:line:column: what", with the remedy, also for too many places.
[[nodiscard]] std::vector<aoim::Demand> read_density(const std::filesystem::path& file,
                                                     double reach);

}  // namespace reckon::peer
