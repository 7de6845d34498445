// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Selects the form of each update of an entity: the scene's compressed form if it can represent the
// update, else plain. Part of the sending half of the model loop.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/deadreckon/residual/residual_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"

namespace reckon::peer {

/// One entity of ours. One thread; no allocation.
///
/// The residual form depends on a key state: a plain Entity State, or one of the compact form. A
/// key state is sent first, again after 1, 4 and 16 updates, then every 32 updates or 10 s. One is
/// also sent after a change of the entity's group or of anything besides its motion, and for a new
/// peer; after that the gaps start again with the shortest.
class StateCompressor {
 public:
  explicit StateCompressor(pdu::CompressedForm form) noexcept : form_(form) {}

  /// A written update.
  struct Made {
    std::size_t size = 0;  ///< octets as written by pdu::store_compressed(); 0: send it plain
    bool is_key = false;   ///< key state: it may neither wait nor be replaced by one that needs it
    bool needs_key = false;  ///< a receiver without the key state cannot read it
  };
  static constexpr std::size_t kRoom = pdu::kCompressedHeadSize + pdu::kMostCompressedBody;

  /// @param state with its motion rounded by pdu::quantise().
  /// @param plain sends it plain, as a key state, for a newcomer
  [[nodiscard]] Made compress(const pdu::EntityState& state, aoim::GroupIndex group, bool plain,
                              std::chrono::nanoseconds now,
                              std::span<std::byte, kRoom> out) noexcept;

  /// The same for the listeners of a tier's group other than the cell's group, in the compact form,
  /// which depends on no key state. Returns its octets. Returns 0 if the state has parts, and in
  /// the residual form, because only the cell's group gets its key states: then all receive the
  /// whole state.
  [[nodiscard]] std::size_t compress_independent(const pdu::EntityState& state,
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
  unsigned since_ = 0, gap_ = 0;  // updates since the last key state, and until the next
  deadreckon::ResidualEncoder residual_;
};

}  // namespace reckon::peer
