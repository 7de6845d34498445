// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An entity moves to a cell that the leader of its former cell has not joined; groups are handed
// out.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <tuple>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr Position kNear{50.0, 50.0, 0.0}, kAway{950.0, 50.0, 0.0};
constexpr pdu::EntityId kEntity{1, 2, 1};

// The first peer leads; the second one owns an entity.
struct LeaderAndOwner {
  LeaderAndOwner() {
    for (std::uint16_t i = 0; i < 2; ++i) {
      AreaOfInterestConfig config;
      config.grid.scheme = CellScheme::square;
      config.grid.cell_size = 100.0;
      config.leader.on = config.leader.hand_out = true;
      pdu::Presence own;
      own.simulation = {1, static_cast<std::uint16_t>(i + 1)};
      own.epoch = 100U + i;
      own.started = 1000U + i;
      peers[i] = std::make_unique<AreaOfInterestManager>(config, own);
      look(i);
      peers[i]->start(now);
      run(milliseconds(100));
    }
    run(seconds(4));
  }
  void look(std::size_t peer) {
    const Focus focus{places[peer], 0.0, 10.0};
    peers[peer]->listen(kCellTier, {&focus, 1}, now);
  }
  void say(const Position& place) {
    pdu::EntityState state;
    state.entity_id = kEntity;
    state.location = {place.x, place.y, 0.0};
    peers[1]->send(kCellTier, StatePayload{state}, place, now);
    run(milliseconds(10));
  }
  void run(nanoseconds length) {
    for (const nanoseconds end = now + length; now < end; now += milliseconds(1)) {
      std::vector<std::tuple<std::size_t, GroupIndex, std::vector<std::byte>>> wire;
      for (std::size_t i = 0; i < peers.size() && peers[i]; ++i) {
        look(i);
        peers[i]->step(now, [&](GroupIndex group, std::span<const std::byte> octets) {
          wire.emplace_back(1 - i, group, std::vector(octets.begin(), octets.end()));
        });
        static_cast<void>(peers[i]->take_events());
      }
      for (const auto& [to, group, octets] : wire) {
        if (!peers[to] || !peers[to]->subscriptions().hears(group)) continue;
        static_cast<void>(peers[to]->receive(group, octets, now));
      }
    }
  }
  [[nodiscard]] bool is_kept() const {
    return peers[0]->leading()->role().states().find(kEntity) != nullptr;
  }

  nanoseconds now = seconds(10);
  std::array<Position, 2> places{kNear, kNear};
  std::array<std::unique_ptr<AreaOfInterestManager>, 2> peers;
};

TEST(StatesKept, ForgetEntityThatMovedToAForeignCell) {
  LeaderAndOwner two;
  two.say(kNear);
  ASSERT_TRUE(two.is_kept());
  two.places[1] = kAway;
  two.run(milliseconds(10));
  ASSERT_EQ(two.peers[1]->route(kAway), kBaseGroup) << "a cell that is new speaks to all";
  two.say(kAway);
  EXPECT_FALSE(two.is_kept()) << "who comes to the former cell is not told of it";
  two.places[1] = kNear;
  two.say(kNear);
  EXPECT_TRUE(two.is_kept());
}

TEST(StatesKept, ForgetNothingFromAnotherEpoch) {
  StateStore store;
  pdu::EntityState state;
  state.entity_id = kEntity;
  store.note({3}, 7, state, std::array<std::byte, 4>(), seconds(1));
  store.forget(8, kEntity);
  EXPECT_NE(store.find(kEntity), nullptr);
  store.forget(7, kEntity);
  EXPECT_EQ(store.find(kEntity), nullptr);
}

}  // namespace
}  // namespace reckon::aoim
