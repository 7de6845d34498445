// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers whose scene gives contacts groups of their own ([[aoim.tier]] to = "touch").
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tests/support/tier_rows.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::test {
namespace {

constexpr double kThreshold = 5e-3;  // [m], of this scene; force updates from 50 mN on
constexpr double kFastest = 0.2;     // [m/s], upper limit of the hands here

// Two hands that meet on a wall, and one 100 m away that receives their cell.
std::string plaza(bool touch_tier) {
  std::string aoim = "[dead_reckoning]\nposition = \"5 mm\"\n[aoim]\nscheme = \"hexagonal\"\n";
  aoim += "cell = \"50 m\"\nradius = \"150 m\"\npool = 64\n";
  if (touch_tier) aoim += kTouchTier;
  return with(kTwoHandsOnAWall, "[aoim]\npool = 16\n", aoim) +
         "\n[[operator]]\npassive = true\nposition = [100.0, 0.0, 0.05]\n"
         "stiffness = \"150 N/m\"\n";
}

struct Hearing {
  std::uint64_t datagrams = 0;
  double worst = 0.0;  // [m], error of the moving hand as shown to it
};

// What the third peer receives in ten seconds in which the others touch.
class Plaza {
 public:
  explicit Plaza(bool touch_tier, std::uint64_t seed = 1, double loss = 0.0)
      : scene_(scene_of(plaza(touch_tier))), world_(3, seed) {
    peer::ImpairmentLaw law;
    law.loss = loss;
    world_.network().impair(law);
    for (std::size_t link = 0; link < 3; ++link) world_.start(link, scene_);
    world_.run(3000);
  }
  Hearing hear(std::size_t ms) {
    Hearing hearing;
    const std::uint64_t before = world_.count(2, "datagrams_in");
    for (std::size_t i = 0; i < ms; ++i) {
      world_.run(1);
      if (world_.steps() % 2 == 0) hearing.worst = std::max(hearing.worst, error(2, 0));
    }
    hearing.datagrams = world_.count(2, "datagrams_in") - before;
    return hearing;
  }
  /// Error of another's hand as one peer shows it [m], including its motion during the delay.
  double error(std::size_t watcher, std::size_t owner) {
    const peer::ModelLoop& model = world_.peer(owner).model();
    const peer::RemoteEntity* row = world_.peer(watcher).model().remote().find(model.own_id());
    if (row == nullptr) return 1e9;
    const nanoseconds now = world_.clock().now();
    return (row->predicted(now).position - model.owned().find(1)->truth_at(now).position).norm();
  }
  [[nodiscard]] std::uint64_t touched(std::size_t link) {
    return world_.view(link).hands[0].servo.count;
  }

  peer::SceneFile scene_;
  InProcess world_;
};

TEST(ContactGroups, ReduceABystandersTrafficWithoutMoreError) {
  Plaza apart(true), together(false);
  const Hearing before = together.hear(10'000), after = apart.hear(10'000);
  std::printf(
      "bystander: %llu datagrams in 10 s, %llu before; error at most %.2f mm, %.2f mm before; "
      "%llu updates were felt\n",
      static_cast<unsigned long long>(after.datagrams),
      static_cast<unsigned long long>(before.datagrams), 1e3 * after.worst, 1e3 * before.worst,
      static_cast<unsigned long long>(apart.world_.count(0, "updates_felt")));
  EXPECT_GT(apart.world_.count(0, "updates_felt"), 100U);
  EXPECT_LT(5 * after.datagrams, before.datagrams);
  EXPECT_LT(after.worst, kThreshold + 0.004 * kFastest);
  EXPECT_EQ(apart.world_.count(2, "datagrams_lost"), 0U);
  EXPECT_GT(apart.world_.view(0).groups, together.world_.view(0).groups) << "where hands meet";
}

TEST(ContactGroups, LoseNobodyAtFivePercentLoss) {
  for (std::uint64_t seed = 1; seed <= tries(4U, 10U); ++seed) {
    Plaza plaza(true, seed, 0.05);
    for (int second = 0; second < 10; ++second) {
      plaza.world_.run(1000);
      for (std::size_t link = 0; link < 3; ++link) {
        ASSERT_EQ(plaza.world_.view(link).entities, 2U) << seed << ": at " << second << " s";
      }
    }
    EXPECT_EQ(plaza.world_.count(0, "timed_out"), 0U) << seed;
  }
}

// A newcomer and the others feel each other as peers that were present before, whether owners or
// leaders introduce them.
TEST(ContactGroups, LateNewcomersFeelTheContact) {
  for (const bool leaders : {false, true}) {
    peer::SceneFile scene = scene_of(plaza(true));
    scene.aoim.leaders = leaders;
    scene.hash = peer::scene_hash(scene);
    InProcess world(2);
    world.start(0, scene);
    world.run(5000);
    world.start(1, scene);
    const std::size_t ms = world.run_until(
        [&] { return world.view(1).entities == 1U && world.view(0).entities == 1U; }, 1000);
    EXPECT_LE(ms, 250U) << leaders;
    world.run(4000);
    EXPECT_GT(world.count(1, "updates_felt"), 50U) << leaders;
    EXPECT_GT(world.count(0, "updates_felt"), 50U) << leaders;
    for (const std::size_t link : {0, 1})
      EXPECT_EQ(world.count(link, "timed_out") + world.count(link, "left"), 0U) << leaders;
  }
}

// The near peers' copy of a contact is no worse than without the tier.
void expect_the_same_feel(const char* what, const peer::SceneFile& scene) {
  peer::Spread force[2], pose[2];
  double packets[2];
  for (const bool apart : {false, true}) {
    peer::SceneFile changed = scene;
    if (apart) changed.aoim.tiers = {{peer::Recipients::touch, {}, false}};
    changed.hash = peer::scene_hash(changed);
    tools::ExerciseOptions options;
    options.simulated_time = true;
    options.epoch = 1;
    tools::Exercise exercise(changed, options);
    exercise.run(seconds(30));
    force[apart] = exercise.measurement().force_error();
    pose[apart] = exercise.measurement().pose_error();
    packets[apart] = static_cast<double>(exercise.total("datagrams_out")) / 60.0;
    EXPECT_GT(exercise.measurement().touching_hands(), 1.0);
    EXPECT_GE(exercise.measurement().energy_min(), -1e-9);
    EXPECT_EQ(exercise.total("datagrams_lost"), 0U);
  }
  std::printf(
      "%s: force p99 %.4f N, %.4f N in contact groups; pose p99 %.3f, %.3f mm; %.1f, %.1f "
      "packets/s a peer\n",
      what, force[0].p99, force[1].p99, 1e3 * pose[0].p99, 1e3 * pose[1].p99, packets[0],
      packets[1]);
  EXPECT_LE(force[1].p99, 1.05 * force[0].p99 + 1e-3);
  EXPECT_LE(pose[1].p99, 1.05 * pose[0].p99 + 1e-5);
}

TEST(ContactGroups, DoNotChangeTheFeelOfRecordedHands) {
  expect_the_same_feel("recorded", shipped_scene());
}

TEST(ContactGroups, DoNotChangeTheFeelOfAPush) {
  expect_the_same_feel("push", scene_of(kTwoHandsOnAWall));
}

// A stranger resends datagrams of a contact group from another address.
TEST(ContactGroups, RefuseDatagramsFromAnotherAddress) {
  Plaza plaza(true);
  plaza.world_.listen(plaza.scene_);
  plaza.world_.run(2000);
  const peer::GroupPool pool = peer::pool_of(plaza.scene_);
  std::size_t forged = 0;
  const std::uint64_t before = plaza.world_.count(1, "datagrams_refused");
  const std::uint64_t heard = plaza.world_.count(1, "updates_in");
  std::vector<Heard> said = plaza.world_.heard();
  for (const Heard& datagram : said) {
    const auto index = pool.index(datagram.group);
    if (!index || *index < plaza.scene_.aoim.pool) continue;
    if (!(datagram.sender == plaza.world_.network().link(0).local_endpoint())) continue;
    static_cast<void>(plaza.world_.network().link(2).send(datagram.group, datagram.octets));
    ++forged;
  }
  ASSERT_GT(forged, 20U);
  plaza.world_.run(2);
  EXPECT_GE(plaza.world_.count(1, "datagrams_refused"), before + forged);
  EXPECT_LE(plaza.world_.count(1, "updates_in"), heard + 2);
  EXPECT_LT(plaza.error(1, 0), kThreshold + 0.004 * kFastest);
}

}  // namespace
}  // namespace reckon::test
