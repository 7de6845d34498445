// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The leaders, in the live table and the summary.
#include "reckon/tools/exercise/leaders_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace reckon::tools {
namespace {

// A peer in the cells 0,0 and 0,1, with the given leaders.
std::unique_ptr<peer::PeerView> view_of(std::uint16_t first, std::uint16_t second) {
  auto view = std::make_unique<peer::PeerView>();
  view->leaders.on = true;
  view->leaders.scene = {1, 1};
  view->leaders.map_version = 3;
  view->leaders.map_cells = 4;
  view->leaders.cells = view->leaders.count = 2;
  view->leaders.rows[0] = {0, 0, {1, first}};
  view->leaders.rows[1] = {0, 1, {1, second}};
  return view;
}

TEST(LeadersReport, CountsTheCellsThatEachLeads) {
  const auto one = view_of(1, 2), other = view_of(1, 2);
  other->leaders.rows[0] = {0, 7, {}};  // it knows no leader there
  EXPECT_EQ(leaders_text(std::array<const peer::PeerView*, 1>{one.get()}),
            "scene by 1:1, map 3 has 4 cells; cells by 1:1: 1, by 1:2: 1");
  EXPECT_EQ(leaders_text(std::array<const peer::PeerView*, 2>{one.get(), other.get()}),
            "scene by 1:1, map 3 has 4 cells; cells by 1:1: 1, by 1:2: 1, by nobody: 1");
}

TEST(LeadersReport, ReportsTwoLeadersOfTheScene) {
  const auto one = view_of(1, 1), other = view_of(1, 1);
  other->leaders.scene = {1, 9};
  EXPECT_EQ(leaders_text(std::array<const peer::PeerView*, 2>{one.get(), other.get()}),
            "scene by 1:1 and 1:9, map 3 has 4 cells; cells by 1:1: 2");
}

TEST(LeadersReport, IsNothingWhereTheSceneHasNoLeaders) {
  const auto view = std::make_unique<peer::PeerView>();
  EXPECT_EQ(leaders_text(std::array<const peer::PeerView*, 1>{view.get()}), "");
  EXPECT_EQ(leaders_json(view->leaders), "");
}

TEST(LeadersReport, JsonListsEachCell) {
  const auto view = view_of(2, 2);
  view->leaders.rows[1].leader = {};
  view->leaders.led = view->leaders.leaderless = 1;
  EXPECT_EQ(leaders_json(view->leaders),
            R"(,"leaders":{"scene":"1:1","map_version":3,"map_cells":4,"cells":2,"led":1,)"
            R"("leaderless":1,"of":[{"cell":"0,0","leader":"1:2"},{"cell":"0,1","leader":null}]})");
}

TEST(LeadersReport, ReportsTheCellsOfFollowedBeacons) {
  const auto one = view_of(1, 1), other = view_of(1, 1);
  one->leaders.followed_count = 2;
  one->leaders.followed[0] = {{'g', 'a', 't', 'e'}, true, 7, -1, 12};
  one->leaders.followed[1] = {{'f', 'e', 'r', 'r', 'y'}, false, 3, 3, 0};
  EXPECT_THAT(leaders_text(std::array<const peer::PeerView*, 2>{one.get(), other.get()}),
              testing::EndsWith("; beacon ferry nowhere; beacon gate in cell 7,-1"));
  EXPECT_THAT(leaders_json(one->leaders),
              testing::EndsWith(R"(,"followed":[{"beacon":"gate","cell":"7,-1","group":12},)"
                                R"({"beacon":"ferry","cell":null,"group":0}]})"));
}

}  // namespace
}  // namespace reckon::tools
