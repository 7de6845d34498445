// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A simulation with plans by seed: the interface for its program and its tests.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::fuzz {

/// An invariant that did not hold.
struct Finding {
  int invariant = 0;
  std::chrono::nanoseconds at{};
  std::string sentence;
};

/// The result of a run.
template <typename FindingType = Finding>
struct SeededOutcome {
  std::optional<FindingType> finding;
  std::uint64_t hash = 0;      ///< of everything the run depends on
  std::uint64_t received = 0;  ///< datagrams, or another count of the simulation
  std::vector<std::string> log;
};

/// A Plan has `seed`, `faults` and `line`; an Outcome is a SeededOutcome. A plan and a fault have a
/// text_of().
template <typename Plan, typename Outcome>
struct SeededSimulation {
  std::string_view target;  ///< of `./run fuzz`
  std::string_view about;   ///< the sentence of --help
  std::string_view letter;  ///< before the number of an invariant
  int same_again = 0;       ///< number of the invariant that a seed runs the same way twice
  Plan (*plan_of)(std::uint64_t seed) = nullptr;
  Outcome (*try_out)(const Plan& plan, bool keep_log) = nullptr;
  Plan (*calmed)(Plan plan) = nullptr;              ///< the same plan with a harmless line
  std::string_view counted = "datagrams received";  ///< what `received` of an outcome counts
};

}  // namespace reckon::fuzz
