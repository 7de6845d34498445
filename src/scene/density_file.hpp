// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sample of where the entities of an exercise are, by which a quad-tree is divided.
#pragma once

#include <filesystem>
#include <vector>

#include "reckon/aoim/cells/quad_tree.hpp"

namespace reckon::peer {

/// More places than these, all together and at one instant, take too long to divide a square by.
inline constexpr std::size_t kMostPlaces = 50'000, kMostAtOnce = 10'000;

/// Reads a CSV table with a header: columns x_m and y_m, or px_m and py_m, in S; t_s too where
/// there are several instants. Others are ignored, so recorded traffic and tracks will do. Each
/// place listens within `reach` [m] at its instant.
/// @throws CsvError "file:line:column: what", with the remedy, also for too many places.
[[nodiscard]] std::vector<aoim::Demand> read_density(const std::filesystem::path& file,
                                                     double reach);

}  // namespace reckon::peer
