// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// From the words of `reckon bench stability` to its plan.
#pragma once

#include <string>
#include <vector>

#include "reckon/bench/studies/stability/plan.hpp"
#include "reckon/bench/studies/stability/run.hpp"

namespace reckon::bench {

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
