// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// In which form each update of an entity goes out: the form that the scene asks for where it can
// carry the update, else plain. Part of the sending half of the model loop.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/deadreckon/residual/residual_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"

namespace reckon::peer {

/// One entity of ours. One thread; no allocation.
///
/// The residual form depends on a key: a plain Entity State, or one of the compact form. One goes
/// out first, again after 1, 4 and 16 updates, then each 32 updates or 10 s, when the entity has
/// changed its group, and when anything besides its motion has changed or somebody is new, from
/// which the gaps begin anew.
class StateCompressor {
 public:
  explicit StateCompressor(pdu::CompressedForm form) noexcept : form_(form) {}

  /// What an update is written as.
  struct Made {
    std::size_t size = 0;  ///< octets as pdu::store_compressed() writes them; 0: send it plain
    bool is_key = false;   ///< it may not wait, nor be replaced by what depends on it
    bool leans = false;    ///< a receiver without the key cannot read it
  };
  static constexpr std::size_t kRoom = pdu::kCompressedHeadSize + pdu::kMostCompressedBody;

  /// @param state with its motion rounded by pdu::quantise(). @param plain for who is new: it goes
  /// plain, as a key
  [[nodiscard]] Made compress(const pdu::EntityState& state, aoim::GroupIndex group, bool plain,
                              std::chrono::nanoseconds now,
                              std::span<std::byte, kRoom> out) noexcept;

  /// The same for those who receive a group of a tier beside that of the cell: the compact form,
  /// which depends on nothing. Returns its octets; 0 where it has parts, and in the residual form,
  /// whose keys the cell's group carries: then all receive the whole state.
  [[nodiscard]] std::size_t compress_near(const pdu::EntityState& state,
                                          std::span<std::byte, kRoom> out) const noexcept;

  [[nodiscard]] pdu::CompressedForm form() const noexcept { return form_; }

 private:
  [[nodiscard]] bool is_key_due(aoim::GroupIndex group,
                                std::chrono::nanoseconds now) const noexcept;
  void note_key(const pdu::EntityState& state, aoim::GroupIndex group,
                std::chrono::nanoseconds now) noexcept;

  pdu::CompressedForm form_;
  aoim::GroupIndex group_;
  std::chrono::nanoseconds keyed_{0};
  unsigned since_ = 0, gap_ = 0;  // updates since the last key, and until the next
  deadreckon::ResidualEncoder residual_;
};

}  // namespace reckon::peer
