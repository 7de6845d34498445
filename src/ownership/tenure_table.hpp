// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owners of all objects, as this peer knows them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "reckon/peer/ownership/act_book.hpp"
#include "reckon/peer/ownership/tenure.hpp"

namespace reckon::peer {

/// Result of an offered tenure.
enum class Offer : std::uint8_t {
  taken,
  known,         ///< it is in the table
  older,         ///< the table has a newer one
  of_other_act,  ///< its act is not known here
  unwitnessed,   ///< nobody but the sender has named the sender as the owner
};

/// One thread; no allocation.
class TenureTable {
 public:
  /// @param count of objects, at most kMostOwnable
  explicit TenureTable(std::size_t count) noexcept : count_(count) {}

  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] const Tenure& operator[](std::size_t object) const noexcept {
    return tenures_[object];
  }
  /// Sets a tenure that needs no witness: our own, or one by a decided act.
  void set(std::size_t object, const Tenure& tenure) noexcept { tenures_[object] = tenure; }
  /// Offers a tenure that a peer has sent. An owner that names itself needs another peer as
  /// witness: the one that granted the object, or any that knows of the grant.
  /// @param is_silent whether the known owner seems to have failed, so that it cannot witness
  Offer offer(std::size_t object, const Tenure& tenure, std::uint32_t sender, const ActBook& acts,
              bool is_silent) noexcept;
  /// Whether this peer may grant the object, as far as is known here.
  [[nodiscard]] bool may_grant(std::size_t object, std::uint32_t epoch) const noexcept;
  /// Notes that a peer other than the owner names this owner, before the tenure begins.
  void name(std::size_t object, const Tenure& tenure) noexcept;
  void clear() noexcept;

  /// Of all tenures; 0 for an empty table.
  [[nodiscard]] std::uint32_t hash() const noexcept;
  /// Of the tenures of these objects.
  [[nodiscard]] std::uint32_t digest(const ObjectSet& objects) const noexcept;

 private:
  [[nodiscard]] bool is_witnessed(std::size_t object, const Tenure& tenure) const noexcept;
  [[nodiscard]] Offer judge(std::size_t object, const Tenure& tenure, std::uint32_t sender,
                            const ActBook& acts, bool is_silent) const noexcept;

  std::size_t count_;
  std::array<Tenure, kMostOwnable> tenures_{};
  std::array<std::array<Tenure, 3>, kMostOwnable>
      named_{};  // by others than the owner, newest first
};

}  // namespace reckon::peer
