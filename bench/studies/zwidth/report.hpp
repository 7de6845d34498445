// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study `zwidth` as table, CSV, JSON, picture and page.
#pragma once

#include <string>
#include <vector>

#include "reckon/bench/studies/zwidth/study.hpp"

namespace reckon::bench {

struct ZWidthReport {
  std::string command;  ///< as typed
  std::string subject;  ///< "device 2 of peer 1"; empty for one made of flags alone
  ZWidthDevice device;
  std::vector<ZWidthRow> rows;  ///< at least one
};

/// Table with what its columns mean.
[[nodiscard]] std::string zwidth_text(const ZWidthReport& report);
/// A line of names, then one a row; SI, all digits; empty where swings grow at no stiffness.
[[nodiscard]] std::string zwidth_csv(const ZWidthReport& report);
/// One object a row, the device in each.
[[nodiscard]] std::string zwidth_json(const ZWidthReport& report);
/// The whole picture: borders by theory as lines, what was measured as circles.
[[nodiscard]] std::string zwidth_svg(const ZWidthReport& report);
/// Needs no other file.
[[nodiscard]] std::string zwidth_page(const ZWidthReport& report);

}  // namespace reckon::bench
