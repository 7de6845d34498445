// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which voters receive this peer, and since when this peer has not received others. A peer may act
// as an owner while a majority receives it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "reckon/peer/ownership/roll.hpp"

namespace reckon::peer {

/// Peers announce themselves in numbered rounds, and return the number of the last round that they
/// received of each voter. A lease begins when the returned round was SENT, so it is right for any
/// delay. A voter that has received a round votes against the removal of its sender for kDead,
/// which is longer than the lease. Only differences of this peer's own clock matter.
/// One thread; no allocation.
class LeaseBook {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr Nanoseconds kLease = std::chrono::seconds(2);
  static constexpr Nanoseconds kDead = std::chrono::seconds(3);
  /// For this time after a lease ends, no majority removes the peer that held it. A tenth of a second is
  /// left for clocks of different rates.
  static constexpr Nanoseconds kGrace = kDead - kLease - std::chrono::milliseconds(100);
  /// An older round is not returned: its number could be taken for a new one.
  static constexpr Nanoseconds kOldest = std::chrono::seconds(8);
  /// Least time between two rounds.
  static constexpr Nanoseconds kRound = std::chrono::milliseconds(100);

  /// Restarts the silence of all peers: this peer slept, or voters have changed.
  void restart(Nanoseconds now) noexcept { restarted_ = now; }
  [[nodiscard]] Nanoseconds restarted() const noexcept { return restarted_; }

  /// Number of the present round, 1 .. 255. A new one begins if the last is kRound old.
  [[nodiscard]] std::uint8_t round(Nanoseconds now) noexcept;
  /// A round of a peer has arrived. An older one than the last is ignored.
  void receive(std::uint32_t epoch, std::uint8_t round, Nanoseconds now) noexcept;
  /// A peer has received this round of ours.
  void confirm(std::uint32_t epoch, std::uint8_t round, Nanoseconds now) noexcept;
  /// The round to return to this peer; 0: none.
  [[nodiscard]] std::uint8_t round_of(std::uint32_t epoch, Nanoseconds now) const noexcept;
  /// When this round of ours was sent; nothing if it is too old or never was.
  [[nodiscard]] std::optional<Nanoseconds> sent_at(std::uint8_t round,
                                                   Nanoseconds now) const noexcept;

  /// Since when nothing of this peer has arrived: the last arrival, or restart().
  [[nodiscard]] Nanoseconds silent_since(std::uint32_t epoch) const noexcept;
  /// Last arrival; far in the past if there was none.
  [[nodiscard]] Nanoseconds heard_at(std::uint32_t epoch) const noexcept;
  /// End of the lease that a majority of `roll` gives to `own`.
  [[nodiscard]] Nanoseconds lease_end(const Roll& roll, std::uint32_t own,
                                      Nanoseconds now) const noexcept;

 private:
  struct Row {
    std::uint32_t epoch = 0;
    std::uint8_t round = 0;
    Nanoseconds heard = kNever, confirmed = kNever;
  };
  static constexpr Nanoseconds kNever = Nanoseconds::min() / 4;
  static constexpr std::size_t kRows = 2 * Roll::kMost;
  static constexpr std::uint32_t kRounds = 255;
  static constexpr std::uint32_t kRemembered = 100;

  [[nodiscard]] const Row* find(std::uint32_t epoch) const noexcept;
  [[nodiscard]] Row& row_of(std::uint32_t epoch) noexcept;

  std::array<Row, kRows> rows_{};
  std::size_t used_ = 0;  // of rows_
  std::array<Nanoseconds, kRounds> sent_{};
  std::uint32_t rounds_ = 0;  // begun so far
  Nanoseconds restarted_ = kNever;
};

}  // namespace reckon::peer
