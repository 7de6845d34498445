// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The end of what a stage has taken, as a saved file plays it: what a tab would have got, at full
// speed and without one. What the page saves of itself has the same form (recorder.js).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "reckon/tools/viewer/view_stage.hpp"

namespace reckon::tools {

struct SaveOptions {
  static constexpr std::chrono::nanoseconds kMinute = std::chrono::minutes(1);
  std::chrono::nanoseconds span = kMinute;  ///< of the end
  /// Of pictures [octets], before they become text and a third longer. Where they would take more
  /// they are farther apart. That of recorder.js.
  std::size_t budget = 14'000'000;
};

/// The items that replay.js plays, and what there is to tell of them.
struct SavedRun {
  std::string items;                              ///< JSON
  double left_out = 0, seconds = 0, spacing = 0;  ///< [s]; spacing: the longest between pictures
  std::size_t pictures = 0;
  std::uint16_t entities = 0;  ///< at a time, at most
};

/// @param stage of a capture, which has taken all of it; it has no tabs
[[nodiscard]] SavedRun save_run(ViewStage& stage, const SaveOptions& options);

}  // namespace reckon::tools
