// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads the flags of `reckon bench stability` into its plan.
#pragma once

#include <string>
#include <vector>

#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/bench/studies/stability/plan.hpp"

namespace reckon::bench {

/// The words as typed.
struct StabilityWords : SharedWords {
  std::vector<std::string> sweeps;  ///< "delay=0..200ms/5"
  std::vector<std::string> modes;   ///< names and commas; none: the scene's baseline, else all
  std::string hand;                 ///< recorded trace of the hand
  std::string peak = "10 N";
  bool no_gate = false;

  [[nodiscard]] std::vector<Flag> flags();
};

struct StabilityOptions {
  StabilityPlan plan;
  std::vector<std::string> notes;  ///< settings of the scene that the study ignores
};

/// Checked options. @throws UsageError with the word and the remedy
[[nodiscard]] StabilityOptions read_stability_options(const StabilityWords& words);

/// A recorded hand along the axis of its greatest extent, directed into the surface (downwards if
/// the axis is z), scaled to at most 20 mm around about 4 mm of depth, after half a second of
/// approach. It has the grip of the tracking hand. @throws UsageError
[[nodiscard]] OperatorModel recorded_operator(const std::string& file);

}  // namespace reckon::bench
