// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers in a world with more cells than groups: the scene leader hands out the groups, cells
// without one use the base group, and no state is lost during changes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/integration/field_of_peers.hpp"

namespace reckon::test::handed_out_test {
namespace {

constexpr std::size_t kCells = 6, kGroups = 4;
constexpr double kApart = 300.0;               // distance of occupied cells [m]
constexpr double kRadius = 8.0, kSpeed = 4.0;  // of the circle that each car drives [m], [m/s]
// The threshold of 1 m, and the effect of 4 ms delay.
constexpr double kMost = 1.1;  // [m]

std::string handed_out_field(std::string_view extra = "hand_out = true\n") {
  return with(kField, "pool = 16\nleaders = true\n",
              "pool = 4\nleaders = true\n" + std::string(extra));
}

// A car and a watcher in each of six cells, a peer each.
class ManyCells : public testing::Test {
 protected:
  explicit ManyCells(const std::string& scene = handed_out_field(), std::uint64_t = 1)
      : field_(2 * kCells, scene) {}

  [[nodiscard]] static double east(std::size_t cell) { return kApart * static_cast<double>(cell); }
  [[nodiscard]] peer::EntityTruth truth(std::size_t cell) {
    const double angle = kSpeed / kRadius * pdu::to_seconds(field_.world_.clock().now());
    peer::EntityTruth truth =
        field_.truth({east(cell) + kRadius * std::cos(angle), kRadius * std::sin(angle), 0});
    truth.velocity = {-kSpeed * std::sin(angle), kSpeed * std::cos(angle), 0};
    return truth;
  }
  void start(std::size_t link) {
    field_.start(link, 1, false, east(link % kCells));
    lives_[link] = true;
  }
  void start_all(std::size_t but = 2 * kCells) {
    for (std::size_t link = 0; link < 2 * kCells; ++link) {
      if (link != but) start(link);
    }
  }
  void kill(std::size_t link) {
    field_.kill(link);
    lives_[link] = false;
  }
  /// Drives on, and checks the shown cars of all watchers from `after` [ms] on.
  void drive(std::size_t ms, std::size_t after = 0) {
    for (std::size_t i = 0; i < ms; i += 10) {
      for (std::size_t cell = 0; cell < kCells; ++cell) {
        if (lives_[cell]) field_.world_.peer(cell).model().move(1, truth(cell));
      }
      field_.world_.run(10);
      if (i >= after) look();
    }
  }
  void look() {
    for (std::size_t cell = 0; cell < kCells; ++cell) {
      if (!lives_[cell] || !lives_[kCells + cell]) continue;
      const auto& remote = field_.world_.peer(kCells + cell).model().remote();
      const auto* car = remote.find({1, static_cast<std::uint16_t>(cell + 1), 1});
      ++looks_;
      if (car == nullptr) {
        ++missing_;
        continue;
      }
      const nanoseconds now = field_.world_.clock().now();
      worst_ = std::max(worst_, (car->predicted(now).position - truth(cell).position).norm());
    }
  }
  /// The cells whose states the listener has received in each group since then.
  [[nodiscard]] std::map<std::string, std::set<std::size_t>> cells_by_group(nanoseconds since) {
    std::map<std::string, std::set<std::size_t>> cells;
    for (const Heard& heard : field_.world_.heard()) {
      if (heard.time <= since) continue;
      for (const pdu::BundledPdu& pdu : pdu::BundleReader(heard.octets)) {
        if (pdu.header.pdu_type != pdu::PduType::entity_state) continue;
        const std::size_t link = heard.sender.octets[3] - 1U;
        cells[heard.group.text()].insert(link % kCells);
      }
    }
    return cells;
  }
  [[nodiscard]] std::string base() const { return field_.scene_.network.group.text(); }

  Field field_;
  std::array<bool, 2 * kCells> lives_{};
  std::size_t looks_ = 0, missing_ = 0;
  double worst_ = 0.0;  // [m]
};

TEST_F(ManyCells, HaveAGroupEachOrUseTheBase) {
  start_all();
  drive(50'000, 3000);  // without cars peers were interested in other cells: those groups are idle
  const nanoseconds since = field_.world_.clock().now();
  drive(10'000);
  const auto cells = cells_by_group(since);
  ASSERT_EQ(cells.size(), kGroups + 1) << "all groups, and the base group";
  for (const auto& [group, who] : cells) {
    EXPECT_EQ(who.size(), group == base() ? kCells - kGroups : 1U) << group;
  }
  EXPECT_EQ(field_.world_.view(0).leaders.map_cells, kGroups);
  EXPECT_EQ(missing_, 0U) << "of " << looks_;
  EXPECT_LT(worst_, kMost);
  for (std::size_t link = 0; link < 2 * kCells; ++link) {
    EXPECT_EQ(field_.world_.count(link, "datagrams_lost"), 0U);
    EXPECT_LE(field_.world_.view(link).groups, 1U) << "that of its cell";
  }
  std::printf("%zu cells, %zu groups: error of what is shown at most %.3f m in %zu looks\n", kCells,
              kGroups, worst_, looks_);
}

class ManyCellsByTile : public ManyCells {
 protected:
  ManyCellsByTile() : ManyCells(handed_out_field("")) {}
};

TEST_F(ManyCellsByTile, ShareTheGroupsOfTheTile) {
  start_all();
  drive(5000);
  const nanoseconds since = field_.world_.clock().now();
  drive(5000);
  const auto cells = cells_by_group(since);
  std::size_t most = 0;
  for (const auto& [group, who] : cells) most = std::max(most, who.size());
  EXPECT_EQ(cells.count(base()), 0U);
  EXPECT_GE(most, 3U) << "cells two apart share one of the 2 x 2 groups";
}

// The scene leader is killed, and the next one departs.
TEST_F(ManyCells, LoseNoStateWithoutASceneLeader) {
  start_all();
  drive(12'000, 3000);
  EXPECT_EQ(field_.leader(2).scene, "1:1");
  kill(0);
  drive(10'000);
  EXPECT_EQ(field_.leader(2).scene, "1:2") << "who came second";
  field_.stop(1);
  lives_[1] = false;
  drive(10'000);
  EXPECT_EQ(field_.leader(2).scene, "1:3");
  EXPECT_EQ(missing_, 0U) << "of " << looks_;
  EXPECT_LT(worst_, kMost);
  std::printf("two leaders of the scene gone: error at most %.3f m in %zu looks\n", worst_, looks_);
}

TEST_F(ManyCells, ReassignAGroupAfterTheQuarantine) {
  start_all();
  drive(50'000, 3000);
  // Both peers of a cell with a group depart; the scene leader is in the first cell.
  const nanoseconds since = field_.world_.clock().now();
  drive(3000);
  std::size_t goes = 0;
  for (const auto& [group, who] : cells_by_group(since)) {
    if (group != base() && *who.begin() != 0) goes = *who.begin();
  }
  ASSERT_GT(goes, 0U);
  for (const std::size_t link : {goes, kCells + goes}) {
    field_.stop(link);
    lives_[link] = false;
  }
  const nanoseconds left = field_.world_.clock().now();
  std::size_t given = 0;  // [ms]
  while (given == 0 && field_.world_.clock().now() - left < seconds(60)) {
    const nanoseconds before = field_.world_.clock().now();
    drive(1000);
    if (field_.world_.view(0).leaders.map_cells == kGroups &&
        field_.world_.clock().now() - left > seconds(10)) {
      given = static_cast<std::size_t>((before - left) / milliseconds(1));
    }
  }
  std::printf("a group that was given back is another cell's after %.0f s\n",
              1e-3 * static_cast<double>(given));
  EXPECT_GE(given, 34'000U) << "5 s empty, 30 s quarantine";
  EXPECT_LE(given, 40'000U);
  drive(4000);
  const nanoseconds then = field_.world_.clock().now();
  drive(5000);
  const auto cells = cells_by_group(then);
  ASSERT_EQ(cells.count(base()), 1U);
  EXPECT_EQ(cells.at(base()).size(), 1U) << "one cell less without a group";
  EXPECT_EQ(missing_, 0U) << "of " << looks_;
  EXPECT_LT(worst_, kMost);
}

TEST_F(ManyCells, IntroduceANewcomerWithinASecond) {
  start_all(kCells + 1);
  drive(12'000, 3000);
  start(kCells + 1);
  const auto& remote = field_.world_.peer(kCells + 1).model().remote();
  std::size_t took = 0;
  for (; took < 2000 && remote.find({1, 2, 1}) == nullptr; took += 10) drive(10, 10);
  std::printf("a newcomer that knew no map shows what is in its cell after %zu ms\n", took);
  EXPECT_LT(took, 1000U);
  drive(5000);
  EXPECT_EQ(missing_, 0U);
  EXPECT_LT(worst_, kMost);
}

// Cut off for half a minute: each side hands out groups, the same ones to different cells.
TEST_F(ManyCells, LoseNoStateWhenTwoSidesMeetAgain) {
  peer::ImpairmentLaw cut;
  cut.outages = {{seconds(1), seconds(25)}};
  for (std::size_t one = 0; one < 2 * kCells; ++one) {
    for (std::size_t other = 0; other < 2 * kCells; ++other) {
      const bool apart = (one % kCells < kCells / 2) != (other % kCells < kCells / 2);
      if (apart) field_.world_.network().impair(one, other, cut);
    }
  }
  start_all();
  drive(24'000, 3000);
  EXPECT_NE(field_.leader(0).scene, field_.leader(5).scene);
  drive(20'000);
  EXPECT_EQ(field_.leader(0).scene, field_.leader(5).scene);
  EXPECT_EQ(missing_, 0U) << "of " << looks_;
  EXPECT_LT(worst_, kMost);
  std::printf("two sides meet again: error at most %.3f m in %zu looks\n", worst_, looks_);
}

TEST(HandedOut, WantsLeaders) {
  try {
    static_cast<void>(scene_of(with(kField, "leaders = true", "hand_out = true")));
    FAIL();
  } catch (const peer::SceneFileError& error) {
    EXPECT_NE(std::string(error.what()).find("set 'leaders'"), std::string::npos) << error.what();
  }
  EXPECT_NE(scene_of(handed_out_field()).hash, scene_of(handed_out_field("")).hash);
}

}  // namespace
}  // namespace reckon::test::handed_out_test
