// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// From the words of `reckon bench stability` to its plan.
#pragma once

#include <string>
#include <vector>

#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/bench/studies/stability/plan.hpp"

namespace reckon::bench {

/// The words as typed.
struct StabilityWords : SharedWords {
  std::vector<std::string> sweeps;  ///< "delay=0..200ms/5"
  std::vector<std::string> modes;   ///< names between commas; none: the scene's baseline, else all
  std::string hand;                 ///< recorded trace of the hand
  std::string peak = "10 N";
  bool no_gate = false;

  [[nodiscard]] std::vector<Flag> flags();
};

struct StabilityOptions {
  StabilityPlan plan;
  std::vector<std::string> notes;  ///< what of the scene the study leaves out
};

/// Checked. @throws UsageError with the word and the remedy
[[nodiscard]] StabilityOptions read_stability_options(const StabilityWords& words);

/// A recorded hand along the axis of its greatest extent, downwards into the surface where that is
/// z, shrunk to 20 mm at most about 4 mm of depth, after half a second's way there; held as the
/// tracking hand holds. @throws UsageError
[[nodiscard]] OperatorModel recorded_operator(const std::string& file);

}  // namespace reckon::bench
