// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The giving side of a hand-over. It keeps a list of the peers that ask for an object, and grants
// the object when no hand holds it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/peer/ownership/object_rows.hpp"

namespace reckon::peer {

/// One thread; no allocation.
class Granting {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// A grant that is not answered within this time is released. By then the new owner has it and a
  /// majority knows that, or it may not act.
  static constexpr Nanoseconds kGiveUp = LeaseBook::kDead + std::chrono::milliseconds(300);
  /// A leaver gives objects away for this time at most.
  static constexpr Nanoseconds kPush = std::chrono::milliseconds(700);

  Granting(OwnershipCore& core, ObjectRows& rows) : core_(core), rows_(rows) {}

  void receive(const Request& request, std::uint32_t from, Nanoseconds now);
  void receive(const GrantRefusal& refusal, std::uint32_t from);
  /// The objects of a yield are at rest here, and their states are set: the grant is sent.
  void yielded(std::uint32_t transaction, Nanoseconds now);
  void step(Nanoseconds now);
  void clear() noexcept { outgoing_.fill({}); }

  /// Whether a grant of ours may have an owner that is not confirmed yet.
  [[nodiscard]] bool has_granted(Nanoseconds now) const noexcept;
  /// Whether a leaver still has objects, and time to give them away.
  [[nodiscard]] bool gives_away(Nanoseconds now) const noexcept;
  /// Stops giving objects away, or goes on.
  void close(bool closed) noexcept { is_closed_ = closed; }

 private:
  struct Outgoing {
    std::uint32_t transaction = 0;  // 0: none
    std::uint32_t to = 0;
    ObjectSet objects;
    std::uint32_t lease_ms = 0;
  };

  void grant_due(Nanoseconds now);
  void push_all(Nanoseconds now);
  void grant_company(std::size_t object, std::uint32_t to);
  void begin_grant(const ObjectSet& objects, std::uint32_t to);
  [[nodiscard]] bool can_grant(std::size_t object, Nanoseconds now) const;
  void send_grant(const Outgoing& grant, Nanoseconds now);
  void give_up(Nanoseconds now);

  OwnershipCore& core_;
  ObjectRows& rows_;
  std::array<Outgoing, 32> outgoing_{};
  std::uint32_t transactions_ = 0;
  Nanoseconds granted_at_ = Nanoseconds::min() / 4;
  Nanoseconds leaving_at_ = Nanoseconds::max();
  bool is_closed_ = false;
};

}  // namespace reckon::peer
