// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The taking side of a hand-over. It asks for objects, takes grants, and asks all voters to note
// the new owner.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/peer/ownership/object_rows.hpp"

namespace reckon::peer {

/// One thread; no allocation.
class Taking {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Greatest age at which a grant is taken, from the time of our round that it returns.
  static constexpr Nanoseconds kTake = std::chrono::milliseconds(1500);

  Taking(OwnershipCore& core, ObjectRows& rows) : core_(core), rows_(rows) {}

  /// Wants the object until withdraw().
  void ask(std::size_t object) noexcept { rows_[object].wanted = true; }
  void withdraw(std::size_t object);

  void receive(const Grant& grant, std::uint32_t from, Nanoseconds now);
  void receive(const TableExtract& extract, std::uint32_t from, Nanoseconds now);
  void receive(const Agreement& agreement, std::uint32_t from);
  void step(Nanoseconds now);
  void clear() noexcept { incoming_.fill({}); }

 private:
  struct Incoming {
    std::uint32_t transaction = 0, from = 0;
    ObjectSet objects, arrived;
    bool is_refused = false;
    Nanoseconds heard{0};
    std::array<std::uint64_t, kMostOwnable> tenures{};  // versions
  };

  void ask_due(Nanoseconds now);
  [[nodiscard]] bool may_take(const Grant& grant, std::uint32_t from, Nanoseconds now) const;
  [[nodiscard]] bool is_outdated(const Grant& grant) const noexcept;
  [[nodiscard]] Incoming* incoming_of(const Grant& grant, std::uint32_t from, Nanoseconds now);
  void take(const Incoming& grant, const Grant& last, Nanoseconds now);
  void announce(Nanoseconds now);
  void confirm_if_agreed(ObjectRow& row) noexcept;
  [[nodiscard]] bool may_agree(const Holding& holding, std::uint32_t from) const noexcept;

  OwnershipCore& core_;
  ObjectRows& rows_;
  std::array<Incoming, 32> incoming_{};
  Nanoseconds announce_at_{0};
};

}  // namespace reckon::peer
