// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a peer's sequence tracker should have counted, from the sets of numbers that arrived: no
// windows, no serial arithmetic.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "reckon/aoim/group_index.hpp"
#include "reckon/aoim/sequence_tracker.hpp"

namespace reckon::fuzz {

/// Numbers begin at 1 and stay small: after a forged leap it knows nothing any more.
class CountedTruth {
 public:
  /// The verdict that a datagram of this life and number deserves.
  aoim::SequenceVerdict note(std::uint32_t epoch, aoim::GroupIndex group, std::uint32_t sequence);
  void forget(std::uint32_t epoch);
  void forget(aoim::GroupIndex group);
  /// `received`, `lost`, `duplicated`, `reordered` and `too_old` as they should be.
  [[nodiscard]] aoim::SequenceCounts counts() const;
  /// A number was beyond all that a run can send.
  [[nodiscard]] bool is_lost() const noexcept { return lost_; }

 private:
  struct Heard {
    std::vector<bool> numbers;
    std::uint32_t lowest = 0, highest = 0, distinct = 0;
  };
  template <typename Predicate>
  void retire(Predicate predicate);
  [[nodiscard]] static std::uint64_t missing(const Heard& heard) noexcept {
    return std::uint64_t{heard.highest} - heard.lowest + 1 - heard.distinct;
  }

  std::map<std::pair<std::uint32_t, aoim::GroupIndex>, Heard> heard_;
  static constexpr std::uint32_t kMost = 1 << 20;
  bool lost_ = false;
  aoim::SequenceCounts counts_;  ///< `lost`: of those forgotten
};

}  // namespace reckon::fuzz
