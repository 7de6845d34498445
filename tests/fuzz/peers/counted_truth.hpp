// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Expected counts of a peer's sequence tracker, from the sets of numbers that arrived: no windows,
// no serial arithmetic.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/groups/sequence_tracker.hpp"

namespace reckon::fuzz {

/// Numbers do not wrap: a test of the wrap subtracts the base. A number far from all before (see
/// SequenceTracker::note) is held until a second one agrees with it. Then the numbers between are
/// missing, or the numbering begins again if the gap is too large.
class CountedTruth {
 public:
  /// The expected verdict on a datagram of this life and number.
  aoim::SequenceVerdict note(std::uint32_t epoch, aoim::GroupIndex group, std::uint32_t sequence);
  void forget(std::uint32_t epoch);
  void forget(aoim::GroupIndex group);
  /// The expected values of `received`, `lost`, `duplicated`, `reordered`, `too_old` and `leaps`.
  [[nodiscard]] aoim::SequenceCounts counts() const;

 private:
  struct Heard {
    std::uint32_t origin = 0;   ///< number of numbers[0]: none below it is accepted
    std::vector<bool> numbers;  ///< whether each number has arrived
    std::uint32_t lowest = 0, highest = 0, distinct = 0;
    std::optional<std::uint32_t> held;  ///< far from all others, and alone
  };
  static void begin(Heard& heard, std::uint32_t sequence);
  static void take(Heard& heard, std::uint32_t sequence);
  aoim::SequenceVerdict take_far(Heard& heard, std::uint32_t sequence);
  template <typename Predicate>
  void retire(Predicate predicate);
  [[nodiscard]] static std::uint64_t missing(const Heard& heard) noexcept {
    return std::uint64_t{heard.highest} - heard.lowest + 1 - heard.distinct;
  }

  std::map<std::pair<std::uint32_t, aoim::GroupIndex>, Heard> heard_;
  aoim::SequenceCounts counts_;  ///< `lost`: of forgotten lives
};

}  // namespace reckon::fuzz
