// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A simulation whose plans follow from seeds: what its program and its tests need of it.
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
  std::uint64_t hash = 0;      ///< of all that the run depends on
  std::uint64_t received = 0;  ///< datagrams, or what the simulation counts in their place
  std::vector<std::string> log;
};

/// A Plan has `seed`, `faults` and `line`; an Outcome is a SeededOutcome. A plan and a fault have a
/// text_of() beside them.
template <typename Plan, typename Outcome>
struct SeededSimulation {
  std::string_view target;  ///< of `./run fuzz`
  std::string_view about;   ///< the sentence of --help
  std::string_view letter;  ///< before the number of an invariant
  int same_again = 0;       ///< number of the invariant that a seed runs the same way twice
  Plan (*plan_of)(std::uint64_t seed) = nullptr;
  Outcome (*try_out)(const Plan& plan, bool keep_log) = nullptr;
  Plan (*calmed)(Plan plan) = nullptr;              ///< the same with a line that does no harm
  std::string_view counted = "datagrams received";  ///< what `received` of an outcome counts
};

}  // namespace reckon::fuzz
