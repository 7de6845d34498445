// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Percentiles as JSON objects and table rows, the same in every verb's report.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/counters/error_histogram.hpp"

namespace reckon::tools {

/// {"p50":..,"p99":..,"p999":..,"max":..}
[[nodiscard]] inline std::string spread_json(const peer::Spread& s) {
  return fmt::format(R"({{"p50":{:.6g},"p99":{:.6g},"p999":{:.6g},"max":{:.6g}}})", s.p50, s.p99,
                     s.p999, s.max);
}

/// The same for errors; null values if none was measured.
[[nodiscard]] inline std::string errors_json(const peer::Spread& s) {
  return s.count > 0 ? spread_json(s) : R"({"p50":null,"p99":null,"p999":null,"max":null})";
}

/// Lateness in microseconds, as a Spread.
[[nodiscard]] inline peer::Spread microseconds(const peer::Percentiles& late) {
  const auto us = [](std::chrono::nanoseconds t) { return static_cast<double>(t.count()) * 1e-3; };
  return {us(late.p50), us(late.p99), us(late.p999), us(late.max), 0};
}

/// The heading above spread_row.
inline void spread_heading(std::FILE* out, const char* what) {
  fmt::print(out, "  {:<16} {:>8}   {:>8}   {:>8}   {:>8}\n", what, "p50", "p99", "p99.9", "max");
}

/// One distribution, scaled to `unit`.
inline void spread_row(std::FILE* out, const char* what, const peer::Spread& s, double scale,
                       const std::string& unit) {
  fmt::print(out, "    {:<14} {:>8.3f}   {:>8.3f}   {:>8.3f}   {:>8.3f} {}\n", what, s.p50 * scale,
             s.p99 * scale, s.p999 * scale, s.max * scale, unit);
}

}  // namespace reckon::tools
