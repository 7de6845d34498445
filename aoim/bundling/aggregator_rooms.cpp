// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The memory of the aggregator's pending updates.
#include <algorithm>

#include "reckon/aoim/bundling/aggregator.hpp"

namespace reckon::aoim {
namespace {

constexpr std::size_t kReservedOctets = 16 * 1024;
constexpr std::size_t kReservedItems = 128;
constexpr std::size_t kReadyRooms = 4;

}  // namespace

void Aggregator::reserve_rooms() {
  rooms_.reserve(lanes_.size());
  for (std::size_t i = 0; i < std::min(kReadyRooms, lanes_.size()); ++i)
    rooms_.push_back(usual_room());
  scratch_.reserve(kReservedOctets);
  merged_.reserve(kReservedOctets);
  compacted_.reserve(kReservedOctets);
}

Aggregator::Room Aggregator::usual_room() {
  Room room;
  room.octets.reserve(kReservedOctets);
  room.items.reserve(kReservedItems);
  return room;
}

// Takes the memory given back last, which is still in the caches.
void Aggregator::take_room(Lane& lane) {
  if (rooms_.empty()) rooms_.push_back(usual_room());
  static_cast<Room&>(lane) = std::move(rooms_.back());
  rooms_.pop_back();
}

// Does not give back grown memory: in time each group would have memory of the largest size.
void Aggregator::give_room_back(Lane& lane) {
  if (lane.octets.capacity() > kReservedOctets || lane.items.capacity() > kReservedItems) return;
  rooms_.push_back(std::move(static_cast<Room&>(lane)));
}

// Updates that have grown leave unused octets until the queue is packed, which happens before it
// doubles.
bool Aggregator::make_room(Lane& lane, std::size_t octets) {
  const std::size_t usual = std::max(kReservedOctets, 2 * lane.size);
  const std::size_t wanted = lane.octets.size() + octets;
  if (wanted > std::min(usual + octets, config_.waiting_limit)) compact(lane);
  return lane.octets.size() + octets <= config_.waiting_limit;
}

// Drops octets that no item refers to.
void Aggregator::compact(Lane& lane) {
  compacted_.clear();
  for (Item& item : lane.items) {
    const auto bytes =
        std::span(lane.octets)
            .subspan(item.offset, item.pdu_size + item.records_size + item.mark_size);
    item.offset = static_cast<std::uint32_t>(compacted_.size());
    compacted_.insert(compacted_.end(), bytes.begin(), bytes.end());
  }
  lane.octets.assign(compacted_.begin(), compacted_.end());
}

}  // namespace reckon::aoim
