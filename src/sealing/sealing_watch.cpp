// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/sealing_watch.hpp"

#include <fmt/format.h>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;
using Kind = SealingNews::Kind;

constexpr nanoseconds kSecond = std::chrono::seconds(1);
constexpr nanoseconds kLasts = std::chrono::seconds(3);
constexpr nanoseconds kAgain = std::chrono::seconds(60);
constexpr std::uint64_t kManyForged = 100;

}  // namespace

std::string SealingNews::text() const {
  switch (kind) {
    case Kind::forged:
      return fmt::format("{} datagrams with a wrong tag in one second, the last from {}: refused",
                         count, source.text());
    case Kind::other_key:
      return fmt::format(
          "datagrams from {} are sealed with another key: compare the key files (reckon key show)",
          source.text());
    case Kind::unknown_epoch:
      return fmt::format(
          "datagrams from {} have epoch {}, which the key file lacks: copy its newest version",
          source.text(), epoch);
    case Kind::plain:
      return fmt::format("datagrams from {} are not sealed: refused", source.text());
    case Kind::unanswered:
      break;
  }
  return fmt::format(
      "{}:{} at {} does not answer and is not shown: it is a replay, or it does not receive us",
      sealer.site, sealer.application, source.text());
}

bool SealingWatch::Lasting::turn(nanoseconds now, nanoseconds span) noexcept {
  if (first < nanoseconds(0)) first = now;
  if (now - first < span || (reported >= nanoseconds(0) && now - reported < kAgain)) return false;
  reported = now;
  return true;
}

void SealingWatch::tell(Kind kind, const OpenedDatagram& opened, const IpEndpoint& from) noexcept {
  static_cast<void>(news_.push({kind, from, 0, opened.header.epoch, opened.header.sealer}));
}

void SealingWatch::look(const OpenedDatagram& opened, const IpEndpoint& from,
                        nanoseconds now) noexcept {
  switch (opened.verdict) {
    case SealedVerdict::opened:
      has_opened_ = has_opened_ || opened.sender->trusted;
      if (!opened.sender->trusted && now - opened.sender->since >= kLasts &&
          unanswered_.turn(now, nanoseconds(0)))
        tell(Kind::unanswered, opened, from);
      return;
    case SealedVerdict::forged:
      return look_at_forged(opened, from, now);
    case SealedVerdict::other_suite:
      if (other_key_.turn(now, kLasts)) tell(Kind::other_key, opened, from);
      return;
    case SealedVerdict::unknown_epoch:
      if (unknown_epoch_.turn(now, kLasts)) tell(Kind::unknown_epoch, opened, from);
      return;
    case SealedVerdict::plain:
      if (plain_.turn(now, nanoseconds(0))) tell(Kind::plain, opened, from);
      return;
    default:
      return;
  }
}

void SealingWatch::look_at_forged(const OpenedDatagram& opened, const IpEndpoint& from,
                                  nanoseconds now) noexcept {
  ++forged_in_second_;
  forger_ = from;
  if (!has_opened_ && other_key_.turn(now, kLasts)) tell(Kind::other_key, opened, from);
  tick(now);
}

void SealingWatch::tick(nanoseconds now) noexcept {
  if (now - second_ < kSecond) return;
  if (forged_in_second_ > kManyForged)
    static_cast<void>(news_.push({Kind::forged, forger_, forged_in_second_, 0, {}}));
  forged_in_second_ = 0;
  second_ = now;
}

}  // namespace reckon::peer
