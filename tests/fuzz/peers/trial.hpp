// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a plan: one thread, a clock that jumps from event to event, a network in memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/peers/watch.hpp"

namespace reckon::fuzz {

/// What a run came to.
struct Outcome {
  std::optional<Finding> finding;
  std::uint64_t hash = 0;        ///< of all that was received and all that followed
  std::uint64_t received = 0;    ///< datagrams
  std::vector<std::string> log;  ///< of the two lives that the finding concerns; of all without one
};

[[nodiscard]] Outcome try_out(const Plan& plan, bool keep_log = false);

}  // namespace reckon::fuzz
