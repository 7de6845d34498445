// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The invariants of ownership, checked after each event of a run.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/owners/audit.hpp"
#include "reckon/tests/fuzz/owners/plan.hpp"
#include "reckon/tests/fuzz/owners/simulated_owner.hpp"
#include "reckon/tests/fuzz/search/seeded_simulation.hpp"

namespace reckon::fuzz::owners {

/// What a run has shown, for the tests.
struct Outcome : SeededOutcome<> {
  std::uint64_t hand_overs = 0, adoptions = 0;
  std::vector<double> gaps;   ///< [s] without an owner
  std::vector<double> waits;  ///< [s] from a touch to the ownership
  bool is_calm = false;       ///< without faults
};

class Watch {
 public:
  Watch(const Plan& plan, std::span<const SimulatedOwner> owners, Outcome& outcome, Audit& audit)
      : plan_(plan), owners_(owners), outcome_(outcome), audit_(audit) {}

  /// I1 one owner, I2 no version falls. After each event.
  void look(Nanoseconds now);
  /// I3 no gap of more than a second without faults. I6 an unopposed hand gets its object. Every
  /// few ms.
  void look_closely(Nanoseconds now);
  /// I4 at the end each object has one owner, I5 and all tables are equal.
  void look_at_end(Nanoseconds now);
  void note_touch(const Touch& touch, bool begins, Nanoseconds now);

 private:
  struct ObjectRecord {
    Nanoseconds owned_at{0}, changed_at{0};
    bool has_owner = false, was_owned = false;
  };
  struct Waiting {
    std::size_t peer = 0, object = 0;
    Nanoseconds since{}, alone{};  ///< since when no other hand is at it
    bool is_fresh = true;          ///< the peer has not withdrawn its request lately
  };
  void find(int invariant, Nanoseconds now, std::string sentence);
  void look_at(std::size_t object, Nanoseconds now);
  [[nodiscard]] bool is_calm() const { return plan_.faults.empty() && plan_.line.late == 0.0; }

  const Plan& plan_;
  std::span<const SimulatedOwner> owners_;
  Outcome& outcome_;
  Audit& audit_;
  std::map<std::pair<peer::WorldId, std::size_t>, std::uint64_t> versions_;
  std::vector<ObjectRecord> objects_ = std::vector<ObjectRecord>(plan_.objects);
  std::vector<Waiting> waiting_;
  std::map<std::pair<std::size_t, std::size_t>, Nanoseconds> lifted_;  // by peer and object
  std::vector<std::uint32_t> hands_ = std::vector<std::uint32_t>(plan_.objects);  // bits of peers
};

}  // namespace reckon::fuzz::owners
