// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/peer_table.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::aoim {

PeerTable::PeerTable(std::size_t capacity) : places_(capacity) {
  peers_.reserve(capacity);
  ids_.reserve(capacity);
  epochs_.reserve(capacity);
}

std::size_t PeerTable::find(PeerId id) const noexcept {
  return static_cast<std::size_t>(std::find(ids_.begin(), ids_.end(), id) - ids_.begin());
}

std::optional<std::uint32_t> PeerTable::epoch_of(PeerId id) const noexcept {
  const std::size_t known = find(id);
  if (known == size() || !peers_[known].joined) return {};
  return epochs_[known];
}

std::optional<PeerId> PeerTable::id_of(std::uint32_t epoch) const noexcept {
  const std::size_t known = find_epoch(epoch);
  if (known == size() || !peers_[known].joined) return {};
  return peers_[known].id();
}

std::optional<SourceAddress> PeerTable::source_of(std::uint32_t epoch) const noexcept {
  const std::size_t known = find_epoch(epoch);
  if (known == size()) return {};
  return peers_[known].source;
}

std::chrono::nanoseconds PeerTable::heard_for(std::uint32_t epoch) const noexcept {
  const std::size_t known = find_epoch(epoch);
  if (known == size()) return std::chrono::nanoseconds(0);
  return peers_[known].last_heard - peers_[known].known_since;
}

double PeerTable::stretch_of(std::uint32_t epoch) const noexcept {
  const std::size_t known = find_epoch(epoch);
  if (known == size()) return 1.0;
  return std::exp2((peers_[known].announced.flags >> 8) / 16.0);
}

void PeerTable::append(const Peer& peer) {
  places_.put(peer.announced.epoch, peers_.size());
  peers_.push_back(peer);
  ids_.push_back(peer.id());
  epochs_.push_back(peer.announced.epoch);
}

void PeerTable::replace(std::size_t index, const Peer& peer) {
  places_.erase(epochs_[index]);
  places_.put(peer.announced.epoch, index);
  peers_[index] = peer;
  ids_[index] = peer.id();
  epochs_[index] = peer.announced.epoch;
}

void PeerTable::erase(std::size_t index) noexcept {
  places_.put(epochs_.back(), index);
  places_.erase(epochs_[index]);
  peers_[index] = peers_.back();
  ids_[index] = ids_.back();
  peers_.pop_back();
  ids_.pop_back();
  epochs_.pop_back();
}

}  // namespace reckon::aoim
