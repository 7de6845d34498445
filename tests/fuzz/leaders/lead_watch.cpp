// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/lead_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace reckon::fuzz::leaders {
namespace {

using std::chrono::milliseconds;

// After this silence another leader has succeeded.
constexpr nanoseconds kPatience = milliseconds(1500);
// After kHears a host that slept may have received a leader's claim, or been named by a departing
// one.
constexpr nanoseconds kHears = milliseconds(500), kWakes = milliseconds(10);

}  // namespace

void LeadWatch::note(const Place& place, nanoseconds now) {
  const aoim::CellLeadership& leadership = place.host->role().leadership();
  for (auto& [cell, stay] : stays_[place.host->epoch()]) {
    stay.lasts = stay.lasts && leadership.is_member(cell);
  }
  leadership.for_each_cell(
      [&](aoim::CellId cell, std::uint32_t leader) { note(place, cell, leader, now); });
}

void LeadWatch::note(const Place& place, aoim::CellId cell, std::uint32_t leader, nanoseconds now) {
  const Life own = place.host->epoch();
  Stay& stay = stays_[own][cell];
  if (!stay.lasts) stay = {};
  if (stay.last == leader) return;
  if (stay.first == 0) {
    stay.first = leader;
    stay.first_at = now;
  }
  const bool led = std::exchange(stay.last, leader) == own;
  const nanoseconds since = std::exchange(stay.since, now);
  if (!led || leader == 0 || now - place.awake <= kHears) return;
  const auto& rivals = stays_[leader];
  const auto rival = rivals.find(cell);
  const bool behind =
      rival != rivals.end() && rival->second.first == own && rival->second.first_at >= since;
  if (behind && !unseated_) {
    unseated_ =
        fmt::format("{:x} gave {} up to {:x}, which had come behind it", own, name(cell), leader);
  }
}

LeadWatch::Sentence LeadWatch::sleepers_ask(const std::vector<Place>& places, nanoseconds now) {
  for (const Place& place : places) {
    const bool woke = place.host && now >= place.awake && now < place.awake + kWakes &&
                      place.awake - place.asleep > kPatience + milliseconds(100);
    if (!woke) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) {
      if (!place.host->role().leads(cell)) continue;
      const bool beside = std::any_of(places.begin(), places.end(), [&](const Place& other) {
        return other.host && &other != &place && now > other.awake + kHears &&
               other.host->role().leads(cell);
      });
      if (beside)
        return fmt::format("{:x} goes on leading {} after it slept", place.host->epoch(),
                           name(cell));
    }
  }
  return {};
}

LeadWatch::Sentence LeadWatch::never_two(const std::vector<Place>& places) {
  std::map<aoim::CellId, std::uint32_t> leaders;
  for (const Place& place : places) {
    if (!place.host) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) {
      if (!place.host->role().leads(cell)) continue;
      const auto [other, is_only] = leaders.try_emplace(cell, place.host->epoch());
      if (!is_only)
        return fmt::format("{:x} and {:x} lead {}", other->second, place.host->epoch(), name(cell));
    }
  }
  return {};
}

LeadWatch::Sentence LeadWatch::members_counted(const std::vector<Place>& places) {
  std::map<aoim::CellId, std::size_t> inside;
  for (const Place& place : places) {
    if (!place.host) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) ++inside[cell];
  }
  const auto before = std::exchange(inside_, inside);
  for (const Place& place : places) {
    if (!place.host) continue;
    for (const auto& [cell, here] : inside) {
      const auto earlier = before.find(cell);
      const std::size_t most = std::max(here, earlier == before.end() ? 0 : earlier->second) - 1;
      const std::size_t counted = place.host->role().leadership().members(cell);
      if (counted > most)
        return fmt::format("{:x} counts {} others in {}, in which {} are", place.host->epoch(),
                           counted, name(cell), most);
    }
  }
  return {};
}

}  // namespace reckon::fuzz::leaders
