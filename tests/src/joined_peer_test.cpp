// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/joined_peer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "reckon/peer/federate.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/manual_link.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using testing::HasSubstr;

// Counts the passes of the model loop.
class PassCount final : public ModelGuest {
 public:
  int passes = 0;
  void begin_pass(ModelLoop&) noexcept override { ++passes; }
  void receive(const pdu::PduHeader&, std::span<const std::byte>,
               const InteractionSender&) noexcept override {}
  void end_pass(ModelLoop&) noexcept override {}
};

// A hand that does not move; it counts the writes of the servo.
class CountingHand final : public haptics::HapticDevice {
 public:
  std::atomic<int> writes{0};

  [[nodiscard]] haptics::DeviceLimits limits() const noexcept override {
    haptics::DeviceLimits limits;
    limits.max_force = limits.damping = 1;
    return limits;
  }
  [[nodiscard]] haptics::DeviceSample read(nanoseconds) noexcept override {
    haptics::DeviceSample sample;
    sample.ok = true;
    return sample;
  }
  void write(const Eigen::Vector3d&, nanoseconds) noexcept override { ++writes; }
};

FederateOptions on_loopback(std::uint8_t group) {
  FederateOptions options;
  options.scene = dis_exercise(1);
  options.scene->network.group = test::group(group);
  options.interface = "lo";
  return options;
}

TEST(JoinedPeer, LeavesStepsToTheCallerByHand) {
  ManualClock clock(1s, 1h);
  test::ManualLink link;
  FederateOptions options;
  options.loops = FederateLoops::by_hand;
  Federate federate(options, link, clock, 1);
  clock.advance(1s);
  federate.step();
  EXPECT_EQ(federate.peer().views().read().time, 0ns);
  EXPECT_FALSE(federate.peer().views().update()) << "step() made a pass of the model loop";
  federate.peer().model_step(clock.now(), clock.utc_now());
  EXPECT_TRUE(federate.peer().views().update());
}

TEST(JoinedPeer, ReportsTheInterfaceOnlyOfItsOwnLink) {
  JoinedPeer joined(on_loopback(60));
  ASSERT_FALSE(joined.link_report().empty());
  EXPECT_THAT(joined.link_report().front(), HasSubstr("lo"));
  ManualClock clock(1s, 1h);
  test::ManualLink link;
  EXPECT_TRUE(JoinedPeer({}, link, clock, 1).link_report().empty());
}

TEST(JoinedPeer, SiteDefaultsToTheHost) {
  FederateOptions options = on_loopback(61);
  options.application = 7;
  const JoinedPeer by_host(options);
  EXPECT_NE(by_host.peer().own_id().site, 0);
  EXPECT_EQ(by_host.peer().own_id().application, 7);
  options.site = 4711;
  EXPECT_EQ(JoinedPeer(options).peer().own_id().site, 4711);
}

TEST(JoinedPeer, TakesTheNextFreeApplicationOfThisHost) {
  JoinedPeer first(on_loopback(63)), second(on_loopback(63));
  EXPECT_EQ(first.peer().own_id().application, 1);
  EXPECT_EQ(first.peer().notices().front(), nullptr);
  EXPECT_EQ(second.peer().own_id().application, 2);
  const Notice* notice = second.peer().notices().front();
  ASSERT_NE(notice, nullptr);
  EXPECT_THAT(notice->text.data(), HasSubstr("this is application 2 of site"));
  first.resign();
  EXPECT_EQ(JoinedPeer(on_loopback(63)).peer().own_id().application, 1)
      << "who has resigned keeps a number";
}

TEST(JoinedPeer, RefusesAnApplicationInUseOnThisHost) {
  FederateOptions options = on_loopback(64);
  options.application = 7;
  const JoinedPeer first(options);
  try {
    const JoinedPeer second(options);
    FAIL() << "two programs have one ID";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("application 7 of site"));
  }
  options.site = 4711;  // another ID
  EXPECT_EQ(JoinedPeer(options).peer().own_id().application, 7);
}

// Peers resolve conflicting IDs among themselves, so no application number is refused.
TEST(JoinedPeer, HoldsNoApplicationInASceneOfPeers) {
  FederateOptions options = on_loopback(65);
  options.scene->network.interop = false;
  options.scene->aoim = {};
  options.application = 7;
  const JoinedPeer first(options);
  EXPECT_EQ(JoinedPeer(options).peer().own_id().application, 7);
}

TEST(JoinedPeer, GuestSeesEachPassUntilThePeerResigns) {
  ManualClock clock(1s, 1h);
  test::ManualLink link;
  PassCount guest;
  JoinedPeer joined({}, link, clock, 1, &guest);
  for (int i = 0; i < 3; ++i) joined.pass();
  EXPECT_EQ(guest.passes, 3);
  joined.resign();
  joined.pass();
  EXPECT_EQ(guest.passes, 3);
}

// A body, and no number in an ID that others have.
FederateOptions with_a_body(std::uint8_t group) {
  FederateOptions options = on_loopback(group);
  options.scene->network.interop = false;
  options.scene->aoim = {};
  haptics::SceneObject cube;
  cube.name = "cube";
  cube.shape = haptics::BoxShape{{0.02, 0.02, 0.02}};
  cube.matter.mass = 0.05;
  options.scene->scene.objects.push_back(cube);
  return options;
}

bool owns_after_a_pass(JoinedPeer& joined) {
  joined.pass();
  return joined.peer().model().ownership().owns(0);
}

TEST(JoinedPeer, OwnsBodiesAtOnceIfNobodyAnswers) {
  FederateOptions options = with_a_body(66);
  options.deal = [](std::uint32_t) { return std::vector<PeerDevice>(); };
  JoinedPeer first(options);
  EXPECT_EQ(first.options().scene_peer, 1u);
  EXPECT_TRUE(owns_after_a_pass(first));
  options.deal = nullptr;
  options.scene_peer = 1;
  JoinedPeer unasked(options);
  EXPECT_FALSE(owns_after_a_pass(unasked)) << "another peer may own it";
}

// The present peer may own the bodies of a first peer that has left.
TEST(JoinedPeer, OwnsNoBodiesAtOnceIfOneAnswers) {
  FederateOptions options = with_a_body(67);
  options.loops = FederateLoops::threads;
  options.scene_peer = 2;
  JoinedPeer present(options);
  present.run();
  options.loops = FederateLoops::in_step;
  options.deal = [](std::uint32_t) { return std::vector<PeerDevice>(); };
  JoinedPeer late(options);
  EXPECT_EQ(late.options().scene_peer, 1u);
  EXPECT_FALSE(owns_after_a_pass(late));
}

TEST(JoinedPeer, OwnsBodiesAtOnceOnACallersLink) {
  ManualClock clock(1s, 1h);
  test::ManualLink link;
  FederateOptions options = with_a_body(68);
  options.scene_peer = 1;
  JoinedPeer joined(options, link, clock, 1);
  EXPECT_TRUE(owns_after_a_pass(joined));
}

TEST(JoinedPeer, OneServoThreadServesSeveralPeersInTurn) {
  const SteadyClock clock;
  ServoThread servo(clock);
  CountingHand left, right;
  FederateOptions options = on_loopback(62);
  options.loops = FederateLoops::threads;
  options.servo = &servo;
  options.devices = {{.device = &left, .marking = {}}};
  JoinedPeer one(options);
  options.application = 2;
  options.devices = {{.device = &right, .marking = {}}};
  JoinedPeer two(options);
  EXPECT_EQ(one.threads(), nullptr);
  for (int life = 0; life < 2; ++life) {
    const int before = left.writes, were = right.writes;
    one.run();
    two.run();
    EXPECT_EQ(one.threads()->servo(), &servo);
    EXPECT_EQ(two.threads()->servo(), &servo);
    while (left.writes == before || right.writes == were) std::this_thread::yield();
    one.stop_loops();
    two.stop_loops();
    EXPECT_GE(one.threads()->servo_duty().steps(), 1u);
  }
}

}  // namespace
}  // namespace reckon::peer
