// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Jitter in scene files, command lines and sweeps: a time ("5 ms"), or a share of the delay ("40
// %").
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace reckon::peer {

/// Jitter, or the reason why the text is invalid.
struct JitterText {
  std::chrono::nanoseconds jitter{0};  ///< >= 0
  std::string error;                   ///< empty if valid; else one sentence with both spellings
  [[nodiscard]] bool good() const noexcept { return error.empty(); }
};

/// Whether `text` ends with a percent sign, so that read_jitter() reads a share of the delay.
[[nodiscard]] bool is_share_of_delay(std::string_view text) noexcept;

/// Reads a time of 0 or more with its unit, or a share of `delay` from 0 % to 100 %, rounded to the
/// nanosecond. 0 needs no unit. A share above 0 of zero delay is an error.  @param delay >= 0
/// @param delay_example the caller's spelling of a delay, for that error: "--delay 80ms"
[[nodiscard]] JitterText read_jitter(std::string_view text, std::chrono::nanoseconds delay,
                                     std::string_view delay_example);

}  // namespace reckon::peer
