// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/lead_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace reckon::fuzz::leaders {
namespace {

using std::chrono::milliseconds;

// A leader that is silent for so long has been followed by another one.
constexpr nanoseconds kPatience = milliseconds(1500);
// Later a sleeper may have heard a leader, or been named by one that leaves.
constexpr nanoseconds kHears = milliseconds(500), kWakes = milliseconds(10);

}  // namespace

LeadWatch::Sentence LeadWatch::newcomers_stay_behind(const std::vector<Place>& places,
                                                     nanoseconds now) {
  std::map<Key, Seen> seen;
  Sentence fault;
  for (const Place& place : places) {
    if (!place.host) continue;
    const std::uint32_t own = place.host->epoch();
    for (const aoim::CellId cell : cells_of(*place.host)) {
      const std::uint32_t leader = place.host->role().leader(cell);
      const auto before = seen_.find({cell, own});
      if (leader == 0 && before == seen_.end()) continue;
      Seen& mine = seen[{cell, own}];
      const Seen found{place.host->first_leader(cell), leader, now, now};
      mine = before != seen_.end() ? before->second : found;
      if (mine.last == leader) continue;
      const bool led = std::exchange(mine.last, leader) == own;
      const nanoseconds since = std::exchange(mine.since, now);
      const auto rival = seen_.find({cell, leader});
      const bool gave_way = led && now - place.awake > kHears && rival != seen_.end();
      if (gave_way && rival->second.first == own && rival->second.first_at >= since) {
        fault = fmt::format("{:x} gave {} up to {:x}, which had come behind it", own, name(cell),
                            leader);
      }
    }
  }
  seen_ = std::move(seen);
  return fault;
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
