// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The information of a tab about a scene and its peers, and its rights to push.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/shared_bodies.hpp"
#include "reckon/tests/tools/support/driven_trucks.hpp"
#include "reckon/tests/tools/support/stage_tabs.hpp"
#include "reckon/tools/viewer/own_hands.hpp"
#include "reckon/tools/viewer/view_stage.hpp"

namespace reckon::tools::view_stage_scenes_test {
namespace {

using nlohmann::json;
using tabs::kTick;
using tabs::LiveTrucks;
using tabs::Tab;
using trucks::nanoseconds;
using trucks::seconds;

peer::SceneFile scene_of(const char* text) { return peer::parse_scene_file(text, "scene.toml"); }

TEST(ViewStage, ListsTheMembersOfAContactGroup) {
  // Trucks are received in group 5: the first one after the cells' groups.
  const peer::SceneFile scene = scene_of("[aoim]\npool = 4\n[[aoim.tier]]\nto = \"touch\"\n");
  StageOptions options;
  options.scene = &scene;
  LiveTrucks live(options);
  Tab tab(live.stage, false);
  live.run(seconds(3), {&tab});
  const json groups = tab.last("groups")["groups"];
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0], json::parse(R"({"tier":"contact","group":5,"slots":[0,1,2]})"));
  EXPECT_FALSE(tab.last("cells").is_null()) << "cells are told as well";
  tab.ask(2, 0.1);  // before any of them was named
  live.run(seconds(1), {&tab});
  EXPECT_EQ(tab.last("groups")["groups"][0]["slots"].size(), 3U);

  LiveTrucks plain;
  Tab other(plain.stage, false);
  plain.run(seconds(3), {&other});
  EXPECT_TRUE(other.last("groups").is_null()) << "nothing is known without a scene";
}

TEST(ViewStage, SendsTheThresholdsOfSceneAndFollowedEntity) {
  const peer::SceneFile scene = scene_of(
      "[[operator]]\npassive = true\n[dead_reckoning]\nposition = \"1 mm\"\n"
      "[[entity]]\nmarking = \"TRUCK\"\ntype = \"1.1\"\ndead_reckoning = {position = \"3 m\"}\n");
  StageOptions options;
  options.scene = &scene;
  LiveTrucks live(options);
  Tab tab(live.stage, false);
  live.run(seconds(2), {&tab});
  EXPECT_EQ(tab.last("numbers")["error"]["thresholds_m"], json({0.001, 3.0}));
  EXPECT_FALSE(tab.last("numbers")["error"].contains("followed_m"));
  tab.ask(10, std::uint16_t{1});
  live.run(seconds(1), {&tab});
  EXPECT_EQ(tab.last("numbers")["error"]["followed_m"], 3.0);
}

TEST(ViewStage, SendsTheReceptionAmongPeers) {
  LiveTrucks live;
  Tab tab(live.stage, false);
  live.run(seconds(1), {&tab});
  EXPECT_FALSE(tab.last("numbers").contains("peers"));
  live.stage.take_reception({live.now, 0.2, 0.1, 0.13});
  live.run(seconds(1), {&tab});
  EXPECT_EQ(tab.last("numbers")["peers"],
            json::parse(R"({"delay_ms":{"median":100.0,"p95":130.0},"lost_share":0.2})"));
  live.stage.take_reception({live.now, {}, {}, {}});
  live.run(seconds(1), {&tab});
  EXPECT_TRUE(tab.last("numbers")["peers"].empty()) << "nothing arrives";
  tab.ask(2, 1.5);
  live.run(seconds(1), {&tab});
  EXPECT_EQ(tab.last("numbers")["peers"]["lost_share"], 0.2);
}

/// A state of the first body of a scene.
peer::SourceDatagram body_state(const peer::SceneFile& scene, nanoseconds time,
                                std::vector<std::byte>& octets) {
  const deadreckon::LocalFrame frame(scene.origin.latitude, scene.origin.longitude,
                                     scene.origin.height);
  haptics::BodyState body;
  body.position = {0.5, -0.25, 0.125};
  const peer::EntityTruth truth = peer::truth_of(body, time);
  pdu::EntityState state;
  state.entity_id = peer::body_id(0);
  const Eigen::Vector3d place = frame.world_from_scene(truth.position);
  state.location = {place.x(), place.y(), place.z()};
  const auto turn = deadreckon::euler_from_quaternion(frame.world_from_scene(truth.orientation));
  state.orientation = {static_cast<float>(turn.psi), static_cast<float>(turn.theta),
                       static_cast<float>(turn.phi)};
  state.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::static_;
  octets.resize(wire_size(state));
  EXPECT_GT(encode(state, octets), 0U);
  peer::SourceDatagram datagram;
  datagram.time = time;
  datagram.bytes = octets;
  return datagram;
}

TEST(ViewStage, ShowsABodyWhereItsOwnerHasIt) {
  const peer::SceneFile scene = scene_of(
      "[[object]]\nname = \"cube\"\nbox = \"40 40 40 mm\"\nposition = [0, 0, 0.02]\n"
      "mass = \"50 g\"\n[[operator]]\npassive = true\n[[device]]\npeer = 1\n");
  StageOptions options;
  options.scene = &scene;
  LiveTrucks live(options);
  Tab tab(live.stage, false);
  std::vector<std::byte> octets;
  const auto shown = [&] {
    (void)live.stage.take(body_state(scene, live.now, octets));
    live.run(seconds(1), {&tab});
    const std::string& picture = tab.pictures.back();
    Eigen::Vector3f place;
    std::int16_t w = 0;
    std::memcpy(place.data(), picture.data() + picture.size() - kBodyOctets, 12);
    std::memcpy(&w, picture.data() + picture.size() - kBodyOctets + 12, 2);
    EXPECT_EQ(std::abs(w), 32767) << "not turned";
    return place;
  };
  const Eigen::Vector3f received(0.5F, -0.25F, 0.125F), own(0.0F, 0.0F, 1.0F);
  EXPECT_LT((shown() - received).norm(), 1e-6) << "by a listener";
  OwnHands hands{peer::HandModel{}};
  haptics::BodyState simulated;
  simulated.position.z() = 1.0;
  for (const bool carried : {true, false}) {
    simulated.carried = carried;
    hands.take_bodies(std::span(&simulated, 1));
    HandFrame frame = hands.frame({}, false);
    frame.time = live.now;
    live.stage.take_hands(std::move(frame));
    EXPECT_LT((shown() - (carried ? received : own)).norm(), 1e-6) << carried;
  }
}

TEST(ViewStage, ReportsOwnersOfBodiesWhenTheyChange) {
  LiveTrucks live;
  Tab tab(live.stage, false);
  peer::PeerView view;
  view.body_owner_count = 2;
  view.body_owners[0] = {{1, 2}, true, 77, peer::version_of(1, 3), 3, peer::OwnerChange::granted};
  OwnHands hands{peer::HandModel{}};
  const auto show = [&] {
    hands.take_owners(std::span(view.body_owners).first(view.body_owner_count), view.bodies_rest);
    HandFrame frame = hands.frame({}, false);
    frame.time = live.now;
    live.stage.take_hands(std::move(frame));
    live.run(seconds(1), {&tab});
  };
  show();
  const json first = tab.last("bodies");
  EXPECT_EQ(first["rests"], false);
  EXPECT_EQ(first["owners"][0], json::parse(R"({"owner": "1:2", "ours": true, "version": "1.3",
                                                "changes": 3, "cause": "granted"})"));
  EXPECT_FALSE(first["owners"][1].contains("owner")) << "none is known";
  const auto count = [&] {
    return std::ranges::count_if(tab.texts,
                                 [](const json& one) { return one["type"] == "bodies"; });
  };
  show();
  EXPECT_EQ(count(), 1) << "nothing has changed";
  view.bodies_rest = true;
  show();
  EXPECT_EQ(count(), 2);
  EXPECT_EQ(tab.last("bodies")["rests"], true);
}

/// Records the requests of pages.
class NotedControls final : public ViewerControls {
 public:
  HandAnswer take_hand(Watcher watcher) override {
    owner = watcher;
    return {0, "yours"};
  }
  void give_hand(Watcher watcher) override {
    if (owner == watcher) owner.reset();
  }
  void point(Watcher, const PointerRequest& request, nanoseconds) override {
    pointed.push_back(request);
  }
  std::string set_network(const NetworkRequest&) override {
    ++networks;
    return "the network is as it was";
  }
  std::string go_alone() override {
    ++alone;
    return "the bodies go on";
  }
  std::optional<Watcher> owner;
  std::vector<PointerRequest> pointed;
  int networks = 0, alone = 0;
};

TEST(ViewStage, OnlyTabsWithThePasswordMayPush) {
  NotedControls controls;
  StageOptions options;
  options.controls = &controls;
  LiveTrucks live(options);
  Tab guest(live.stage, false), owner(live.stage, true);
  const auto point = [](Tab& tab) { tab.ask(6, std::uint16_t{0}, 1.F, 2.F, 3.F, std::uint8_t{1}); };
  guest.ask(8);
  point(guest);
  guest.ask(7, 100.F, 0.F, 0.F, std::uint8_t{0});
  guest.ask(11);
  live.run(kTick, {&guest, &owner});
  EXPECT_FALSE(controls.owner.has_value());
  EXPECT_TRUE(controls.pointed.empty());
  EXPECT_EQ(controls.networks, 0);
  EXPECT_EQ(controls.alone, 0);
  EXPECT_TRUE(guest.last("hand")["index"].is_null());

  point(owner);
  EXPECT_TRUE(controls.pointed.empty()) << "it has no hand yet";
  owner.ask(8);
  point(owner);
  owner.ask(7, 100.F, 0.F, 0.F, std::uint8_t{0});
  live.run(kTick, {&guest, &owner});
  EXPECT_EQ(owner.texts[0]["may_push"], true);
  EXPECT_EQ(owner.last("hand")["index"], 0);
  EXPECT_EQ(controls.pointed.size(), 1U);
  EXPECT_EQ(guest.last("note")["text"], "the network is as it was");
  owner.ask(11);
  EXPECT_EQ(controls.alone, 1);
  live.stage.leave(owner.watcher());
  EXPECT_FALSE(controls.owner.has_value()) << "who goes gives its hand back";
}

}  // namespace
}  // namespace reckon::tools::view_stage_scenes_test
