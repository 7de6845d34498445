// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recorded hand motion from a CSV file.
#pragma once

#include <filesystem>

#include "reckon/haptics/devices/hand_trace.hpp"
#include "reckon/peer/tracks/csv_reader.hpp"

namespace reckon::peer {

/// Reads a table with a header; columns t_s, px_m, py_m, pz_m in any order, others ignored.
/// @throws CsvError "file:line:column: what", with the remedy.
[[nodiscard]] haptics::HandTrace read_hand_trace(const std::filesystem::path& file,
                                                 const haptics::HandTraceOptions& options = {});

}  // namespace reckon::peer
