// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Asking for what is in a cell that we have just joined, when one datagram may be lost on the way
// and the switch may open its port late: first at once, then with some of our announcements. Those
// who have heard the question know it again by its instant; where nobody at all has answered it is
// asked anew.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/aoim/groups/group_index.hpp"

namespace reckon::aoim {

/// What we ask. One thread; allocates nothing after construction.
class JoinAsks {
 public:
  /// Cells of one question at most.
  static constexpr std::size_t kMostCells = 128;
  /// Who has something to send has sent it by then: 130 ms, and slow steps at both ends. Before,
  /// silence tells nothing.
  static constexpr std::chrono::milliseconds kAnswered{300};
  /// A question is said again with an announcement, which leaves so long after it at the latest.
  static constexpr std::chrono::milliseconds kSaidAgain{600};
  /// As long as a group stays silent it is asked about with so many announcements.
  static constexpr int kMostRepetitions = 3;

  /// A cell to ask about now. Those with one instant are one question, and in a row.
  struct Question {
    CellId cell;
    std::uint64_t since = 0;  ///< UTC [ns], of the first time that it was asked
  };

  /// @param pool of groups: 1 .. pool are joined and left
  explicit JoinAsks(std::size_t pool);

  /// @param ask at once; false for who starts, to whom all introduce themselves unasked
  void join(GroupIndex group, CellId cell, bool ask, std::chrono::nanoseconds now);
  void leave(GroupIndex group) noexcept;
  /// Somebody whom we know said something in this group, at most the pool. O(1)
  void note_heard(GroupIndex group) noexcept { silent_[group.value] = 0; }

  /// Whether something is to be asked for the first time.
  [[nodiscard]] bool has_new() const noexcept { return has_new_; }
  /// When an announcement has to leave with which a question is said again; max where none has to.
  [[nodiscard]] std::chrono::nanoseconds next_repetition() const noexcept;
  /// What to ask now; good until the next call. @param utc in ns @param announcing whether an
  /// announcement leaves now
  [[nodiscard]] std::span<const Question> take_due(std::chrono::nanoseconds now, std::uint64_t utc,
                                                   bool announcing);

 private:
  struct Joined {
    GroupIndex group;
    CellId cell;
    std::chrono::nanoseconds at{};
    std::uint64_t since = 0;  // of the last question; 0: not asked
    int left = kMostRepetitions;
    bool is_new = false;
  };

  std::vector<Joined> joined_;        // of which something is still to be asked
  std::vector<std::uint8_t> silent_;  // by group
  std::vector<Question> due_;
  bool has_new_ = false;
};

/// Questions that were heard lately, each by who asked and when. One thread; no allocation.
class HeardAsks {
 public:
  /// False where it was noted before. Some are forgotten for others, and taken for new then.
  /// @param since 0 says nothing: always new
  [[nodiscard]] bool note(std::uint32_t epoch, std::uint64_t since) noexcept;

 private:
  static constexpr std::size_t kKept = 4096;
  std::array<std::uint64_t, kKept> heard_{};
};

}  // namespace reckon::aoim
