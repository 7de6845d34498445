// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The rounds that peers announce: who receives whom, who leaves, and whose table differs.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "reckon/peer/ownership/chair.hpp"
#include "reckon/peer/ownership/granting.hpp"
#include "reckon/peer/ownership/object_rows.hpp"

namespace reckon::peer {

/// Ten rounds a second while an object moves, is wanted or changes its owner anywhere; else two.
/// One thread; no allocation.
class Rounds {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  Rounds(OwnershipCore& core, ObjectRows& rows, Granting& granting, Chair& chair)
      : core_(core), rows_(rows), granting_(granting), chair_(chair) {}

  void receive(const Round& round, std::uint32_t from, Nanoseconds now);
  /// Sends a round if it is due.
  /// @param complied number of an act that may remove this peer, 0: none
  void step(std::uint32_t complied, Nanoseconds now);
  /// Whether our last round agreed to our removal.
  [[nodiscard]] bool agrees() const noexcept { return agrees_; }
  /// Sends all tenures, unless that was done within `gap`.
  void send_table(Nanoseconds gap, Nanoseconds now);
  /// Sends the decided act, at most some thirty times a second.
  void send_decided(std::uint32_t to, Nanoseconds now);
  /// Whether a voter of the decided act knows it too.
  [[nodiscard]] bool is_act_known() const noexcept { return is_act_known_; }
  /// An act was decided. Rounds are fast for a while, so that all know it soon.
  void follow_act(Nanoseconds now) noexcept {
    active_at_ = now;
    tables_.fill(0);
    is_act_known_ = false;
    decided_sent_ = kNever;
  }

 private:
  void note_round(const Round& round, std::uint32_t from, Nanoseconds now);
  void compare_tables(const Round& round, std::uint32_t from, Nanoseconds now);
  [[nodiscard]] std::uint32_t yields_to(std::uint32_t complied, Nanoseconds now) noexcept;
  [[nodiscard]] bool is_active(Nanoseconds now) const;
  void follow(Nanoseconds now);

  static constexpr Nanoseconds kNever = Nanoseconds::min() / 4;

  OwnershipCore& core_;
  ObjectRows& rows_;
  Granting& granting_;
  Chair& chair_;
  Nanoseconds round_at_ = kNever;   // our last round
  Nanoseconds active_at_ = kNever;  // last round of an active peer
  Nanoseconds decided_sent_ = kNever;
  Nanoseconds table_sent_ = kNever, differs_since_ = kNever, differed_ = kNever;
  std::array<std::uint32_t, Roll::kMost> tables_{};  // hashes of the voters' tables
  bool agrees_ = false, is_act_known_ = false;
};

}  // namespace reckon::peer
