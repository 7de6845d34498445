// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/history/history.hpp"

#include <algorithm>

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

// A segment ends where a scan of it would take some 30 ms,
constexpr std::size_t kMostPdus = 32768;
// and, once the world that the next one keeps is no more than four times as large, after so long.
constexpr nanoseconds kShort = std::chrono::seconds(5), kLong = std::chrono::seconds(30);
constexpr std::size_t kWorldShare = 4;
/// Share of HistoryOptions::octets for one segment.
constexpr std::size_t kOctetShare = 4;

}  // namespace

std::size_t History::Segment::weight() const noexcept {
  return kept + octets.size() + entries.size() * sizeof(Entry);
}

History::History(const HistoryOptions& options)
    : options_(options),
      roster_(std::min<std::size_t>(options.entities, kMostPictureRows)),
      live_(std::min<std::size_t>(options.entities, kMostPictureRows), options.convergence,
            options.tiers),
      inspector_(options.lenient) {}

void History::begin_at(Time time) {
  if (!start_) start_ = end_ = time;
}

bool History::is_long(const Segment& segment, Time at) const noexcept {
  if (segment.pdus >= kMostPdus) return true;
  if (!options_.span) return false;
  if (segment.octets.size() >= options_.octets / kOctetShare) return true;
  const Time age = at - segment.first;
  const bool is_heavy = segment.octets.size() * kWorldShare >= live_.weight();
  return age >= kLong || (age >= kShort && is_heavy);
}

History::Segment& History::segment_for(Time at, std::size_t size) {
  if (segments_.empty() || is_long(*segments_.back(), at)) {
    if (!segments_.empty()) {
      segments_.back()->octets.shrink_to_fit();
      live_.drop_silent(at, options_.span.value_or(std::chrono::minutes(10)));
    }
    Segment& segment = *segments_.emplace_back(std::make_unique<Segment>(live_));
    segment.first = at;
    segment.kept = live_.weight();
    weight_ += segment.weight();
  }
  weight_ += size + sizeof(Entry);
  return *segments_.back();
}

bool History::take(const peer::SourceDatagram& datagram) {
  if (!options_.span && weight_ + datagram.bytes.size() > options_.octets) return false;
  begin_at(datagram.time);
  end_ = std::max(end_, datagram.time);
  Segment& segment = segment_for(end_, datagram.bytes.size());
  segment.entries.push_back({end_, datagram.time, segment.octets.size(), datagram.bytes.size(),
                             datagram.frame, datagram.source, datagram.group, datagram.portion});
  segment.octets.insert(segment.octets.end(), datagram.bytes.begin(), datagram.bytes.end());
  (void)inspector_.inspect(datagram, [&](const PduRow& row) {
    ++segment.pdus;
    if (options_.exercise && row.header.exercise_id != *options_.exercise) return true;
    numbers_.pdu(row, datagram);
    live_.take_pdu(row, datagram, roster_, *start_);
    return true;
  });
  if (!first_entity_ && live_.first_place()) first_entity_ = end_;
  numbers_.datagram(datagram, live_.take_jumps());
  numbers_.pass(end_);
  return true;
}

void History::pass(Time now) {
  numbers_.pass(now);
  if (!options_.span) return;
  end_ = std::max(end_, now);
  forget_old(now);
}

void History::forget_old(Time now) {
  const std::uint64_t before = first_number_;
  const Time oldest = now - *options_.span;
  while (segments_.size() > 1 && (segments_[1]->first <= oldest || weight_ > options_.octets))
    drop_first();
  if (first_number_ == before) return;
  numbers_.forget_before(begin());
  // Forgets entities that no picture can show any more.
  roster_.forget_before(begin() - std::chrono::minutes(2));
}

void History::drop_first() {
  weight_ -= segments_.front()->weight();
  segments_.pop_front();
  ++first_number_;
}

nanoseconds History::begin() const noexcept {
  if (segments_.empty() || first_number_ == 0) return start();
  return segments_.front()->first;
}

const History::Segment* History::segment_at(std::uint64_t number) const noexcept {
  if (number < first_number_ || number - first_number_ >= segments_.size()) return nullptr;
  return segments_[number - first_number_].get();
}

// The last segment that begins at or before `time`, else the first.
std::uint64_t History::number_for(Time time) const noexcept {
  const auto after = std::upper_bound(
      segments_.begin(), segments_.end(), time,
      [](Time at, const std::unique_ptr<Segment>& segment) { return at < segment->first; });
  const auto place = after - segments_.begin();
  return first_number_ + static_cast<std::uint64_t>(place > 0 ? place - 1 : 0);
}

void History::seek(std::unique_ptr<Cursor>& cursor, Time time) {
  time = std::clamp(time, begin(), std::max(begin(), end_));
  if (segments_.empty()) {
    if (!cursor) cursor.reset(new Cursor(live_));
    cursor->time_ = time;
    return;
  }
  const std::uint64_t wanted = number_for(time);
  const bool goes_on = cursor && cursor->segment_ == wanted && cursor->time_ <= time;
  if (!goes_on) {
    const Segment& segment = *segment_at(wanted);
    if (!cursor)
      cursor.reset(new Cursor(segment.world));
    else
      cursor->world_ = segment.world;
    cursor->segment_ = wanted;
    cursor->next_ = 0;
  }
  replay(*cursor, *segment_at(wanted), time);
}

void History::replay(Cursor& cursor, const Segment& segment, Time time) {
  cursor.time_ = time;
  for (; cursor.next_ < segment.entries.size(); ++cursor.next_) {
    const Entry& entry = segment.entries[cursor.next_];
    if (entry.at > time) return;
    peer::SourceDatagram datagram;
    datagram.frame = entry.frame;
    datagram.time = entry.time;
    datagram.source = entry.source;
    datagram.group = entry.group;
    datagram.portion = entry.portion;
    datagram.bytes = std::span(segment.octets).subspan(entry.offset, entry.size);
    (void)inspector_.inspect(datagram, [&](const PduRow& row) {
      if (!options_.exercise || row.header.exercise_id == *options_.exercise)
        cursor.world_.take_pdu(row, datagram, roster_, start());
      return true;
    });
  }
}

std::optional<nanoseconds> History::update_after(Time time) const {
  if (segments_.empty()) return std::nullopt;
  for (std::uint64_t number = number_for(time); const Segment* segment = segment_at(number);
       ++number) {
    const auto& entries = segment->entries;
    const auto after = std::upper_bound(entries.begin(), entries.end(), time,
                                        [](Time at, const Entry& entry) { return at < entry.at; });
    if (after != entries.end()) return after->at;
  }
  return std::nullopt;
}

std::optional<nanoseconds> History::update_before(Time time) const {
  if (segments_.empty()) return std::nullopt;
  for (std::uint64_t number = number_for(time) + 1; number > first_number_; --number) {
    const auto& entries = segment_at(number - 1)->entries;
    const auto at = std::lower_bound(entries.begin(), entries.end(), time,
                                     [](const Entry& entry, Time t) { return entry.at < t; });
    if (at != entries.begin()) return std::prev(at)->at;
  }
  return std::nullopt;
}

}  // namespace reckon::tools
