// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Programs own the bodies of a scene, give them to each other, and move them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <thread>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/tests/integration/federates.hpp"
#include "reckon/tests/integration/owners_exercise.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using peer::BodyHandle;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr BodyHandle kCube{0};

struct BodyCalls {
  std::vector<std::uint32_t> acquired, lost, refused;
  std::vector<aoim::PeerId> asked;
};

// Programs of one scene with cubes, a pass each millisecond.
class BodyPrograms {
 public:
  explicit BodyPrograms(std::size_t count, std::size_t cubes = 1,
                        const peer::ImpairmentLaw& law = {}, std::uint64_t seed = 1)
      : federates_(count, law, seed), calls_(count) {
    for (std::size_t i = 0; i < count; ++i) {
      federates_.join(scene_of(cubes_scene(cubes)), static_cast<std::uint32_t>(i + 1));
      note(bodies(i), calls_[i]);
    }
    run(3s);
  }
  static void note(peer::FederateBodies& bodies, BodyCalls& calls) {
    bodies.on_acquired([&calls](BodyHandle body) { calls.acquired.push_back(body.number); });
    bodies.on_lost([&calls](BodyHandle body) { calls.lost.push_back(body.number); });
    bodies.on_refused([&calls](BodyHandle body) { calls.refused.push_back(body.number); });
    bodies.on_release_requested(
        [&calls](BodyHandle, const aoim::PeerId& asker) { calls.asked.push_back(asker); });
  }
  void run(nanoseconds span) {
    federates_.run(
        span, 1ms, [] {}, [] {});
  }
  // Steps until it holds, for at most `span`. @return whether it holds
  bool run_until(nanoseconds span, auto&& holds) {
    for (const nanoseconds end = federates_.now() + span; federates_.now() < end && !holds();)
      run(1ms);
    return holds();
  }
  [[nodiscard]] peer::Federate& operator[](std::size_t i) { return federates_[i]; }
  [[nodiscard]] peer::FederateBodies& bodies(std::size_t i) { return federates_[i].bodies(); }
  [[nodiscard]] BodyCalls& calls(std::size_t i) { return calls_[i]; }
  [[nodiscard]] Federates& federates() { return federates_; }
  void separate(std::size_t one, std::size_t other) {
    federates_.impair(one, other, Federates::delayed({}, 1.0));
    federates_.impair(other, one, Federates::delayed({}, 1.0));
  }

 private:
  Federates federates_;
  std::vector<BodyCalls> calls_;
};

TEST(FederateBodies, PassToTheFederateThatAcquires) {
  BodyPrograms programs(3, 2);
  EXPECT_EQ(programs.calls(0).acquired, (std::vector<std::uint32_t>{0, 1}));
  const BodyHandle body = programs.bodies(2).find("cube1");
  EXPECT_EQ(programs.bodies(2).name_of(body), "cube1");
  programs.bodies(2).acquire(body);
  programs.run(100ms);
  EXPECT_TRUE(programs.bodies(2).owns(body));
  EXPECT_FALSE(programs.bodies(0).owns(body));
  EXPECT_EQ(programs.calls(2).acquired, std::vector<std::uint32_t>{1});
  EXPECT_EQ(programs.calls(0).lost, std::vector<std::uint32_t>{1});
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(programs.bodies(i).owner_of(body), (aoim::PeerId{1, 3})) << i;
  EXPECT_TRUE(programs.bodies(0).owns(kCube));
}

TEST(FederateBodies, KeeperIsAskedForRelease) {
  BodyPrograms programs(2);
  programs.bodies(0).acquire(kCube);
  programs.run(10ms);
  programs.bodies(1).acquire(kCube);
  programs.run(3s);
  EXPECT_EQ(programs.calls(0).asked, (std::vector<aoim::PeerId>{{1, 2}}));
  EXPECT_TRUE(programs.calls(1).acquired.empty());
  programs.bodies(0).divest(kCube);
  programs.run(100ms);
  EXPECT_EQ(programs.calls(1).acquired, std::vector<std::uint32_t>{0});
  EXPECT_EQ(programs.calls(0).lost, std::vector<std::uint32_t>{0});
}

TEST(FederateBodies, OwnerMovesThem) {
  BodyPrograms programs(2);
  haptics::ObjectMotion there;
  there.position = {0.3, 0.1, 2.0};
  ASSERT_TRUE(programs.bodies(0).place(kCube, there));
  programs.run(10ms);
  EXPECT_NEAR(programs.bodies(0).motion_of(kCube).position.x(), 0.3, 1e-9);
  // 0.025 N s on 50 g
  ASSERT_TRUE(programs.bodies(0).push(kCube, {0.025, 0, 0}, {0.3, 0.1, 2.0}));
  programs.run(200ms);
  EXPECT_NEAR(programs.bodies(0).motion_of(kCube).velocity.x(), 0.5, 0.01);
  EXPECT_NEAR(
      (programs.bodies(0).motion_of(kCube).position - programs.bodies(1).motion_of(kCube).position)
          .norm(),
      0.0, 0.005);
  EXPECT_GT(programs.bodies(1).motion_of(kCube).position.x(), 0.38);
}

TEST(FederateBodies, OwnerWakesThem) {
  BodyPrograms programs(1);
  const auto is_awake = [&] { return programs[0].peer().bodies()->states()[0].awake; };
  ASSERT_FALSE(is_awake());
  ASSERT_TRUE(programs.bodies(0).wake(kCube));
  programs.run(10ms);
  EXPECT_TRUE(is_awake());
}

TEST(FederateBodies, OthersDoNotMoveThem) {
  BodyPrograms programs(2);
  const Eigen::Vector3d before = programs.bodies(1).motion_of(kCube).position;
  haptics::ObjectMotion there;
  there.position = {0.3, 0.1, 2.0};
  EXPECT_FALSE(programs.bodies(1).place(kCube, there));
  EXPECT_FALSE(programs.bodies(1).push(kCube, {1, 0, 0}, before));
  EXPECT_FALSE(programs.bodies(1).wake(kCube));
  programs.run(100ms);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((programs.bodies(i).motion_of(kCube).position - before).norm(), 1e-3) << i;
}

// The order is on its way to the loop when the loop gives the body away.
TEST(FederateBodies, OvertakenOrderIsReported) {
  BodyPrograms programs(2);
  programs.bodies(1).acquire(kCube);
  const bool is_given = programs.run_until(1s, [&] {
    return !programs.bodies(0).push(kCube, {1e-6, 0, 0}, {0, 0, 0});
  });
  EXPECT_TRUE(is_given);
  EXPECT_EQ(programs.calls(0).refused, std::vector<std::uint32_t>{0});
}

TEST(FederateBodies, RestUntilTheProgramGoesAlone) {
  BodyPrograms programs(2, 2);
  programs.bodies(1).acquire(kCube);
  programs.run(100ms);
  ASSERT_TRUE(programs.bodies(1).owns(kCube));
  programs.separate(0, 1);
  programs.run(4s);
  EXPECT_EQ(programs.calls(1).lost, std::vector<std::uint32_t>{0});
  EXPECT_EQ(programs.bodies(1).owner_of(kCube), (aoim::PeerId{1, 2}));
  programs[1].go_alone();
  programs.run(10ms);
  EXPECT_TRUE(programs.bodies(1).owns({0}));
  EXPECT_TRUE(programs.bodies(1).owns({1}));
}

TEST(FederateBodies, LeaverGivesThemAway) {
  BodyPrograms programs(2, 3);
  programs[0].begin_resign();
  EXPECT_TRUE(programs.run_until(1s, [&] { return programs[0].can_resign(); }));
  programs[0].resign();
  programs.run(100ms);
  EXPECT_EQ(programs.calls(1).acquired, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(programs.bodies(1).owns({2}));
}

// The remaining voter knows that it decides alone.
TEST(FederateBodies, LeaverIsForgottenAtLoss) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    BodyPrograms programs(2, 1, Federates::delayed(1ms, 0.3), seed);
    programs.run(nanoseconds(7ms) * seed);
    programs[0].begin_resign();
    EXPECT_TRUE(programs.run_until(1500ms, [&] { return programs[0].can_resign(); })) << seed;
    programs[0].resign();
    programs.run(3s);
    EXPECT_TRUE(programs.bodies(1).owns(kCube)) << seed;
  }
}

TEST(FederateBodies, LonelyLeaverDoesNotWait) {
  BodyPrograms programs(1);
  EXPECT_FALSE(programs[0].can_resign());
  programs[0].begin_resign();
  programs.run(1ms);
  EXPECT_TRUE(programs[0].can_resign());
}

TEST(FederateBodies, WrongNamesAreErrors) {
  BodyPrograms programs(1);
  const peer::FederateBodies& bodies = programs.bodies(0);
  EXPECT_THAT([&] { static_cast<void>(bodies.find("floor")); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no body 'floor'")));
  EXPECT_THAT([&] { static_cast<void>(bodies.owns({1})); },
              ThrowsMessage<std::logic_error>(HasSubstr("number 1 is no body")));
}

TEST(FederateBodies, ViewersCannotAcquire) {
  Federates federates(1, {});
  federates.join(scene_of(cubes_scene(1)));
  EXPECT_THAT([&] { federates[0].bodies().acquire(kCube); },
              ThrowsMessage<std::logic_error>(HasSubstr("scene_peer")));
}

TEST(FederateBodies, InteropSceneKeepsItsOwner) {
  Federates federates(1, {});
  federates.join(scene_of(cubes_scene(1, 0.02, "interop = true")), 1);
  EXPECT_THAT([&] { federates[0].bodies().acquire(kCube); },
              ThrowsMessage<std::logic_error>(HasSubstr("interop")));
  EXPECT_FALSE(federates[0].bodies().wake(kCube));
}

TEST(FederateBodies, AllocateNothingInAPass) {
  BodyPrograms programs(2, 4);
  const auto drive = [&] {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d at = programs.bodies(0).motion_of({i}).position;
      static_cast<void>(programs.bodies(0).push({i}, {0, 1e-5, 0}, at));
    }
  };
  const auto run = [&](nanoseconds span) { programs.federates().run(span, 1ms, drive, [] {}); };
  run(1s);
  const AllocationGuard guard;
  run(1s);
  EXPECT_EQ(guard.count(), 0u);
}

// Threads, over lo.
TEST(FederateBodiesOnLo, PassWhenTheirOwnerResigns) {
  peer::FederateOptions options;
  options.scene = scene_of(cubes_scene(3));
  options.scene->network.group =
      peer::IpEndpoint::v4(0xefc04e00u + 96, static_cast<std::uint16_t>(20000 + getpid() % 20000));
  options.interface = "lo";
  options.loops = peer::FederateLoops::threads;
  options.scene_peer = 1;
  auto one = std::make_unique<peer::Federate>(options);
  options.scene_peer = 2;
  options.application = std::uint16_t{2};
  std::optional<peer::Federate> two;
  BodyCalls calls;
  const auto until = [&](auto&& holds) {
    for (int i = 0; i < 1000 && !holds(); ++i) {
      std::this_thread::sleep_for(10ms);
      if (one) one->step();
      if (two) two->step();
    }
    return holds();
  };
  ASSERT_TRUE(until([&] { return one->bodies().owns(kCube); }));
  BodyPrograms::note(two.emplace(options).bodies(), calls);
  ASSERT_TRUE(until([&] { return two->bodies().owner_of(kCube).site != 0; }));
  two->bodies().acquire(kCube);
  ASSERT_TRUE(until([&] { return calls.acquired.size() == 1; }));
  EXPECT_TRUE(two->bodies().wake(kCube));
  const nanoseconds begun = two->now();
  one.reset();
  EXPECT_LT(two->now() - begun, 1s);
  EXPECT_TRUE(until([&] { return calls.acquired.size() == 3; }));
  EXPECT_LT(two->now() - begun, 1200ms) << "adopted, not given";
  EXPECT_TRUE(calls.refused.empty());
}

}  // namespace
}  // namespace reckon::test
