// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study of touch as tables, JSON Lines, CSV, a picture and a page.
#pragma once

#include <span>
#include <string>

#include "reckon/bench/studies/touch/touch_study.hpp"

namespace reckon::bench {

/// All that was run.
struct TouchReport {
  std::string command;    ///< as typed
  std::string processor;  ///< of the times
  std::uint64_t seed = 1;
  std::vector<TouchResult> results;
};

/// For people, at most 100 columns.
[[nodiscard]] std::string touch_text(const TouchReport& report);
/// A line for the study, one for each axis, one for each setting.
[[nodiscard]] std::string touch_json(const TouchReport& report);
/// With a line of names.
[[nodiscard]] std::string touch_csv(const TouchReport& report);
/// Nanoseconds against p99 of the error, both logarithmic, colour and shape by axis; the line of
/// 1 ms and that of the least force that is felt; pale: dominated. A file of its own.
[[nodiscard]] std::string touch_svg(std::span<const TouchResult> results);
/// One HTML file: pictures, and tables to sort.
[[nodiscard]] std::string touch_page(const TouchReport& report);

}  // namespace reckon::bench
