// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace reckon::fuzz::leaders {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// In the calm: time until there is one leader, and until groups are given after the quarantine and
// a map.
constexpr nanoseconds kElected = seconds(4), kGiven = milliseconds(10'600);
// Times for a newcomer: to get the map; to lead when it is alone in its cell, after it has
// listened.
constexpr nanoseconds kMapped = milliseconds(700);
// Time for a newcomer to get the rest from the next leader when its leader leaves meanwhile.
constexpr nanoseconds kRetold = milliseconds(300);
constexpr nanoseconds kTold = seconds(1), kAlone = milliseconds(2200), kReplaced = seconds(2);
// After this mutual reception two hosts use maps that agree.
constexpr nanoseconds kAgreed = seconds(4);
constexpr std::uint32_t kForgedVersionOfMap = 1U << 30;

// After this time no host knows the beacon of a dead host.
constexpr nanoseconds kUnlit = seconds(5);

// After this time no host counts a dead host as a member.
constexpr nanoseconds kForgotten = milliseconds(3700);

std::optional<Finding> judge(int invariant, nanoseconds now,
                             const std::optional<std::string>& sentence) {
  if (!sentence) return {};
  return Finding{invariant, now, *sentence};
}

bool is_in(const std::vector<Place>& places, std::uint32_t life, aoim::CellId cell) {
  return std::any_of(places.begin(), places.end(), [&](const Place& place) {
    if (!place.host || place.host->epoch() != life) return false;
    const auto cells = cells_of(*place.host);
    return std::find(cells.begin(), cells.end(), cell) != cells.end();
  });
}

}  // namespace

// L1: in each cell one of its members leads, and all members name it.
Watch::Sentence Watch::one_leader(const std::vector<Place>& places) const {
  std::map<aoim::CellId, std::uint32_t> named;
  std::map<aoim::CellId, std::size_t> leading;
  for (const Place& place : places) {
    if (!place.host) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) {
      const std::uint32_t leader = place.host->role().leader(cell);
      if (leader == 0)
        return fmt::format("{:x} knows no leader of {}", place.host->epoch(), name(cell));
      const auto [known, is_new] = named.try_emplace(cell, leader);
      if (known->second != leader) {
        return fmt::format("{} is led by {:x} and by {:x}", name(cell), known->second, leader);
      }
      leading[cell] += place.host->role().leads(cell) ? 1 : 0;
    }
  }
  for (const auto& [cell, leader] : named) {
    if (leading[cell] != 1) return fmt::format("{} of {} lead it", leading[cell], name(cell));
  }
  return {};
}

// L2: a leader in the calm continues to lead while it is in the cell.
Watch::Sentence Watch::steady(const std::vector<Place>& places) {
  std::map<aoim::CellId, std::uint32_t> leaders;
  for (const Place& place : places) {
    if (!place.host) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) {
      if (place.host->role().leads(cell)) leaders[cell] = place.host->epoch();
    }
  }
  const auto before = std::exchange(leaders_, leaders);
  for (const auto& [cell, leader] : before) {
    const auto now = leaders.find(cell);
    if (now != leaders.end() && now->second != leader && is_in(places, leader, cell)) {
      return fmt::format("{} changed from {:x} to {:x}", name(cell), leader, now->second);
    }
  }
  return {};
}

// L3: two hosts that have received each other for long use no group for different cells.
Watch::Sentence Watch::groups_apart(const std::vector<Place>& places, nanoseconds now) const {
  std::map<std::uint16_t, std::pair<aoim::CellId, std::uint32_t>> used;
  for (const Place& place : places) {
    if (!place.host || now < place.awake || now - place.disturbed < kAgreed) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) {
      const auto group = place.host->role().group(cell, now);
      if (!group) continue;
      const auto [first, is_new] = used.try_emplace(group->value, cell, place.host->epoch());
      if (first->second.first == cell) continue;
      return fmt::format("group {} is {}'s for {:x} and {}'s for {:x}", group->value,
                         name(first->second.first), first->second.second, name(cell),
                         place.host->epoch());
    }
  }
  return {};
}

// L4: if there are enough groups, each occupied cell has one, the same for all.
Watch::Sentence Watch::groups_given(const std::vector<Place>& places, nanoseconds now) const {
  if (plan_.pool < 17) return {};
  std::map<aoim::CellId, aoim::GroupIndex> given;
  for (const Place& place : places) {
    if (!place.host) continue;
    for (const aoim::CellId cell : cells_of(*place.host)) {
      if (cell == aoim::kWholeScene) continue;
      const auto group = place.host->role().group(cell, now);
      if (!group) return fmt::format("{:x} knows no group of {}", place.host->epoch(), name(cell));
      if (given.try_emplace(cell, *group).first->second != *group) {
        return fmt::format("{} has two groups", name(cell));
      }
    }
  }
  return {};
}

// L5: each host knows the last state of all entities in the cells that it has joined.
Watch::Sentence Watch::states_known(const std::vector<Place>& places) const {
  for (const Place& place : places) {
    if (!place.host) continue;
    for (const Place& other : places) {
      if (!other.host || &other == &place) continue;
      const SimulatedHost& owner = *other.host;
      if (!place.host->listens_to(owner)) continue;
      for (std::size_t i = 0; i < owner.entities(); ++i) {
        const auto known = place.host->known().find(owner.entity(i));
        const bool is_last = known != place.host->known().end() &&
                             known->second.epoch == owner.epoch() &&
                             known->second.version == owner.version();
        if (!is_last) {
          return fmt::format("{:x} does not know the state of entity {} of {:x}",
                             place.host->epoch(), i + 1, owner.epoch());
        }
      }
    }
  }
  return {};
}

// L17: a host that has joined a cell receives the group of its states.
Watch::Sentence Watch::groups_heard(const std::vector<Place>& places, nanoseconds now) const {
  for (const Place& speaker : places) {
    if (!plan_.hand_out || !speaker.host || now < speaker.awake) continue;
    for (const Place& place : places) {
      if (!place.host || now < place.awake || !place.host->listens_to(*speaker.host)) continue;
      if (place.host->hears(speaker.host->group())) continue;
      return fmt::format("{:x} does not hear group {}, in which {:x} speaks to {}",
                         place.host->epoch(), speaker.host->group().value, speaker.host->epoch(),
                         name(speaker.host->cell()));
    }
  }
  return {};
}

// L21: a host that follows a beacon joins the cell of its carrier, and none if there is no carrier.
Watch::Sentence Watch::beacons_found(const std::vector<Place>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place &place = places[i], &next = places[(i + 1) % places.size()];
    if (!place.host || place.host->aoim().sight().followed().empty()) continue;
    const aoim::FollowedBeacon& beacon = place.host->aoim().sight().followed()[0];
    const bool right = next.host ? beacon.found && beacon.cell == next.host->cell() &&
                                       place.host->listens_to(*next.host)
                                 : !beacon.found;
    if (right) continue;
    return fmt::format("{:x} takes beacon {} to be {}, and it is {}", place.host->epoch(),
                       beacon.tag, beacon.found ? name(beacon.cell) : "nowhere",
                       next.host ? name(next.host->cell()) : "nowhere");
  }
  return {};
}

// L18: a newcomer does not wait for the next map if others have one.
Watch::Sentence Watch::newcomer_asks(const std::vector<Place>& places, nanoseconds now) const {
  const Place& newcomer = places.back();
  const bool led = std::any_of(places.begin(), places.end() - 1, [](const Place& place) {
    return place.host && place.host->role().leads(aoim::kWholeScene);
  });
  const bool waits = led && newcomer.host && !newcomer.host->role().directory().holds(now);
  if (!plan_.hand_out || !waits) return {};
  return fmt::format("{:x} has no map {} ms after it came", newcomer.host->epoch(),
                     (now - plan_.newcomer) / milliseconds(1));
}

// L19: a snapshot part on its way to a newcomer is not sent again.
void Watch::note_said_again(const pdu::CellSnapshot& part) {
  if (plan_.loses_parts || !plan_.hand_out || said_again_) return;
  said_again_ = fmt::format("{:x} says part {} of cell {} {} again, which was not lost", part.epoch,
                            part.part, part.column, part.row);
}

// L6: forged datagrams change nothing.
Watch::Sentence Watch::nothing_forged(const std::vector<Place>& places) const {
  for (const Place& place : places) {
    if (!place.host) continue;
    const aoim::LeaderRole& role = place.host->role();
    if (role.directory().version() >= kForgedVersionOfMap) {
      return fmt::format("{:x} has a forged map", place.host->epoch());
    }
    for (const pdu::CellGroup& row : role.directory().beacons()) {
      if (row.beacon == kForgedBeacon)
        return fmt::format("{:x} knows a forged beacon", place.host->epoch());
    }
    for (const auto& [entity, known] : place.host->known()) {
      if (known.version >= kForgedVersion) {
        return fmt::format("{:x} has a forged state", place.host->epoch());
      }
    }
  }
  return {};
}

// L7: nothing grows without bound, and no step is long overdue.
Watch::Sentence Watch::in_bounds(const std::vector<Place>& places, nanoseconds now) const {
  for (const Place& place : places) {
    if (!place.host || now < place.awake) continue;
    const SimulatedHost& host = *place.host;
    if (host.aoim().next_step() < now - seconds(1)) {
      return fmt::format("{:x} has a step that was due {} ms ago", host.epoch(),
                         (now - host.aoim().next_step()) / milliseconds(1));
    }
    if (host.role().directory().entries().size() > plan_.pool) {
      return fmt::format("{:x} has a map of more cells than groups", host.epoch());
    }
    if (host.role().leadership().members(aoim::kWholeScene) > 2 * kMostHosts) {
      return fmt::format("{:x} counts {} members", host.epoch(),
                         host.role().leadership().members(aoim::kWholeScene));
    }
  }
  return {};
}

// L8: only leaders introduce a newcomer, unless it is the heir of a departed leader.
Watch::Sentence Watch::only_the_leader_tells(const std::vector<Place>& places) const {
  if (const auto& newcomer = places.back().host) {
    const aoim::LeaderRole& role = newcomer->role();
    const auto cells = cells_of(*newcomer);
    const bool is_heir = std::any_of(cells.begin(), cells.end(), [&](aoim::CellId cell) {
      return role.leads(cell) && role.leadership().had_other_leader(cell);
    });
    if (is_heir) return {};
  }
  for (std::size_t i = 0; i + 1 < places.size() && i < introductions_.size(); ++i) {
    if (!places[i].host || places[i].host->introductions() == introductions_[i]) continue;
    return fmt::format("{:x} said {} updates for a newcomer", places[i].host->epoch(),
                       places[i].host->introductions() - introductions_[i]);
  }
  return {};
}

void Watch::newcomer_starts(const std::vector<Place>& places) {
  for (const Place& place : places) {
    introductions_.push_back(place.host ? place.host->introductions() : 0);
  }
}

std::optional<Finding> Watch::look_at_leads(const std::vector<Place>& places, nanoseconds now) {
  if (auto found = judge(10, now, lead_watch_.newcomers_stay_behind())) return found;
  if (auto found = judge(11, now, LeadWatch::sleepers_ask(places, now))) return found;
  if (now < plan_.calm + kElected) return {};
  if (auto found = judge(12, now, LeadWatch::never_two(places))) return found;
  const auto counted = lead_watch_.members_counted(places);
  const bool dying = now >= plan_.kill && now < plan_.kill + kForgotten;
  return judge(13, now, dying ? std::nullopt : counted);
}

std::optional<Finding> Watch::look_at_maps(const std::vector<Place>& places, nanoseconds now) {
  if (auto found = judge(3, now, groups_apart(places, now))) return found;
  if (auto found = judge(14, now, MapWatch::kept(places))) return found;
  if (auto found = judge(15, now, MapWatch::leases_end(places, now))) return found;
  if (auto found = judge(20, now, map_watch_.nothing_lost(places, now))) return found;
  return judge(16, now, map_watch_.merged(places, now));
}

std::optional<Finding> Watch::look_at_newcomer(const std::vector<Place>& places,
                                               nanoseconds now) const {
  if (auto found = judge(19, now, said_again_)) return found;
  const bool mapped = now >= plan_.newcomer + kMapped;
  return judge(18, now, mapped ? newcomer_asks(places, now) : Sentence());
}

void Watch::note_who_tells(const Place& newcomer, nanoseconds now) {
  if (!newcomer.host) return;
  const std::uint32_t leader = newcomer.host->role().leader(newcomer.host->cell());
  if (leader == who_tells_) return;
  who_tells_ = leader;
  other_tells_since_ = now;
}

std::optional<Finding> Watch::look(const std::vector<Place>& places, nanoseconds now) {
  const bool killed = now >= plan_.kill && now < plan_.kill + kReplaced;
  note_who_tells(places.back(), now);
  const bool comes =
      now >= plan_.newcomer && (now < plan_.newcomer + kTold || now < other_tells_since_ + kRetold);
  const bool calm = now >= plan_.calm + kElected && !killed && !comes;
  if (auto found = judge(6, now, nothing_forged(places))) return found;
  if (auto found = judge(7, now, in_bounds(places, now))) return found;
  if (auto found = look_at_maps(places, now)) return found;
  if (auto found = look_at_leads(places, now)) return found;
  if (auto found = look_at_newcomer(places, now)) return found;
  if (!calm) {
    if (killed) leaders_.clear();
    return {};
  }
  const bool listens = now >= plan_.newcomer && now < plan_.newcomer + kAlone;
  if (auto found = judge(1, now, listens ? Sentence() : one_leader(places))) return found;
  if (auto found = judge(2, now, steady(places))) return found;
  if (auto found = judge(17, now, groups_heard(places, now))) return found;
  const bool gone = now < plan_.kill || now >= plan_.kill + kUnlit;
  if (auto found = judge(21, now, gone ? beacons_found(places) : Sentence())) return found;
  const bool settled = now >= plan_.calm + kGiven;
  const bool given = settled && now < plan_.kill;
  if (auto found = judge(4, now, given ? groups_given(places, now) : Sentence())) return found;
  if (auto found = judge(5, now, settled ? states_known(places) : Sentence())) return found;
  return judge(8, now, now >= plan_.newcomer ? only_the_leader_tells(places) : Sentence());
}

}  // namespace reckon::fuzz::leaders
