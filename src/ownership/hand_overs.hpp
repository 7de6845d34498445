// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The objects that this peer holds, asks for, or gives to another peer.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/peer/ownership/ownership_core.hpp"

namespace reckon::peer {

/// One thread; no allocation.
///
/// none -> asking -> owned, unconfirmed -> owned -> yielding -> granting -> none. An unconfirmed
/// owner acts for a time in which no majority can remove the former owner; after that only if a
/// majority has noted it as the owner.
class HandOvers {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// A grant is taken within this time after the round that it returns was sent.
  static constexpr Nanoseconds kTake = std::chrono::milliseconds(1500);
  /// A grant without an answer is given up after this time. By then the new owner has taken it and
  /// a majority knows that, or it does not act.
  static constexpr Nanoseconds kGiveUp = LeaseBook::kDead + std::chrono::milliseconds(300);

  explicit HandOvers(OwnershipCore& core) : core_(core) {}

  /// Wants the object until withdraw().
  void ask(std::size_t object) noexcept { rows_[object].wanted = true; }
  void withdraw(std::size_t object);
  /// The state in which the object was granted to us, or in which we grant it.
  [[nodiscard]] const ObjectState& state(std::size_t object) const noexcept {
    return rows_[object].state;
  }
  void set_state(std::size_t object, const ObjectState& state) noexcept {
    rows_[object].state = state;
  }
  /// The objects of a yield are at rest here, and their states are set: the grant is sent.
  void yielded(std::uint32_t transaction, Nanoseconds now);

  void receive(const Request& request, std::uint32_t from, Nanoseconds now);
  void receive(const Grant& grant, std::uint32_t from, Nanoseconds now);
  void receive(const Refusal& refusal, std::uint32_t from);
  void receive(const TableExtract& extract, std::uint32_t from, Nanoseconds now);
  void receive(const Agreement& agreement, std::uint32_t from);
  void step(Nanoseconds now);

  /// Owns these objects from now on, by an act.
  void gain(const ObjectSet& objects, OwnerChange cause);
  /// An act was decided: drops what it gave to others, takes back what was granted to a removed
  /// peer. The new voters must note the owners again.
  /// @param lease_end of the lease that the former voters gave
  void follow_act(Nanoseconds lease_end);
  /// Gives up all objects.
  void drop_all(OwnerChange cause);
  /// Gives up held objects of this set for good, so that an act can give them away.
  void release(const ObjectSet& objects);

  /// Whether this peer may move the object now.
  [[nodiscard]] bool owns(std::size_t object, Nanoseconds now) const noexcept;
  /// Whether it holds it, also without a lease, or while it hands it over.
  [[nodiscard]] bool holds(std::size_t object) const noexcept {
    return rows_[object].hold != Hold::none;
  }
  [[nodiscard]] ObjectSet held() const noexcept;
  [[nodiscard]] bool is_busy() const noexcept;
  /// Whether a grant of ours may have an owner that is not confirmed yet.
  [[nodiscard]] bool has_granted(Nanoseconds now) const noexcept;
  [[nodiscard]] bool is_granting() const noexcept;
  /// Gives nothing more away.
  void close() noexcept { is_closed_ = true; }
  void open() noexcept { is_closed_ = false; }

 private:
  enum class Hold : std::uint8_t { none, owned, yielding, granting };
  static constexpr std::size_t kAskers = 4;
  struct Asker {
    std::uint32_t epoch = 0;  // 0: none
    Nanoseconds heard{0};
  };
  struct Row {
    Hold hold = Hold::none;
    bool confirmed = false, wanted = false;
    std::uint32_t transaction = 0, to = 0;  // while yielding or granting
    Nanoseconds since{0};                   // of the newest round of `to`, while granting
    Nanoseconds until{0};                   // while unconfirmed
    std::uint64_t agreed = 0;               // bits of the voters of the decided act ..
    std::uint32_t first_serial = 0;         // .. to extracts from this one on
    std::uint32_t asked = 0;                // epoch
    Nanoseconds ask_at{0};                  // next request
    std::array<Asker, kAskers> askers{};    // oldest first
    ObjectState state;
  };
  struct Outgoing {
    std::uint32_t transaction = 0;  // 0: none
    std::uint32_t to = 0;
    ObjectSet objects;
    std::uint32_t lease_ms = 0;
  };
  struct Incoming {
    std::uint32_t transaction = 0, from = 0;
    ObjectSet objects, arrived;
    bool is_refused = false;
    Nanoseconds heard{0};
    std::array<std::uint64_t, kMostOwnable> tenures{};  // versions
  };

  void ask_due(Nanoseconds now);
  void grant_due(Nanoseconds now);
  void begin_grant(std::size_t object, std::uint32_t to);
  [[nodiscard]] bool can_grant(std::size_t object, Nanoseconds now) const;
  void send_grant(const Outgoing& grant, Nanoseconds now);
  void give_up(Nanoseconds now);
  void take_back(std::size_t object);
  void announce(Nanoseconds now);
  void confirm_if_agreed(Row& row) noexcept;
  [[nodiscard]] bool may_take(const Grant& grant, std::uint32_t from, Nanoseconds now) const;
  void take(const Incoming& grant, const Grant& last, Nanoseconds now);
  [[nodiscard]] bool is_outdated(const Grant& grant) const noexcept;
  [[nodiscard]] Incoming* incoming_of(const Grant& grant, std::uint32_t from, Nanoseconds now);
  [[nodiscard]] bool may_agree(const Holding& holding, std::uint32_t from) const noexcept;
  void lose(std::size_t object, OwnerChange cause, std::uint32_t to);
  void note_table(std::size_t object, std::uint32_t from);
  void release_unheld();

  OwnershipCore& core_;
  std::array<Row, kMostOwnable> rows_{};
  std::array<Outgoing, 32> outgoing_{};
  std::array<Incoming, 32> incoming_{};
  std::uint32_t transactions_ = 0;
  std::uint32_t serial_ = 0;
  Nanoseconds announce_at_{0};
  Nanoseconds granted_at_ = Nanoseconds::min() / 4;
  bool is_closed_ = false;
};

}  // namespace reckon::peer
