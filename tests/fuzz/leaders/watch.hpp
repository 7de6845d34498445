// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Looks at all hosts and says which invariant does not hold.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/leaders/simulated_host.hpp"
#include "reckon/tests/fuzz/leaders/trial.hpp"

namespace reckon::fuzz::leaders {

/// A host's place in the run.
struct Place {
  std::unique_ptr<SimulatedHost> host;  ///< null: does not run
  nanoseconds clock{};
  nanoseconds awake{};      ///< frozen until then
  nanoseconds disturbed{};  ///< when it last started, stood still, or was cut off from others
  std::uint32_t lives = 0;
  std::size_t waiting = 0;  ///< datagrams that its socket holds
};

class Watch {
 public:
  explicit Watch(const Plan& plan) : plan_(plan) {}

  /// The first invariant that does not hold at this instant.
  [[nodiscard]] std::optional<Finding> look(const std::vector<Place>& places, nanoseconds now);
  void newcomer_starts(const std::vector<Place>& places);

 private:
  using Sentence = std::optional<std::string>;
  [[nodiscard]] Sentence one_leader(const std::vector<Place>& places) const;
  [[nodiscard]] Sentence steady(const std::vector<Place>& places);
  [[nodiscard]] Sentence groups_apart(const std::vector<Place>& places, nanoseconds now) const;
  [[nodiscard]] Sentence groups_given(const std::vector<Place>& places, nanoseconds now) const;
  [[nodiscard]] Sentence states_known(const std::vector<Place>& places) const;
  [[nodiscard]] Sentence nothing_forged(const std::vector<Place>& places) const;
  [[nodiscard]] Sentence in_bounds(const std::vector<Place>& places, nanoseconds now) const;
  [[nodiscard]] Sentence only_the_leader_tells(const std::vector<Place>& places) const;

  const Plan& plan_;
  std::map<aoim::CellId, std::uint32_t> leaders_;  ///< of the calm
  std::vector<std::uint64_t> introductions_;       ///< by host, when the newcomer started
};

}  // namespace reckon::fuzz::leaders
