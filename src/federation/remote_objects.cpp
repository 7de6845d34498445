// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/remote_objects.hpp"

namespace reckon::peer {

const RemoteCopy* RemoteObjects::find(const pdu::EntityId& id) const noexcept {
  const std::uint32_t place = index_.find(id.key());
  return place == KeyIndex::kNone ? nullptr : &rows_[place];
}

bool RemoteObjects::put(const RemoteCopy& copy) {
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

bool RemoteObjects::erase(const pdu::EntityId& id) noexcept {
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

}  // namespace reckon::peer
