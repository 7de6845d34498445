// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Checks all hosts and reports a violated invariant.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reckon/pdu/reckon/cell_snapshot.hpp"
#include "reckon/tests/fuzz/leaders/lead_watch.hpp"
#include "reckon/tests/fuzz/leaders/map_watch.hpp"
#include "reckon/tests/fuzz/leaders/place.hpp"
#include "reckon/tests/fuzz/leaders/trial.hpp"

namespace reckon::fuzz::leaders {

class Watch {
 public:
  explicit Watch(const Plan& plan) : plan_(plan), map_watch_(plan.calm) {}

  /// The first invariant that does not hold at this instant.
  [[nodiscard]] std::optional<Finding> look(const std::vector<Place>& places, nanoseconds now);
  /// A snapshot part is sent to the newcomer although it is already on its way.
  void note_said_again(const pdu::CellSnapshot& part);
  void newcomer_starts(const std::vector<Place>& places);
  /// A host has acted.
  void note(const Place& place, nanoseconds now) { lead_watch_.note(place, now); }

 private:
  using Sentence = std::optional<std::string>;
  [[nodiscard]] Sentence one_leader(const std::vector<Place>& places) const;
  [[nodiscard]] Sentence steady(const std::vector<Place>& places);
  [[nodiscard]] Sentence groups_apart(const std::vector<Place>& places, nanoseconds now) const;
  [[nodiscard]] Sentence groups_given(const std::vector<Place>& places, nanoseconds now) const;
  [[nodiscard]] Sentence states_known(const std::vector<Place>& places) const;
  [[nodiscard]] Sentence groups_heard(const std::vector<Place>& places, nanoseconds now) const;
  [[nodiscard]] static Sentence beacons_found(const std::vector<Place>& places);
  [[nodiscard]] Sentence newcomer_asks(const std::vector<Place>& places, nanoseconds now) const;
  [[nodiscard]] Sentence nothing_forged(const std::vector<Place>& places) const;
  [[nodiscard]] Sentence in_bounds(const std::vector<Place>& places, nanoseconds now) const;
  [[nodiscard]] Sentence only_the_leader_tells(const std::vector<Place>& places) const;

  [[nodiscard]] std::optional<Finding> look_at_leads(const std::vector<Place>& places,
                                                     nanoseconds now);
  [[nodiscard]] std::optional<Finding> look_at_maps(const std::vector<Place>& places,
                                                    nanoseconds now);
  void note_who_tells(const Place& newcomer, nanoseconds now);
  [[nodiscard]] std::optional<Finding> look_at_newcomer(const std::vector<Place>& places,
                                                        nanoseconds now) const;

  const Plan& plan_;
  LeadWatch lead_watch_;
  MapWatch map_watch_;
  std::map<aoim::CellId, std::uint32_t> leaders_;  ///< leaders during the calm
  std::uint32_t who_tells_ = 0;                    ///< the life that leads the newcomer's cell
  nanoseconds other_tells_since_{};                ///< since when it leads
  std::vector<std::uint64_t> introductions_;       ///< by host, at the newcomer's start
  Sentence said_again_;
};

}  // namespace reckon::fuzz::leaders
