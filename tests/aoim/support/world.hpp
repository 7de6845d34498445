// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Area-of-interest managers on a lossless segment with its own clock.
#pragma once

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim::test {

inline AreaOfInterestConfig config() {
  AreaOfInterestConfig result;
  result.grid.cell_size = 125.0;
  return result;
}

/// Two or more managers on one lossless segment.
struct World {
  struct Member {
    std::unique_ptr<AreaOfInterestManager> manager;
    std::set<GroupIndex> joined{kBaseGroup};
    std::vector<pdu::EntityId> used;  ///< entities of datagrams that passed the filter
    Position place;
  };
  std::vector<Member> members;
  nanoseconds now = seconds(100);

  AreaOfInterestManager& add(const pdu::Presence& own, const Position& place,
                             const AreaOfInterestConfig& how = config()) {
    members.push_back({std::make_unique<AreaOfInterestManager>(how, own), {kBaseGroup}, {}, place});
    focus(members.back());
    members.back().manager->start(now);
    return *members.back().manager;
  }
  void focus(Member& member) {
    const Focus focus{member.place, 0.0, 200.0};
    follow(member, member.manager->listen(kCellTier, {&focus, 1}, now));
  }
  static void follow(Member& member, const SubscriptionChange& change) {
    for (const GroupIndex group : change.join) member.joined.insert(group);
    for (const GroupIndex group : change.leave) member.joined.erase(group);
  }
  void step() {
    Collector wire;
    for (Member& member : members) {
      focus(member);
      member.manager->step(now, wire);
    }
    for (const Datagram& datagram : wire.datagrams) {
      for (Member& member : members) {
        if (member.joined.contains(datagram.group)) deliver(member, datagram);
      }
    }
    now += milliseconds(1);
  }
  void run(nanoseconds length) {
    for (const nanoseconds end = now + length; now < end;) step();
  }
  /// Each of the first `count` members sends its position, as entity {7, its place from 1, 1}.
  void let_speak(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      pdu::EntityState state = entity_state(1);
      state.entity_id = {7, static_cast<std::uint16_t>(i + 1), 1};
      members[i].manager->send(kCellTier, StatePayload{state}, members[i].place, now);
    }
  }
  /// Number of received updates of entity 7:1:`entity` at a member.
  [[nodiscard]] std::size_t heard(std::size_t member, std::uint16_t entity) const {
    const auto& used = members[member].used;
    return static_cast<std::size_t>(
        std::count(used.begin(), used.end(), pdu::EntityId{7, 1, entity}));
  }
  void deliver(Member& member, const Datagram& datagram) {
    if (!is_usable(member.manager->receive(datagram.group, datagram.octets, now).verdict)) return;
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram.octets)) {
      pdu::EntityState state;
      if (pdu::decode(bundled.bytes, state) == pdu::DecodeError::none) {
        member.used.push_back(state.entity_id);
      }
    }
  }
};

}  // namespace reckon::aoim::test
