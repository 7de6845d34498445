// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/reliable/held_records.hpp"

#include <algorithm>
#include <cstring>

namespace reckon::peer {

using std::chrono::nanoseconds;

HeldRecords::HeldRecords()
    : records_(kMost),
      octets_(std::make_unique_for_overwrite<std::byte[]>(kMost * pdu::kMostAssured)) {
  used_.reserve(kMost);
  free_.reserve(kMost);
  for (std::size_t place = kMost; place > 0; --place)
    free_.push_back(static_cast<std::uint16_t>(place - 1));
}

std::size_t HeldRecords::hold(const HeldRecord& record, nanoseconds now) noexcept {
  std::size_t of_sender = 0;
  for (const std::uint16_t place : used_) {
    HeldRecord& held = records_[place].record;
    if (held.epoch != record.epoch) continue;
    ++of_sender;
    if (held.sequence != record.sequence) continue;
    held.predecessor = record.predecessor;
    return place;
  }
  const bool fits = record.octets.size() <= pdu::kMostAssured && !record.octets.empty();
  if (!fits || of_sender >= kMostOfSender || free_.empty()) return kMost;
  const std::uint16_t place = free_.back();
  free_.pop_back();
  used_.push_back(place);
  std::byte* const copy = octets_.get() + place * pdu::kMostAssured;
  std::memcpy(copy, record.octets.data(), record.octets.size());
  records_[place] = {record, now};
  records_[place].record.octets = {copy, record.octets.size()};
  return place;
}

void HeldRecords::release(std::size_t index) noexcept {
  free_.push_back(used_[index]);
  used_[index] = used_.back();
  used_.pop_back();
}

void HeldRecords::release_if(auto&& ends) noexcept {
  for (std::size_t i = used_.size(); i-- > 0;)
    if (ends(records_[used_[i]])) release(i);
}

void HeldRecords::drop(std::uint32_t epoch, std::uint32_t sequence) noexcept {
  release_if([=](const Place& place) {
    return place.record.epoch == epoch && place.record.sequence == sequence;
  });
}

void HeldRecords::drop(std::uint32_t epoch) noexcept {
  release_if([=](const Place& place) { return place.record.epoch == epoch; });
}

void HeldRecords::expire(nanoseconds now) noexcept {
  release_if([=](const Place& place) { return now - place.since >= kLongestHold; });
}

}  // namespace reckon::peer
