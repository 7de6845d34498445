// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exercises of whole peers against brute force, and as processes.
#include "reckon/bench/studies/scale/whole_runs.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/bench/studies/scale/whole_text.hpp"
#include "reckon/tests/src/support/own_network.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench::whole_runs_test {
namespace {

ScaleSetting small_setting() {
  ScaleSetting setting;
  setting.peers = 10;
  setting.crowd = {"vehicles", 100, 100, 1};
  setting.seconds = 4;
  setting.rate = 20;
  return setting;
}

bool is_in_reach(const ScaleSetting& setting, const Crowd& crowd, std::size_t peer,
                 std::uint32_t entity) {
  const OwnedRange own = owned_by(setting, peer);
  if (entity >= own.first && entity < own.end) return false;
  for (std::uint32_t e = own.first; e < own.end; ++e)
    if (distance(crowd.position(e), crowd.position(entity)) <= setting.radius) return true;
  return false;
}

TEST(WholePeers, LookAtAllInReachAndShowThem) {
  const ScaleSetting setting = small_setting();
  Crowd crowd(setting.crowd);
  std::uint64_t in_reach = 0;
  for (std::size_t tick = 0; tick < 7 * 20; ++tick) {
    crowd.advance(static_cast<double>(tick) / 20);
    if (tick < 3 * 20 || tick % 2 != 0) continue;
    for (std::size_t peer = 0; peer < setting.peers; ++peer)
      for (std::uint32_t e = 0; e < crowd.size(); ++e)
        in_reach += is_in_reach(setting, crowd, peer, e);
  }
  const WholeRun run = run_whole_peers(setting, Meeting::simulated);
  EXPECT_GT(in_reach, 5000U);
  EXPECT_EQ(run.counts.looks, in_reach);
  EXPECT_LT(static_cast<double>(run.counts.unseen), 0.005 * static_cast<double>(in_reach));
  EXPECT_EQ(run.counts.overdue, 0U);
  EXPECT_EQ(run.counts.ghosts, 0U);
  EXPECT_EQ(run.counts.lost, 0U);
  EXPECT_EQ(run.counts.foreign, 0U);
  EXPECT_LT(run.pose.p50, setting.thresholds.position);
}

TEST(WholePeers, MissWhatTheNetworkLoses) {
  ScaleSetting setting = small_setting();
  setting.network.loss = 0.97;
  const WholeRun run = run_whole_peers(setting, Meeting::simulated);
  EXPECT_GT(run.counts.overdue, 0U);
  EXPECT_GT(run.counts.lost, 0U);
}

// Four fifths are in a village of 1 km, the others across 4 km. Each walks on a circle of 30 m
// radius.
std::vector<Track> lopsided_crowd(std::size_t count) {
  std::vector<Track> tracks(count);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> all(0, 4000), village(2600, 3600), turn(0, 6.28);
  for (std::size_t i = 0; i < count; ++i) {
    auto& along = i % 5 == 0 ? all : village;
    const double x = along(random), y = along(random), begin = turn(random);
    for (int second = 0; second <= 9; ++second) {
      deadreckon::MotionSample sample;
      sample.time = second;
      const double angle = begin + 0.05 * second;
      sample.position = {x + 30 * std::cos(angle), y + 30 * std::sin(angle), 0};
      tracks[i].samples.push_back(sample);
    }
  }
  return tracks;
}

TEST(WholePeers, QuadTreeReducesUnwantedUpdates) {
  const std::vector<Track> tracks = lopsided_crowd(320);
  ScaleSetting setting = small_setting();
  setting.peers = 32;
  setting.crowd = {"vehicles", 320, 100, 1, tracks};
  setting.rate = 10;
  const auto unwanted = [](const WholeRun& run) {
    return run.counts.heard_updates - run.counts.wanted;
  };
  const auto run_with = [&](const char* name) {
    const WholeRun run = run_whole_peers(setting, Meeting::simulated);
    std::printf("%s of %.0f m: heard %lu, unwanted %lu, groups joined %lu\n", name,
                setting.grid.cell_size, run.counts.heard_updates, unwanted(run), run.counts.groups);
    EXPECT_GT(run.counts.looks, 10'000U);
    EXPECT_EQ(run.counts.overdue, 0U);
    EXPECT_EQ(run.counts.ghosts, 0U);
    EXPECT_EQ(run.counts.lost, 0U);
    return run;
  };
  std::uint64_t fewest = ~std::uint64_t{0};
  for (const double side : {250.0, 350.0, 500.0}) {  // 64 cells of 500 m fill the square once
    if (side > test::tries(250.0, 500.0)) break;
    setting.grid = {aoim::CellScheme::square, side, 64};
    fewest = std::min(fewest, unwanted(run_with("squares")));
  }
  setting.grid = {aoim::CellScheme::quad_tree, 50, 64};
  divide_by_crowd(setting);
  EXPECT_GT(setting.tree.cells.size(), 60U);
  EXPECT_LT(unwanted(run_with("quad-tree")), fewest);
}

// Growth as without areas: all peers receive all updates that are sent to cells.
TEST(WholePeers, ShareOneGroupWhereThePoolIsOne) {
  ScaleSetting setting = small_setting();
  setting.grid.pool = 1;
  const WholeRun run = run_whole_peers(setting, Meeting::simulated);
  EXPECT_EQ(run.counts.groups, setting.peers);
  EXPECT_EQ(run.counts.overdue, 0U);
  const auto others = static_cast<double>(setting.peers - 1);
  EXPECT_NEAR(static_cast<double>(run.counts.heard_updates),
              others * static_cast<double>(run.counts.updates),
              0.1 * others * static_cast<double>(run.counts.updates));
}

TEST(WholePeers, AtRestSendListsBetweenAnnouncements) {
  ScaleSetting setting = small_setting();
  setting.crowd.movement = "rest";
  setting.seconds = 20;
  const WholeRun run = run_whole_peers(setting, Meeting::simulated);
  EXPECT_GT(run.counts.datagrams, 18 * setting.seconds) << "two a second, less those with states";
}

TEST(WholePeers, AreProcessesThatHearEachOther) {
  ScaleSetting setting = small_setting();
  setting.peers = 3;
  setting.crowd.entities = 6;
  setting.seconds = 1;
  const WholeRun run = run_whole_peers(setting, Meeting::lo);
  EXPECT_EQ(run.counts.peers, 3U);
  EXPECT_GT(run.counts.heard_datagrams, 0U);
  EXPECT_GT(run.counts.cpu, 0);
  EXPECT_GT(run.resident, 1e5);
}

// On a bridge that snoops, a join that the bridge does not learn of costs all updates of a cell.
// Within 10 %, as the processes do not take their steps at the same instants.
TEST(WholePeers, ReceiveOnASwitchWhatTheSimulationPredicts) {
  ScaleSetting setting = small_setting();
  setting.peers = 8;
  setting.crowd.entities = 80;
  const WholeRun simulated = run_whole_peers(setting, Meeting::simulated);
  WholeRun run;
  RECKON_IN_OWN_NETWORK([&] { run = run_whole_peers(setting, Meeting::lan); });
  EXPECT_EQ(run.counts.overdue, 0U);
  const auto expected = static_cast<double>(simulated.counts.heard_updates);
  EXPECT_NEAR(static_cast<double>(run.counts.heard_updates), expected, 0.1 * expected);
}

TEST(WholePeers, ProcessesRefuseASimulatedNetwork) {
  ScaleSetting setting = small_setting();
  setting.network.loss = 0.1;
  EXPECT_THROW(check_meeting(setting, Meeting::lo), tools::UsageError);
  setting.network.loss = 0;
  setting.peers = kMostProcesses + 1;
  EXPECT_THROW(check_meeting(setting, Meeting::lo), tools::UsageError);
  EXPECT_NO_THROW(check_meeting(setting, Meeting::simulated));
  EXPECT_THROW(static_cast<void>(read_meeting("moon")), tools::UsageError);
}

// A peer stores 1,024 others, and half as many of one address.
TEST(WholeText, SaysWhereAPeerCannotKnowAll) {
  const auto says_so = [](Meeting meeting, std::size_t peers) {
    WholeRow row;
    row.run.meeting = meeting;
    row.run.setting.peers = peers;
    row.run.counts.seconds = row.simulated.counts.seconds = 1;
    return whole_text(std::span(&row, 1)).find("a peer has room for") != std::string::npos;
  };
  EXPECT_FALSE(says_so(Meeting::hosts, 1025));
  EXPECT_TRUE(says_so(Meeting::hosts, 1026));
  EXPECT_FALSE(says_so(Meeting::lo, 513));
  EXPECT_TRUE(says_so(Meeting::lo, 514));
}

}  // namespace
}  // namespace reckon::bench::whole_runs_test
