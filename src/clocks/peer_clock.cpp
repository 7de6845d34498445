// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/peer_clock.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

// Trailers count whole microseconds: four of them make a round trip wrong by less than this.
constexpr nanoseconds kResolution = microseconds(4);
// Tolerance for least transits below zero: a drift that has just changed.
constexpr nanoseconds kSlack = std::chrono::milliseconds(20);
// Half of the time for which a datagram may wait for the loops at its ends: four passes of the
// model loop.
constexpr nanoseconds kLoopWait = std::chrono::milliseconds(4);
// Greatest age of the datagram in an echo, and longest delay of the echo.
constexpr nanoseconds kOldest = std::chrono::seconds(30);

// Signed time between two counts of microseconds modulo 2^32.
nanoseconds between(std::uint32_t from, std::uint32_t to) noexcept {
  return microseconds(static_cast<std::int32_t>(to - from));
}

}  // namespace

// ------------------------------------------------------------------------------------- one peer

void PeerClock::receive(std::uint32_t sent, nanoseconds utc, nanoseconds now) noexcept {
  note(from_it_, watch_from_, pdu::trailer_age(sent, utc), now);
}

bool PeerClock::take(const pdu::TimeEcho& echo, std::uint32_t answered, nanoseconds utc,
                     nanoseconds now) noexcept {
  const nanoseconds since = pdu::trailer_age(echo.sent, utc);
  const nanoseconds held = between(echo.heard, answered);
  const nanoseconds round_trip = since - held;
  if (since < nanoseconds(0) || since > kOldest || held < nanoseconds(0) || held > kOldest ||
      round_trip < -kResolution - held / 1000 || round_trip > kMostRoundTrip) {
    return false;
  }
  last_echo_ = now;
  const nanoseconds drifted =
      pdu::from_seconds(to_it_.drift() * pdu::to_seconds(held));  // since it was received
  note(to_it_, watch_to_, between(echo.sent, echo.heard) + drifted, now);
  return true;
}

// After a jump of the clock, both directions are measured again.
void PeerClock::note(LeastTransit& way, LeapWatch& watch, nanoseconds difference,
                     nanoseconds now) noexcept {
  if (!way.is_empty() && std::chrono::abs(difference - way.at(now)) > LeapWatch::kOdd) {
    if (!watch.confirms(difference, now)) return;
    from_it_ = to_it_ = {};
    watch_from_ = watch_to_ = {};
    if (&way == &from_it_) last_echo_.reset();
  } else {
    watch.clear();
  }
  way.note(difference, now);
}

std::optional<ClockDifference> PeerClock::difference(nanoseconds now) const noexcept {
  if (!last_echo_ || now - *last_echo_ > kForgotten) return std::nullopt;
  if (from_it_.is_empty() || to_it_.is_empty()) return std::nullopt;
  const nanoseconds from = from_it_.at(now);  // least transit from it - ahead
  const nanoseconds to = to_it_.at(now);      // least transit to it + ahead
  if (from + to < -kSlack || from + to > kMostRoundTrip) return std::nullopt;
  return ClockDifference{(to - from) / 2, std::max(from + to, nanoseconds(0)),
                         (to_it_.drift() - from_it_.drift()) / 2};
}

// ------------------------------------------------------------------------------------- all peers

PeerClocks::PeerClocks() : places_(kCapacity) {
  epochs_.reserve(kCapacity);
  rows_.reserve(kCapacity);
}

// Place of a peer; epochs_.size() if it is not known.
std::size_t PeerClocks::find(std::uint32_t epoch) const noexcept {
  const std::uint32_t place = places_.find(epoch);
  return place == aoim::EpochIndex::kNone ? epochs_.size() : place;
}

std::size_t PeerClocks::find_or_add(std::uint32_t epoch) noexcept {
  std::size_t place = find(epoch);
  if (place < epochs_.size()) return place;
  if (epochs_.size() < kCapacity) {
    epochs_.push_back(epoch);
    rows_.emplace_back();
    places_.put(epoch, place);
    return place;
  }
  const auto oldest = std::min_element(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) {
    return a.last_heard < b.last_heard;
  });
  *oldest = {};
  place = static_cast<std::size_t>(oldest - rows_.begin());
  places_.erase(epochs_[place]);
  places_.put(epoch, place);
  epochs_[place] = epoch;
  return place;
}

void PeerClocks::receive(const pdu::DatagramTrailer& trailer, nanoseconds utc,
                         nanoseconds now) noexcept {
  Row& row = rows_[find_or_add(trailer.epoch)];
  row.clock.receive(trailer.send_time, utc, now);
  row.sent = trailer.send_time;
  row.heard = pdu::trailer_time(utc);
  row.last_heard = now;
  row.aligned = pdu::is_absolute(trailer.header.timestamp);
}

void PeerClocks::take(const pdu::TimeExchange& exchange, std::uint32_t own,
                      const pdu::DatagramTrailer& trailer, nanoseconds utc,
                      nanoseconds now) noexcept {
  const std::size_t place = find(trailer.epoch);
  if (place == epochs_.size() || exchange.epoch != trailer.epoch) return;
  for (const pdu::TimeEcho& echo : pdu::records_of<pdu::TimeEcho>(exchange.echoes)) {
    if (echo.epoch != own) continue;
    const bool good = rows_[place].clock.take(echo, trailer.send_time, utc, now);
    ++(good ? taken_ : refused_);
    return;  // one echo each
  }
}

bool PeerClocks::fill(pdu::TimeExchange& exchange, nanoseconds now) noexcept {
  constexpr std::size_t kRound = 32;  // [PDUs]
  constexpr std::size_t kEcho = pdu::kFixedSize<pdu::TimeEcho>;
  const std::size_t most =
      std::clamp((rows_.size() + kRound - 1) / kRound, kEchoes, kMostEchoes) * kEcho;
  std::size_t size = 0;
  for (std::size_t i = 0; i < rows_.size() && size < most; ++i) {
    turn_ = (turn_ + 1) % rows_.size();
    const Row& row = rows_[turn_];
    if (now - row.last_heard > kRecent) continue;
    size += pdu::store_record(pdu::TimeEcho{epochs_[turn_], row.sent, row.heard},
                              std::span(echoes_).subspan(size));
  }
  exchange.echoes = std::span(echoes_).first(size);
  return size > 0;
}

std::optional<ClockDifference> PeerClocks::difference(std::uint32_t epoch,
                                                      nanoseconds now) const noexcept {
  const std::size_t place = find(epoch);
  if (place == epochs_.size()) return std::nullopt;
  return rows_[place].clock.difference(now);
}

std::optional<nanoseconds> PeerClocks::ahead(std::uint32_t epoch, bool aligned,
                                             nanoseconds now) const noexcept {
  const std::size_t place = find(epoch);
  if (place == epochs_.size()) return std::nullopt;
  const auto known = rows_[place].clock.difference(now);
  if (!known) return std::nullopt;
  // With equal clocks the transits are round_trip / 2 -+ ahead. Short transits consist mainly of
  // the waiting times for the loops at both ends, which may be unequal in any way.
  const nanoseconds lopsided =
      std::max(known->round_trip / 4, std::min(known->round_trip / 2, kLoopWait));
  const bool plausible = std::chrono::abs(known->ahead) <= lopsided + kResolution;
  return aligned && rows_[place].aligned && plausible ? nanoseconds(0) : known->ahead;
}

}  // namespace reckon::peer
