// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a plan: one thread, the kernel's calls answered by a model of the device, a servo, a hand
// that presses into a wall, and a clock that is the model's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/unplugs/plan.hpp"

namespace reckon::fuzz::unplugs {

/// An invariant that did not hold.
struct Finding {
  int invariant = 0;
  nanoseconds at{};
  std::string sentence;
};

struct Outcome {
  std::optional<Finding> finding;
  std::uint64_t hash = 0;      ///< of what was said and where the handle was
  std::uint64_t received = 0;  ///< times that the plug was pulled
  std::uint64_t pressed = 0;   ///< of them while the motors had a force
  std::vector<std::string> log;
};

[[nodiscard]] Outcome try_out(const Plan& plan, bool keep_log = false);

}  // namespace reckon::fuzz::unplugs
