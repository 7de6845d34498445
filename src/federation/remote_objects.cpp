// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/remote_objects.hpp"

namespace reckon::peer {
namespace {

std::uint64_t key(const pdu::EntityId& id) noexcept {
  return (std::uint64_t{id.site} << 32) | (std::uint64_t{id.application} << 16) | id.entity;
}

}  // namespace

const RemoteCopy* RemoteObjects::find(const pdu::EntityId& id) const noexcept {
  const std::uint32_t place = index_.find(key(id));
  return place == KeyIndex::kNone ? nullptr : &rows_[place];
}

bool RemoteObjects::put(const RemoteCopy& copy) {
  const std::uint64_t id = key(copy.entity().id);
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
  const std::uint32_t place = index_.find(key(id));
  if (place == KeyIndex::kNone) return false;
  index_.erase(key(id));
  if (place + 1 < rows_.size()) {
    rows_[place] = rows_.back();
    index_.put(key(rows_[place].entity().id), place);
  }
  rows_.pop_back();
  return true;
}

}  // namespace reckon::peer
