// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Ten thousand entities of a plain DIS simulation, received by one peer: all are reported, and
// counted.
#include "reckon/tools/exercise/entity_events.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/exercise/live_table.hpp"

namespace reckon::tools {
namespace {

using namespace test;

constexpr std::size_t kMany = 10'000;
constexpr std::uint32_t kDeactivated = 1U << 23;

/// One peer, without hands, that receives a crowd on a line through its origin.
class Crowd {
 public:
  Crowd() : scene_(scene_of(kScene)), world_(1) {
    peer::Peer& peer = world_.start(0, scene_);
    peer.model().set_guest(&events_);
    world_.run(10);
  }
  /// Sends Entity States of entities first .. last, as fast as one sender may.
  void say(std::size_t first, std::size_t last, std::uint32_t appearance = 0) {
    for (std::size_t i = first; i <= last; ++i) {
      pdu::EntityState state;
      state.header.exercise_id = scene_.network.exercise;
      state.entity_id = {9, 9, static_cast<std::uint16_t>(i)};
      state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 1, 0, 0};
      state.appearance = appearance;
      const Eigen::Vector3d at =
          world_.peer(0).frame().world_from_scene({0.01 * static_cast<double>(i), 0, 0});
      state.location = {at.x(), at.y(), at.z()};
      state.marking.set("E" + std::to_string(i));
      world_.say(state, scene_);
      if (i % 200 == 0) world_.run(15);
    }
    world_.run(100);
  }
  /// Events since the last call.
  std::vector<nlohmann::json> events() {
    const CapturedStream out;
    events_.report_rest(world_.peer(0).model(), 1.0, out.file());
    std::vector<nlohmann::json> lines;
    std::istringstream text(out.text());
    for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }
  [[nodiscard]] const peer::PeerView& view() { return world_.view(0); }
  InProcess& world() { return world_; }
  EntityEvents& table() { return events_; }
  [[nodiscard]] const peer::SceneFile& scene() const { return scene_; }

 private:
  static constexpr std::string_view kScene = R"(
[scene]
name = "crowd"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}
[aoim]
cell = "1 km"
radius = "1 km"
[[operator]]
passive = true
[[device]]
peer = 2
)";
  peer::SceneFile scene_;
  EntityEvents events_{scene_.network.entities};
  InProcess world_;
};

std::map<std::string, std::size_t> by_kind(const std::vector<nlohmann::json>& lines) {
  std::map<std::string, std::size_t> counts;
  for (const auto& line : lines) ++counts[line["event"].get<std::string>()];
  return counts;
}

TEST(EntityEvents, ReportAllOfTenThousandWithCorrectLists) {
  Crowd crowd;
  crowd.say(1, kMany);
  const auto come = crowd.events();
  EXPECT_EQ(by_kind(come), (std::map<std::string, std::size_t>{{"appeared", kMany}}));
  std::set<std::string> ids;
  for (const auto& line : come) ids.insert(line["id"].get<std::string>());
  EXPECT_EQ(ids.size(), kMany);
  EXPECT_EQ(crowd.table().present(), kMany);

  // The snapshot counts all of them and shows the nearest, in the order of their IDs.
  const peer::PeerView& view = crowd.view();
  EXPECT_EQ(view.entities, kMany);
  ASSERT_EQ(view.count, peer::PeerView::kRows);
  for (std::size_t i = 0; i < view.count; ++i) EXPECT_EQ(view.rows[i].id.entity, i + 1);

  // Every tenth is removed; the report has its name and its number of updates.
  std::size_t gone = 0;
  for (std::size_t i = 10; i <= kMany; i += 10, ++gone) crowd.say(i, i, kDeactivated);
  const auto went = crowd.events();
  EXPECT_EQ(by_kind(went)["gone"], gone);
  EXPECT_EQ(went.front()["marking"], "E10");
  EXPECT_EQ(went.front()["updates"], 1);
  crowd.world().run(100);
  EXPECT_EQ(crowd.view().entities, kMany - gone);
  EXPECT_EQ(crowd.table().present(), kMany - gone);
}

TEST(EntityEvents, ReportAnEntityThatIsRemovedAndReturns) {
  Crowd crowd;
  crowd.say(1, 1);
  EXPECT_EQ(by_kind(crowd.events())["appeared"], 1U);
  crowd.say(1, 1, kDeactivated);
  crowd.say(1, 1);
  const auto lines = crowd.events();
  EXPECT_EQ(by_kind(lines), (std::map<std::string, std::size_t>{{"appeared", 1}, {"gone", 1}}));
  EXPECT_EQ(lines.front()["event"], "gone");
}

}  // namespace
}  // namespace reckon::tools
