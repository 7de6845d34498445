// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes the last part of a stage's history as a saved file, without a tab and at full speed. The
// page saves in the same form (recorder.js).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "reckon/tools/viewer/view_stage.hpp"

namespace reckon::tools {

struct SaveOptions {
  static constexpr std::chrono::nanoseconds kMinute = std::chrono::minutes(1);
  std::chrono::nanoseconds span = kMinute;  ///< length of the saved part, at the end of the history
  /// Limit of pictures [octets] before base64, which adds a third. Pictures that would exceed it
  /// are farther apart. Same value as in recorder.js.
  std::size_t budget = 14'000'000;
};

/// The items for replay.js, and statistics.
struct SavedRun {
  std::string items;                              ///< JSON
  double left_out = 0, seconds = 0, spacing = 0;  ///< [s]; spacing: the longest between pictures
  std::size_t pictures = 0;
  std::uint16_t entities = 0;  ///< maximum at a time
};

/// @param stage has read the whole capture; it has no tabs
[[nodiscard]] SavedRun save_run(ViewStage& stage, const SaveOptions& options);

}  // namespace reckon::tools
