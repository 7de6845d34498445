// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/reliable/received_set.hpp"

#include <algorithm>
#include <utility>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;
using Words = std::array<std::uint64_t, ReceivedSet::kWindow / 64>;

void set_bit(Words& map, std::uint32_t bit) noexcept {
  map[bit / 64] |= std::uint64_t{1} << (bit % 64);
}

bool has_bit(const Words& map, std::uint32_t bit) noexcept {
  return (map[bit / 64] >> (bit % 64) & 1) != 0;
}

// The window moves on by `count` sequences, at most its length.
void shift(Words& map, std::uint32_t count) noexcept {
  const std::uint32_t words = count / 64, bits = count % 64;
  for (std::size_t to = map.size(); to-- > 0;) {
    const std::uint64_t low = to >= words ? map[to - words] : 0;
    const std::uint64_t lower = to >= words + 1 ? map[to - words - 1] : 0;
    map[to] = bits == 0 ? low : low << bits | lower >> (64 - bits);
  }
}

void copy_octets(const Words& map, std::array<std::uint8_t, 32>& octets) noexcept {
  for (std::size_t k = 0; k < octets.size(); ++k)
    octets[k] = static_cast<std::uint8_t>(map[k / 8] >> (8 * (k % 8)));
}

bool is_near(std::uint32_t a, std::uint32_t b) noexcept {
  return a - b <= ReceivedSet::kWindow || b - a <= ReceivedSet::kWindow;
}

}  // namespace

ReceivedSet::ReceivedSet(std::size_t senders) : places_(senders) {
  senders_.reserve(senders);
  owing_.reserve(senders);
}

ReceivedSet::Sender* ReceivedSet::find(std::uint32_t epoch) noexcept {
  const std::uint32_t place = places_.find(epoch);
  return place == aoim::EpochIndex::kNone ? nullptr : &senders_[place];
}

ReceivedSet::Sender* ReceivedSet::find_or_add(std::uint32_t epoch, std::uint32_t sequence,
                                              nanoseconds now) noexcept {
  if (Sender* known = find(epoch)) return known;
  if (senders_.size() == senders_.capacity()) return nullptr;
  places_.put(epoch, senders_.size());
  Sender& sender = senders_.emplace_back();
  sender.epoch = epoch;
  sender.highest = sequence;
  sender.last = now;
  return &sender;
}

// Moves the window so that it holds the sequence, if that is allowed.
bool ReceivedSet::reach(Sender& sender, std::uint32_t sequence, nanoseconds now) noexcept {
  const auto ahead = static_cast<std::int32_t>(sequence - sender.highest);
  if (ahead <= -static_cast<std::int32_t>(kWindow)) return false;
  if (ahead > static_cast<std::int32_t>(kWindow)) {
    const bool agrees = sender.has_far && is_near(sequence, sender.far);
    sender.has_far = true;
    sender.far = sequence;
    if (!agrees || now - sender.last < kIdle) return false;
    sender.received = sender.refused = sender.for_others = {};
    sender.highest = sequence;
  } else if (ahead > 0) {
    shift(sender.received, static_cast<std::uint32_t>(ahead));
    shift(sender.refused, static_cast<std::uint32_t>(ahead));
    shift(sender.for_others, static_cast<std::uint32_t>(ahead));
    sender.highest = sequence;
  }
  sender.has_far = false;
  sender.last = now;
  return true;
}

AssuredNovelty ReceivedSet::take(std::uint32_t epoch, std::uint32_t sequence,
                                 nanoseconds now) noexcept {
  Sender* sender = find_or_add(epoch, sequence, now);
  if (sender == nullptr || !reach(*sender, sequence, now)) return AssuredNovelty::refused;
  const std::uint32_t back = sender->highest - sequence;
  if (has_bit(sender->received, back)) return AssuredNovelty::duplicate;
  set_bit(sender->received, back);
  return AssuredNovelty::fresh;
}

void ReceivedSet::follow(std::uint32_t epoch, std::uint32_t sequence, nanoseconds now) noexcept {
  Sender* sender = find_or_add(epoch, sequence, now);
  if (sender == nullptr || !reach(*sender, sequence, now)) return;
  set_bit(sender->for_others, sender->highest - sequence);
}

bool ReceivedSet::has_later(std::uint32_t epoch, std::uint32_t sequence) const noexcept {
  const std::uint32_t place = places_.find(epoch);
  return place != aoim::EpochIndex::kNone &&
         static_cast<std::int32_t>(senders_[place].highest - sequence) > 0;
}

bool ReceivedSet::needs_no_wait(std::uint32_t epoch, std::uint32_t sequence) const noexcept {
  const std::uint32_t place = places_.find(epoch);
  if (place == aoim::EpochIndex::kNone) return false;
  const Sender& sender = senders_[place];
  const auto back = static_cast<std::int32_t>(sender.highest - sequence);
  if (back < 0) return false;
  const auto bit = static_cast<std::uint32_t>(back);
  return bit >= kWindow || has_bit(sender.received, bit) || has_bit(sender.for_others, bit);
}

void ReceivedSet::refuse(std::uint32_t epoch, std::uint32_t sequence) noexcept {
  Sender* sender = find(epoch);
  if (sender == nullptr) return;
  const std::uint32_t back = sender->highest - sequence;
  if (back < kWindow && has_bit(sender->received, back)) set_bit(sender->refused, back);
}

void ReceivedSet::owe(std::uint32_t epoch, bool by_host) noexcept {
  Sender* sender = find(epoch);
  if (sender == nullptr) return;
  sender->by_host = sender->by_host || by_host;
  if (!std::exchange(sender->owes, true)) owing_.push_back(epoch);
}

bool ReceivedSet::take_receipt(DueReceipt& due) noexcept {
  while (!owing_.empty()) {
    Sender* sender = find(owing_.back());
    owing_.pop_back();
    if (sender == nullptr || !sender->owes) continue;
    due.epoch = sender->epoch;
    due.highest = sender->highest;
    due.is_for_host = std::exchange(sender->by_host, false);
    copy_octets(sender->received, due.receipt.received);
    copy_octets(sender->refused, due.receipt.refused);
    sender->owes = false;
    return true;
  }
  return false;
}

void ReceivedSet::drop(std::uint32_t epoch) noexcept {
  const std::uint32_t place = places_.find(epoch);
  if (place == aoim::EpochIndex::kNone) return;
  std::erase(owing_, epoch);
  places_.erase(epoch);
  if (place + 1 < senders_.size()) {
    senders_[place] = senders_.back();
    places_.put(senders_[place].epoch, place);
  }
  senders_.pop_back();
}

}  // namespace reckon::peer
