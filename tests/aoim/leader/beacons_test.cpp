// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Beacons: their cells as reported by their owners, their entries in the group map, and peers that
// follow one.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr std::uint32_t kGate = beacon_tag("gate"), kFerry = beacon_tag("ferry");

std::vector<std::pair<std::uint32_t, CellId>> all_of(const BeaconBook& book) {
  std::vector<std::pair<std::uint32_t, CellId>> all;
  book.for_each([&all](std::uint32_t tag, CellId cell) { all.emplace_back(tag, cell); });
  return all;
}

TEST(BeaconBook, FollowsABeaconFromCellToCell) {
  BeaconBook book(seconds(5));
  EXPECT_TRUE(book.receive(kGate, {1, 0}, 7, seconds(1)));
  EXPECT_FALSE(book.receive(kGate, {1, 0}, 7, seconds(2))) << "no news";
  EXPECT_TRUE(book.receive(kGate, {2, 0}, 7, seconds(3)));
  EXPECT_FALSE(book.leave({1, 0}, 7)) << "it is there no more";
  EXPECT_EQ(all_of(book).size(), 1U);
  EXPECT_TRUE(book.leave({2, 0}, 7));
  EXPECT_EQ(book.size(), 0U);
}

TEST(BeaconBook, KeepsTheFirstOwnerUntilItIsSilent) {
  BeaconBook book(seconds(5));
  book.receive(kGate, {1, 0}, 7, seconds(1));
  EXPECT_FALSE(book.receive(kGate, {9, 0}, 8, seconds(2)));
  EXPECT_FALSE(book.forget(8));
  EXPECT_EQ(all_of(book).front().second, (CellId{1, 0}));
  EXPECT_TRUE(book.receive(kGate, {9, 0}, 8, seconds(6)));
  EXPECT_EQ(all_of(book).front().second, (CellId{9, 0}));
  EXPECT_TRUE(book.forget(8));
  EXPECT_EQ(book.size(), 0U);
}

TEST(BeaconBook, ForgetsBeaconsWithoutReports) {
  BeaconBook book(seconds(5));
  book.receive(kGate, {1, 0}, 7, seconds(1));
  EXPECT_FALSE(book.expire(milliseconds(5999)));
  EXPECT_TRUE(book.expire(seconds(6)));
  EXPECT_EQ(book.size(), 0U);
}

TEST(BeaconBook, LimitsBeaconsInTotalAndPerOwner) {
  BeaconBook book(seconds(5));
  for (std::uint32_t tag = 1; tag <= 1000; ++tag) book.receive(tag, {1, 0}, 7, seconds(1));
  EXPECT_EQ(book.size(), BeaconBook::kMostOfOne);
  for (std::uint32_t tag = 1001; tag <= 2000; ++tag) book.receive(tag, {1, 0}, tag, seconds(1));
  EXPECT_EQ(book.size(), BeaconBook::kMost);
  EXPECT_FALSE(book.receive(0, {1, 0}, 9, seconds(1))) << "no tag";
}

// For each peer, the beacons that it follows.
using Follows = std::vector<std::vector<std::uint32_t>>;

// Peers on a field of 100 m cells; the first one leads and hands out groups.
struct Peers {
  explicit Peers(const Follows& follow, std::size_t pool = 8)
      : places(follow.size()), carried(follow.size()) {
    for (std::size_t i = 0; i < follow.size(); ++i) {
      AreaOfInterestConfig config;
      config.grid.scheme = CellScheme::square;
      config.grid.cell_size = 100.0;
      config.grid.pool = pool;
      config.leader.on = config.leader.hand_out = true;
      config.follow = follow[i];
      pdu::Presence own;
      own.simulation = {1, static_cast<std::uint16_t>(i + 1)};
      own.epoch = static_cast<std::uint32_t>(100U + i);
      own.started = static_cast<std::uint32_t>(1000U + i);
      places[i] = {50.0 + 700.0 * static_cast<double>(i), 50.0, 0.0};
      managers.push_back(std::make_unique<AreaOfInterestManager>(config, own));
      look(i);
      managers[i]->start(now);
      run(milliseconds(100));
    }
  }
  void look(std::size_t peer) {
    const Focus focus{places[peer], 0.0, 10.0};
    if (carried[peer] != 0) {
      const PlacedBeacon beacon{carried[peer], places[peer]};
      managers[peer]->leading()->set_beacons({&beacon, 1}, now);
    }
    managers[peer]->listen(kCellTier, {&focus, 1}, now);
  }
  void run(nanoseconds length) {
    for (const nanoseconds end = now + length; now < end; now += milliseconds(1)) {
      std::vector<std::tuple<std::size_t, GroupIndex, std::vector<std::byte>>> wire;
      for (std::size_t i = 0; i < managers.size(); ++i) {
        if (!managers[i]) continue;
        look(i);
        managers[i]->step(now, [&](GroupIndex group, std::span<const std::byte> octets) {
          wire.emplace_back(i, group, std::vector(octets.begin(), octets.end()));
        });
        static_cast<void>(managers[i]->take_events());
      }
      for (const auto& [from, group, octets] : wire) {
        for (std::size_t to = 0; to < managers.size(); ++to) {
          if (to == from || !managers[to] || !managers[to]->subscriptions().hears(group)) continue;
          static_cast<void>(managers[to]->receive(group, octets, now));
        }
      }
    }
  }
  [[nodiscard]] const FollowedBeacon& followed(std::size_t peer) const {
    return managers[peer]->sight().followed()[0];
  }
  [[nodiscard]] bool listens(std::size_t to, std::size_t at) const {
    const AreaOfInterestManager& manager = *managers[to];
    return manager.subscriptions().cells().is_joined(manager.cells().group(places[at])) &&
           manager.subscriptions().hears(managers[at]->route(places[at]));
  }

  nanoseconds now = seconds(10);
  std::vector<Position> places;
  std::vector<std::uint32_t> carried;
  std::vector<std::unique_ptr<AreaOfInterestManager>> managers;
};

TEST(Beacons, LetFollowersSubscribeToTheEntitysCell) {
  Peers three(Follows{{}, {}, {kGate}});
  three.run(seconds(4));
  EXPECT_FALSE(three.followed(2).found);
  EXPECT_EQ(three.followed(2).number.value, 0U);
  three.carried[1] = kGate;
  three.run(milliseconds(400));
  EXPECT_TRUE(three.followed(2).found);
  EXPECT_TRUE(three.listens(2, 1));
  EXPECT_FALSE(three.listens(0, 1)) << "it does not follow";
  three.places[1] = {5050.0, 3050.0, 0.0};
  three.run(milliseconds(400));
  EXPECT_TRUE(three.listens(2, 1)) << "it has gone elsewhere";
  EXPECT_EQ(three.followed(2).cell, *three.managers[1]->leading()->carried_in(kGate));
}

TEST(Beacons, MakeTheirCellVisibleFromAnywhere) {
  Peers two(Follows{{}, {kGate}});
  two.carried[0] = kGate;
  two.run(seconds(5));
  AreaOfInterestManager& follower = *two.managers[1];
  const Position beside{80.0, 20.0, 0.0}, beyond{-30.0, 50.0, 0.0}, far{-70.0, 50.0, 0.0};
  EXPECT_EQ(follower.sight().judge(beside, 0.0, 1, false), InterestVerdict::inside);
  EXPECT_GT(follower.sight().gap(beside, 0.0), 0.0) << "the leader of the cell introduces it";
  EXPECT_EQ(follower.sight().judge(beyond, 0.0, 1, false), InterestVerdict::outside);
  EXPECT_EQ(follower.sight().judge(beyond, 0.0, 1, true), InterestVerdict::inside) << "it is shown";
  EXPECT_EQ(follower.sight().judge(far, 0.0, 1, true), InterestVerdict::left);
  EXPECT_TRUE(follower.sight().keeps(beside, beside, seconds(60)));
  EXPECT_TRUE(follower.sight().keeps(beyond, beyond, seconds(1)));
  EXPECT_TRUE(follower.sight().keeps(beyond, beside, seconds(60))) << "it has not left the cell";
  EXPECT_FALSE(follower.sight().keeps(beside, beyond, seconds(60))) << "it has left the cell";
  EXPECT_FALSE(follower.sight().keeps(far, beside, seconds(1)));
  EXPECT_EQ(two.managers[0]->sight().judge({780.0, 20.0, 0.0}, 0.0, 1, false),
            InterestVerdict::outside);
}

TEST(Beacons, MoveWithTheirOwner) {
  Peers three(Follows{{}, {}, {kGate}});
  three.carried[1] = kGate;
  three.run(seconds(5));
  ASSERT_TRUE(three.followed(2).found);
  three.managers[1].reset();
  three.run(milliseconds(5200));
  EXPECT_FALSE(three.followed(2).found) << "silent for 5 s";
  EXPECT_GT(three.followed(2).number.value, 0U) << "it may only have been unheard";
  three.run(seconds(5));
  EXPECT_EQ(three.followed(2).number.value, 0U);
}

TEST(Beacons, StayFoundWhenTheSceneLeaderDies) {
  Peers three(Follows{{}, {}, {kGate}});
  three.carried[1] = kGate;
  three.run(seconds(5));
  three.managers[0].reset();
  for (int i = 0; i < 60; ++i) {
    three.run(milliseconds(100));
    ASSERT_TRUE(three.followed(2).found) << i;
    ASSERT_TRUE(three.listens(2, 1)) << i;
  }
  EXPECT_TRUE(three.managers[1]->leading()->role().leads(kWholeScene));
}

// The pool is used up: the cell sends to the base group, and its beacon is found all the same.
TEST(Beacons, AreFoundInCellsWithoutAGroup) {
  Peers six(Follows{{}, {}, {}, {}, {}, {kGate}}, 4);
  six.carried[4] = kGate;
  six.run(seconds(8));
  EXPECT_EQ(six.managers[4]->route(six.places[4]), kBaseGroup);
  EXPECT_TRUE(six.followed(5).found);
  EXPECT_EQ(six.followed(5).group, kBaseGroup);
  EXPECT_EQ(six.managers[5]->sight().judge(six.places[4], 0.0, 1, false), InterestVerdict::inside);
}

TEST(Beacons, OfOneCellDoNotAlternate) {
  Peers three(Follows{{kGate, kFerry}, {}, {}});
  three.places[1] = three.places[2] = {4050.0, 50.0, 0.0};
  three.carried[1] = kGate;
  three.carried[2] = kFerry;
  three.run(seconds(12));  // the former cells are empty by then
  const std::uint32_t version = three.managers[0]->leading()->role().directory().version();
  for (int i = 0; i < 50; ++i) {
    three.run(milliseconds(100));
    for (const FollowedBeacon& one : three.managers[0]->sight().followed())
      ASSERT_TRUE(one.found) << i;
  }
  EXPECT_EQ(three.managers[0]->leading()->role().directory().version(), version)
      << "the map stands";
}

TEST(Beacons, OfOneNameBelongToTheFirstOwner) {
  Peers three(Follows{{kGate}, {}, {}});
  three.carried[1] = kGate;
  three.run(seconds(5));
  three.carried[2] = kGate;
  three.run(seconds(5));
  EXPECT_EQ(three.followed(0).cell, *three.managers[1]->leading()->carried_in(kGate));
  three.managers[1].reset();
  three.run(seconds(7));
  EXPECT_EQ(three.followed(0).cell, *three.managers[2]->leading()->carried_in(kGate));
}

TEST(Beacons, NeedGroupsThatAreHandedOut) {
  AreaOfInterestConfig config;
  config.follow = {kGate};
  pdu::Presence own;
  own.epoch = 1;
  EXPECT_THROW(AreaOfInterestManager(config, own), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::aoim
