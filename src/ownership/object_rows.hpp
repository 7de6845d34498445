// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The objects that this peer holds, wants or gives away, one row for each.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/peer/ownership/ownership_core.hpp"

namespace reckon::peer {

/// A peer that has asked for an object.
struct Asker {
  std::uint32_t epoch = 0;  ///< 0: none
  std::chrono::nanoseconds heard{0};
};

/// none -> owned, unconfirmed -> owned -> yielding -> granting -> none. An unconfirmed owner acts
/// for a time in which no majority can remove the former owner; after that only if a majority has
/// noted it as the owner.
struct ObjectRow {
  enum class Hold : std::uint8_t { none, owned, yielding, granting };
  static constexpr std::size_t kAskers = 4;

  Hold hold = Hold::none;
  bool confirmed = false, wanted = false;
  std::uint32_t transaction = 0, to = 0;  ///< while yielding or granting
  std::chrono::nanoseconds since{0};      ///< of the newest round of `to`, while granting
  std::chrono::nanoseconds until{0};      ///< while unconfirmed
  std::uint64_t agreed = 0;               ///< bits of the voters of the decided act ..
  std::uint32_t first_serial = 0;         ///< .. to extracts from this one on
  std::uint32_t asked = 0;                ///< epoch
  std::chrono::nanoseconds ask_at{0};     ///< next request
  std::array<Asker, kAskers> askers{};    ///< oldest first
  ObjectState state;                      ///< in which it was granted, or is to be
};

/// One thread; no allocation.
class ObjectRows {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  explicit ObjectRows(OwnershipCore& core) : core_(core) {}

  [[nodiscard]] ObjectRow& operator[](std::size_t object) noexcept { return rows_[object]; }
  [[nodiscard]] const ObjectRow& operator[](std::size_t object) const noexcept {
    return rows_[object];
  }

  /// Owns these objects from now on, by an act.
  void gain(const ObjectSet& objects, OwnerChange cause);
  /// An act was decided: drops what it gave to others. The new voters must note the owners again.
  /// An object that was granted to a removed peer stays granted: that peer may have passed it on.
  /// @param lease_end of the lease that the former voters gave
  void follow_act(Nanoseconds lease_end);
  /// The table has changed by a message of this peer: drops the object if another one owns it.
  void note_table(std::size_t object, std::uint32_t from);
  /// Owns an object again that was to be given away.
  void take_back(std::size_t object);
  /// Gives up all objects.
  void drop_all(OwnerChange cause);
  /// Gives up held objects of this set for good, so that an act can give them away.
  void release(const ObjectSet& objects);
  void release_unheld();

  /// Whether this peer may move the object now, if it has a lease.
  [[nodiscard]] bool owns(std::size_t object, Nanoseconds now) const noexcept;
  /// Whether it holds it, also without a lease, or while it hands it over.
  [[nodiscard]] bool holds(std::size_t object) const noexcept {
    return rows_[object].hold != ObjectRow::Hold::none;
  }
  [[nodiscard]] ObjectSet held() const noexcept;
  [[nodiscard]] bool is_busy() const noexcept;
  [[nodiscard]] bool is_granting() const noexcept;

  std::uint32_t serial = 0;  ///< of our last TableExtract that asks

 private:
  void lose(std::size_t object, OwnerChange cause, std::uint32_t to);

  OwnershipCore& core_;
  std::array<ObjectRow, kMostOwnable> rows_{};
};

}  // namespace reckon::peer
