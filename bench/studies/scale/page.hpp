// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study of scale as one page that needs no other file.
#pragma once

#include <string>
#include <vector>

#include "reckon/bench/studies/scale/capacity.hpp"
#include "reckon/bench/studies/scale/comparison.hpp"
#include "reckon/bench/studies/scale/hands.hpp"
#include "reckon/bench/studies/scale/many_hands.hpp"
#include "reckon/bench/studies/scale/pick.hpp"
#include "reckon/bench/studies/scale/text.hpp"
#include "reckon/bench/studies/scale/whole_text.hpp"

namespace reckon::bench {

/// All results of a run.
struct ScaleReport {
  std::string command;        ///< as typed
  std::string circumstances;  ///< date, version and host
  HostLimits limits;          ///< of the capacities
  std::vector<ScaleRow> rows;
  std::vector<FittedRow> fitted;
  std::vector<WholeRow> whole;     ///< of processes; empty unless requested
  std::optional<PolicyPick> pick;  ///< empty unless requested
  std::vector<HandsRow> hands;     ///< empty unless requested
  std::vector<ManyHandsRow> many_hands;
  std::vector<BaseRow> base;  ///< of --compare
};

/// Tables and plots: one for each main measure, with a curve for each mechanism, and one of hands.
[[nodiscard]] std::string scale_page(const ScaleReport& report);

}  // namespace reckon::bench
