// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a plan: one thread, a clock that jumps from event to event, a network in memory, and a watch
// that looks every 50 ms whether the invariants hold.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/leaders/plan.hpp"

namespace reckon::fuzz::leaders {

/// An invariant that did not hold.
struct Finding {
  int invariant = 0;
  nanoseconds at{};
  std::string sentence;
};

struct Outcome {
  std::optional<Finding> finding;
  std::uint64_t hash = 0;      ///< of all that was received
  std::uint64_t received = 0;  ///< datagrams
  std::uint64_t leads = 0;     ///< times that a life began to lead a cell
  std::vector<std::string> log;
};

[[nodiscard]] Outcome try_out(const Plan& plan, bool keep_log = false);

}  // namespace reckon::fuzz::leaders
