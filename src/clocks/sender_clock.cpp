// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/sender_clock.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

std::optional<nanoseconds> SenderClock::local_time(std::uint32_t timestamp, nanoseconds now,
                                                   nanoseconds utc_now,
                                                   const ClockEvidence& evidence) noexcept {
  if (started_ && now < last_heard_) {
    utc_now += last_heard_ - now;
    now = last_heard_;
  }
  leapt_ = false;
  if (started_ && timestamp == last_timestamp_) return by_arrival(now);
  nanoseconds sent = started_ ? unwrapped(timestamp, now) : now;
  if (is_odd(sent, now)) {
    const bool ahead = now - sent < transit_.at(now);
    const bool confirmed = watch_.confirms(now - sent, now, ahead);
    if (!confirmed && !(ahead && now < runs_ahead_until_)) return std::nullopt;
    // Its fastest packet since then is assumed to be as fast as the fastest one before.
    sent += watch_.least() - transit_.at(now);
    leapt_ = true;
    if (ahead) runs_ahead_until_ = now + kRunsAhead;
  }
  watch_.clear();

  transit_.note(now - sent, now);
  const nanoseconds least = transit_.at(now);
  learn_transit(timestamp, now - sent, least, utc_now, evidence);
  follow(least - base_, now);
  last_mapped_ = std::clamp(sent + offset_, started_ ? last_mapped_ : nanoseconds::min(), now);
  started_ = true;
  last_timestamp_ = timestamp;
  last_sent_ = sent;
  last_heard_ = last_taken_ = now;
  return last_mapped_;
}

// A stopped clock gives no times, but its state is newer than the last.
nanoseconds SenderClock::by_arrival(nanoseconds now) noexcept {
  last_mapped_ = std::min(last_mapped_ + std::max(now - last_taken_, nanoseconds(0)), now);
  last_taken_ = std::max(last_taken_, now);
  return last_mapped_;
}

// Of all instants with this timestamp, which are an hour apart, the one that fits the preceding
// silence.
nanoseconds SenderClock::unwrapped(std::uint32_t timestamp, nanoseconds now) const noexcept {
  const nanoseconds passed = pdu::difference(timestamp, last_timestamp_);
  const nanoseconds rest = now - last_heard_ - passed;
  if (std::chrono::abs(rest) < std::chrono::minutes(30)) return last_sent_ + passed;
  return last_sent_ + passed + std::chrono::hours(pdu::rounded(pdu::to_seconds(rest) / 3600.0));
}

bool SenderClock::is_odd(nanoseconds sent, nanoseconds now) const noexcept {
  if (!started_) return false;
  // During a long silence clocks drift apart, by less than 1 ms/s.
  const nanoseconds allowed = LeapWatch::kOdd + (now - last_heard_) / 1000;
  return sent <= last_sent_ || std::chrono::abs(now - sent - transit_.at(now)) > allowed;
}

void SenderClock::learn_transit(std::uint32_t timestamp, nanoseconds difference, nanoseconds least,
                                nanoseconds utc_now, const ClockEvidence& evidence) noexcept {
  const bool at_its_word = evidence.aligned && pdu::is_absolute(timestamp);
  if (!evidence.ahead && !at_its_word) return;
  const nanoseconds its_utc = utc_now + evidence.ahead.value_or(nanoseconds(0));
  const nanoseconds age = its_utc - pdu::nearest_instant(timestamp, its_utc);
  const nanoseconds fastest = age - (difference - least);
  const nanoseconds most = evidence.ahead ? kMostMeasuredTransit : kMostTransit;
  if (fastest < -kMostAhead || fastest > most) return;
  base_ = std::max(fastest, nanoseconds(0));
}

void SenderClock::follow(nanoseconds estimate, nanoseconds now) noexcept {
  if (!started_) first_heard_ = now;
  if (now - first_heard_ < kYoung) {
    offset_ = estimate;
    return;
  }
  const nanoseconds elapsed = std::min<nanoseconds>(now - last_heard_, std::chrono::seconds(1));
  const nanoseconds error = estimate - offset_;
  const nanoseconds slow =
      elapsed / 1000 + pdu::from_seconds(pdu::to_seconds(std::chrono::abs(error)) *
                                         pdu::to_seconds(elapsed) / pdu::to_seconds(kTimeConstant));
  const nanoseconds most = std::min(slow, elapsed / 10);
  offset_ += std::clamp(error, -most, most);
}

}  // namespace reckon::peer
