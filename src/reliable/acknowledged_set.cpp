// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/reliable/acknowledged_set.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kWordBits = 64;

bool has_bit(const std::array<std::uint8_t, 32>& map, std::uint32_t bit) noexcept {
  return (map[bit / 8] >> (bit % 8) & 1) != 0;
}

}  // namespace

AcknowledgedSet::AcknowledgedSet(std::size_t peers, std::uint32_t first)
    : octets_(std::make_unique_for_overwrite<std::byte[]>(kMostInFlight * pdu::kMostAssured)),
      addressees_(peers),
      places_(peers),
      words_((peers + kWordBits - 1) / kWordBits),
      next_(first) {
  missing_.resize(kMostInFlight * words_);
  missers_.reserve(peers);
  free_.reserve(peers);
  for (std::size_t place = peers; place > 0; --place)
    free_.push_back(static_cast<std::uint32_t>(place - 1));
}

nanoseconds AcknowledgedSet::time_of(std::uint32_t repeat) noexcept {
  if (repeat < kRepeats.size()) return kRepeats[repeat];
  return kRepeats.back() + (repeat + 1 - kRepeats.size()) * kLateRepeat;
}

std::span<std::uint64_t> AcknowledgedSet::missing_of(const Record& record) noexcept {
  return std::span(missing_).subspan((record.sequence % kMostInFlight) * words_, words_);
}

bool AcknowledgedSet::is_missing(const Record& record, std::size_t place) noexcept {
  return (missing_of(record)[place / kWordBits] >> (place % kWordBits) & 1) != 0;
}

// Calls visit for each record in flight, oldest first. All are within kMostInFlight of the next.
void AcknowledgedSet::for_each_in_flight(auto&& visit) noexcept {
  if (in_flight_ == 0) return;
  for (std::uint32_t back = kMostInFlight; back > 0; --back) {
    Record& record = at(next_ - back);
    if (record.missing > 0) visit(record);
  }
}

// The place of this addressee; a new one for a new addressee, for which there must be room.
std::size_t AcknowledgedSet::place_of(std::uint32_t peer) noexcept {
  const std::uint32_t known = places_.find(peer);
  if (known != aoim::EpochIndex::kNone) return known;
  const std::uint32_t place = free_.back();
  free_.pop_back();
  addressees_[place] = {peer, 0};
  places_.put(peer, place);
  return place;
}

bool AcknowledgedSet::has_places_for(std::span<const std::uint32_t> addressees) const noexcept {
  const auto added = std::ranges::count_if(addressees, [this](std::uint32_t peer) {
    return places_.find(peer) == aoim::EpochIndex::kNone;
  });
  return !addressees.empty() && static_cast<std::size_t>(added) <= free_.size();
}

std::optional<std::uint32_t> AcknowledgedSet::add(const AssuredContent& content,
                                                  std::span<const std::uint32_t> addressees,
                                                  nanoseconds now) noexcept {
  Record& record = at(next_);
  const std::size_t size = content.octets.size();
  const bool fits = record.missing == 0 && size <= pdu::kMostAssured;
  if (!fits || !has_places_for(addressees)) return std::nullopt;
  record = {next_,       content.kind, content.flags, static_cast<std::uint16_t>(size), 0, 0,
            content.tag, now};
  const std::span<std::uint64_t> missing = missing_of(record);
  std::ranges::fill(missing, 0);
  for (const std::uint32_t peer : addressees) {
    const std::size_t place = place_of(peer);
    missing[place / kWordBits] |= std::uint64_t{1} << (place % kWordBits);
    ++addressees_[place].records;
    ++record.missing;
  }
  if (size > 0)
    std::memcpy(octets_.get() + (next_ % kMostInFlight) * pdu::kMostAssured, content.octets.data(),
                size);
  ++in_flight_;
  return next_++;
}

// The record is done for this addressee.
void AcknowledgedSet::settle(Record& record, std::size_t place, AssuredOutcome outcome,
                             AssuredReports& reports) noexcept {
  missing_of(record)[place / kWordBits] &= ~(std::uint64_t{1} << (place % kWordBits));
  Addressee& addressee = addressees_[place];
  const std::uint32_t peer = addressee.epoch;
  if (--addressee.records == 0) {
    places_.erase(peer);
    free_.push_back(static_cast<std::uint32_t>(place));
  }
  const bool is_last = --record.missing == 0;
  if (is_last) --in_flight_;
  reports.settle({record.sequence, record.kind, record.tag, peer, outcome, is_last});
}

void AcknowledgedSet::settle_all(Record& record, AssuredOutcome outcome,
                                 AssuredReports& reports) noexcept {
  const std::span<const std::uint64_t> missing = missing_of(record);
  for (std::size_t word = 0; word < words_; ++word) {
    for (std::uint64_t bits = missing[word]; bits != 0; bits &= bits - 1)
      settle(record, word * kWordBits + static_cast<std::size_t>(std::countr_zero(bits)), outcome,
             reports);
  }
}

void AcknowledgedSet::acknowledge(std::uint32_t peer, std::uint32_t highest,
                                  const pdu::AssuredReceipt& receipt,
                                  AssuredReports& reports) noexcept {
  const std::uint32_t place = places_.find(peer);
  const bool is_sent = static_cast<std::int32_t>(highest - next_) < 0;
  if (place == aoim::EpochIndex::kNone || !is_sent) return;
  for_each_in_flight([&](Record& record) {
    const std::uint32_t back = highest - record.sequence;
    if (back >= kMostInFlight || !has_bit(receipt.received, back) || !is_missing(record, place))
      return;
    const bool refused = has_bit(receipt.refused, back);
    settle(record, place, refused ? AssuredOutcome::refused : AssuredOutcome::accepted, reports);
  });
}

void AcknowledgedSet::drop(std::uint32_t peer, AssuredReports& reports) noexcept {
  const std::uint32_t place = places_.find(peer);
  if (place == aoim::EpochIndex::kNone) return;
  for_each_in_flight([&](Record& record) {
    if (is_missing(record, place)) settle(record, place, AssuredOutcome::left, reports);
  });
}

void AcknowledgedSet::give_up(nanoseconds now, AssuredReports& reports) noexcept {
  for_each_in_flight([&](Record& record) {
    if (now - record.begun >= kGiveUp) settle_all(record, AssuredOutcome::gave_up, reports);
  });
}

// Distance to the nearest earlier ordered record that an addressee of this one lacks as well; 0 if
// there is none. It is the same for all addressees. One that has taken the earlier record, or has
// seen that it is for others, does not wait.
std::uint16_t AcknowledgedSet::predecessor_distance_of(const Record& record) noexcept {
  if ((record.flags & pdu::kAssuredOrdered) == 0) return 0;
  const std::span<const std::uint64_t> missing = missing_of(record);
  for (std::uint16_t back = 1; back < kMostInFlight; ++back) {
    const Record& earlier = at(record.sequence - back);
    const bool is_due = earlier.missing > 0 && earlier.sequence == record.sequence - back &&
                        (earlier.flags & pdu::kAssuredOrdered) != 0;
    if (!is_due) continue;
    const std::span<const std::uint64_t> lacking = missing_of(earlier);
    for (std::size_t word = 0; word < words_; ++word)
      if ((missing[word] & lacking[word]) != 0) return back;
  }
  return 0;
}

// A late call sends once for all transmissions that it missed.
bool AcknowledgedSet::take_due(nanoseconds now, DueRecord& due) noexcept {
  Record* found = nullptr;
  for_each_in_flight([&](Record& record) {
    if (found == nullptr && now - record.begun >= time_of(record.repeat)) found = &record;
  });
  if (found == nullptr) return false;
  const nanoseconds age = now - found->begun;
  const std::size_t begin = (found->sequence % kMostInFlight) * pdu::kMostAssured;
  due.sequence = found->sequence;
  due.content = {found->kind, found->flags, {octets_.get() + begin, found->size}, found->tag};
  due.is_first = found->repeat == 0;
  due.is_for_hosts = age >= kToHosts;
  while (time_of(found->repeat) <= age) ++found->repeat;
  missers_.clear();
  const std::span<const std::uint64_t> missing = missing_of(*found);
  for (std::size_t word = 0; word < words_; ++word) {
    for (std::uint64_t bits = missing[word]; bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(bits));
      missers_.push_back(addressees_[word * kWordBits + bit].epoch);
    }
  }
  due.missing = missers_;
  due.predecessor_distance = predecessor_distance_of(*found);
  return true;
}

nanoseconds AcknowledgedSet::next_step() const noexcept {
  nanoseconds next = nanoseconds::max();
  if (in_flight_ == 0) return next;
  for (const Record& record : records_) {
    if (record.missing == 0) continue;
    const nanoseconds wait = std::min<nanoseconds>(time_of(record.repeat), kGiveUp);
    next = std::min(next, record.begun + wait);
  }
  return next;
}

}  // namespace reckon::peer
