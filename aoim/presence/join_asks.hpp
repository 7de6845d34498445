// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Requests for the states of a cell that we have just joined. A datagram may be lost, and a switch
// may open its port late. So a request is sent at once and repeated with some of our announcements.
// Its time identifies it, so that peers answer it once. If no peer has answered, a new request is
// made.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/aoim/groups/group_index.hpp"

namespace reckon::aoim {

/// Our requests. One thread; allocates nothing after construction.
class JoinAsks {
 public:
  /// Greatest number of cells in one request.
  static constexpr std::size_t kMostCells = 128;
  /// Peers that own entities there have answered by then: 130 ms plus slow steps at both ends.
  static constexpr std::chrono::milliseconds kAnswered{300};
  /// A request is repeated with an announcement, at most this long after it.
  static constexpr std::chrono::milliseconds kSaidAgain{600};
  /// A request for a silent group is repeated with this many announcements.
  static constexpr int kMostRepetitions = 3;

  /// A requested cell. Consecutive cells with the same time are one request.
  struct Question {
    CellId cell;
    std::uint64_t since = 0;  ///< UTC [ns] of the first request
  };

  /// @param pool number of groups: 1 .. pool are joined and left
  explicit JoinAsks(std::size_t pool) : silent_(pool + 1) {
    joined_.reserve(pool);
    due_.reserve(pool);
  }

  /// @param ask request at once; false at the start, when all peers introduce their entities anyway
  void join(GroupIndex group, CellId cell, bool ask, std::chrono::nanoseconds now) {
    leave(group);
    silent_[group.value] = 1;
    joined_.push_back({group, cell, now, 0, kMostRepetitions, ask});
    has_new_ = has_new_ || ask;
  }
  void leave(GroupIndex group) noexcept {
    std::erase_if(joined_, [group](const Joined& joined) { return joined.group == group; });
  }
  /// A known peer has sent to this group, which is at most the pool. O(1)
  void note_heard(GroupIndex group) noexcept { silent_[group.value] = 0; }

  /// Whether a new request is due.
  [[nodiscard]] bool has_new() const noexcept { return has_new_; }
  /// The time of one more request at `utc` [ns], later than all others: it identifies a request,
  /// and there may be several at one instant, even from several steps.
  [[nodiscard]] std::uint64_t take_time(std::uint64_t utc) noexcept {
    last_time_ = std::max(utc, last_time_ + 1);
    return last_time_;
  }
  /// When an announcement must repeat a request; max if none must.
  [[nodiscard]] std::chrono::nanoseconds next_repetition() const noexcept {
    std::chrono::nanoseconds next = std::chrono::nanoseconds::max();
    for (const Joined& joined : joined_) {
      const bool was_asked_once = joined.since != 0 && joined.left == kMostRepetitions;
      if (was_asked_once) next = std::min(next, joined.at + kSaidAgain);
    }
    return next;
  }
  /// The cells to request now; valid until the next call. @param utc in ns @param announcing
  /// whether an announcement is sent now
  [[nodiscard]] std::span<const Question> take_due(std::chrono::nanoseconds now, std::uint64_t utc,
                                                   bool announcing) {
    due_.clear();
    std::size_t fresh = 0;
    std::uint64_t time = 0;
    const auto ask_anew = [&](Joined& joined) {
      if (fresh++ % kMostCells == 0) time = take_time(utc);
      joined.since = time;
      due_.push_back({joined.cell, joined.since});
    };
    for (Joined& joined : joined_) {
      if (joined.is_new) {
        joined.is_new = false;
        joined.at = now;
        ask_anew(joined);
      } else if (announcing && now - joined.at >= kAnswered) {
        const bool is_silent = silent_[joined.group.value] != 0;
        if (is_silent) {
          ask_anew(joined);
        } else if (joined.left == kMostRepetitions && joined.since != 0) {
          due_.push_back({joined.cell, joined.since});  // for peers that have not received it
        }
        joined.left = is_silent ? joined.left - 1 : 0;
      }
    }
    std::erase_if(joined_, [](const Joined& joined) { return joined.left == 0; });
    std::ranges::sort(due_, {}, &Question::since);
    has_new_ = false;
    return due_;
  }

 private:
  struct Joined {
    GroupIndex group;
    CellId cell;
    std::chrono::nanoseconds at{};
    std::uint64_t since = 0;  // of the last request; 0: none yet
    int left = kMostRepetitions;
    bool is_new = false;
  };

  std::vector<Joined> joined_;        // cells with requests to come
  std::vector<std::uint8_t> silent_;  // by group
  std::vector<Question> due_;
  std::uint64_t last_time_ = 0;  // of take_time()
  bool has_new_ = false;
};

/// Recently received requests, by requester and time. One thread; no allocation.
class ReceivedAsks {
 public:
  /// False if it is known already. A request that was dropped from memory counts as new.
  /// @param since 0: without a time, always new
  [[nodiscard]] bool note(std::uint32_t epoch, std::uint64_t since) noexcept {
    if (since == 0) return true;
    const std::uint64_t question = since ^ std::uint64_t{epoch} << 32;
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15u;  // Fibonacci hashing
    std::uint64_t& place = heard_[(question * kGolden >> 32) % kKept];
    const bool is_new = place != question;
    place = question;
    return is_new;
  }

 private:
  static constexpr std::size_t kKept = 4096;
  std::array<std::uint64_t, kKept> heard_{};
};

}  // namespace reckon::aoim
