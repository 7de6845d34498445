// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Remote entities for a program: a copy of each predictor on the program's own thread, so that it
// can ask for any pose at any instant while the loops run.
#pragma once

#include <span>
#include <vector>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/world/key_index.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// Copies of the remote entities. One thread, the program's; allocates as it grows.
class RemoteObjects {
 public:
  RemoteObjects() : index_(64) {}

  [[nodiscard]] const RemoteCopy* find(const pdu::EntityId& id) const noexcept {
    const std::uint32_t place = index_.find(id.key());
    return place == KeyIndex::kNone ? nullptr : &rows_[place];
  }
  [[nodiscard]] std::span<const RemoteCopy> rows() const noexcept { return rows_; }
  /// Stores a copy; true if the entity is new.
  bool put(const RemoteCopy& copy) {
    const std::uint64_t id = copy.entity().id.key();
    const std::uint32_t place = index_.find(id);
    if (place != KeyIndex::kNone) {
      rows_[place] = copy;
      return false;
    }
    index_.put(id, rows_.size());
    rows_.push_back(copy);
    return true;
  }
  /// Removes an entity; false if it is unknown.
  bool erase(const pdu::EntityId& id) noexcept {
    const std::uint32_t place = index_.find(id.key());
    if (place == KeyIndex::kNone) return false;
    index_.erase(id.key());
    if (place + 1 < rows_.size()) {
      rows_[place] = rows_.back();
      index_.put(rows_[place].entity().id.key(), place);
    }
    rows_.pop_back();
    return true;
  }

 private:
  std::vector<RemoteCopy> rows_;  // dense
  KeyIndex index_;
};

}  // namespace reckon::peer
