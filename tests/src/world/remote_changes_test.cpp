// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Many remote entities that appear, change and disappear: reported changes, copies, and capacity.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/src/support/incoming_half.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer::remote_changes_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// The incoming half of a peer in a world of 100 km; the test sets the time.
class World {
 public:
  explicit World(std::size_t capacity, bool record = true, const std::string& sections = "")
      : half_("[aoim]\nradius = \"100 km\"\ncell = \"10 km\"\n" + sections,
              [=](const SceneFile& scene) -> RemoteSettings {
                RemoteSettings settings{0.01, scene.convergence, {}, capacity};
                settings.strangers_memory = std::size_t{1} << 30;
                settings.contact_reach = 0.25;
                settings.record_changes = record;
                return settings;
              }) {}

  void hear(const pdu::EntityId& id, const Eigen::Vector3d& place, std::uint32_t epoch = 0,
            std::uint32_t appearance = 0) {
    deadreckon::KinematicState state;
    state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    state.position = place;
    state.velocity = {10, 0, 0};
    Inbound update;
    update.has_model = id.entity % 2 == 0;
    update.model.kind = pdu::ForceModelKind::sphere;
    update.state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
    half_.put_state(update, id, state, now_ + ahead);
    update.state.appearance = appearance;
    half_.take(update, now_, epoch);
  }
  void account(const pdu::EntityId& id, std::uint32_t epoch) {
    Inbound update;
    update.entity = id;
    update.account_count = 1;
    half_.take(update, now_, epoch);
  }

  nanoseconds ahead{0};  // offset of the next sender's clock

  void wait(nanoseconds by) { now_ += by; }
  [[nodiscard]] nanoseconds now() const { return now_; }
  [[nodiscard]] RemoteEntities& remote() { return half_.remote; }
  [[nodiscard]] std::uint64_t count(std::string_view name) const { return half_.count(name); }

 private:
  test::IncomingHalf half_;
  nanoseconds now_ = std::chrono::seconds(1);
};

// --- changes

// Follows the entities by their changes only.
class Follower {
 public:
  struct Seen {
    std::uint32_t version = 0;
    nanoseconds first_heard{0};
    friend bool operator==(const Seen&, const Seen&) = default;
  };

  void follow(RemoteEntities& remote) {
    for (const EntityChange& change : remote.take_changes()) {
      const bool known = seen_.count(change.id) > 0;
      EXPECT_EQ(known, change.change != Change::discovered);
      ++told[static_cast<std::size_t>(change.change)];
      if (change.change == Change::removed) {
        seen_.erase(change.id);
      } else if (const RemoteEntity* row = remote.find(change.id)) {
        seen_[change.id] = {row->version, row->first_heard};
      } else {
        ADD_FAILURE() << "told of one that is not there";
      }
    }
    std::map<pdu::EntityId, Seen> there;
    for (const RemoteEntity& row : remote.rows()) there[row.id] = {row.version, row.first_heard};
    EXPECT_EQ(seen_, there);
  }

  std::array<std::size_t, 3> told{};

 private:
  std::map<pdu::EntityId, Seen> seen_;
};

void do_something(World& world, std::mt19937& random) {
  const auto below = [&](unsigned n) { return static_cast<std::uint16_t>(random() % n); };
  const pdu::EntityId id{7, below(3), static_cast<std::uint16_t>(1 + below(12))};
  const unsigned what = below(100);
  world.wait(milliseconds(1 + below(20)));
  if (what < 60) {
    world.hear(id, {1.0 * below(100), 0, 0}, below(40) == 0 ? 2 : 1);
  } else if (what < 70) {
    world.account(id, 1);
  } else if (what < 85) {
    world.hear(id, {0, 0, 0}, 1, pdu::kAppearanceDeactivated);
  } else if (what < 88) {
    world.hear(id, {250'000, 0, 0}, 1);  // beyond the radius
  } else if (what < 91) {
    world.remote().drop_peer({7, below(3)}, Gone::silent, {});
  } else if (what < 93) {
    world.wait(std::chrono::seconds(1 + below(12)));
  } else {
    world.remote().expire(world.now());
  }
}

TEST(Changes, FollowedGiveTheTable) {
  std::array<std::size_t, 3> told{};
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    World world(seed % 2 == 0 ? 30 : 100);  // full or not
    Follower follower;
    for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
      do_something(world, random);
      if (random() % (1 + 3 * seed) == 0) follower.follow(world.remote());
    }
    follower.follow(world.remote());
    for (std::size_t k = 0; k < told.size(); ++k) told[k] += follower.told[k];
  }
  std::printf("%zu discovered, %zu updated, %zu removed\n", told[0], told[1], told[2]);
  for (const std::size_t count : told) EXPECT_GT(count, 1000U);
}

TEST(Changes, AreReportedOncePerEntityAndInterval) {
  World world(10);
  const pdu::EntityId id{7, 8, 9};
  const auto changes = [&] {
    std::string text;
    for (const EntityChange& change : world.remote().take_changes())
      text += "dur"[static_cast<std::size_t>(change.change)];
    return text;
  };
  const auto hear = [&](std::uint32_t appearance = 0) {
    world.wait(milliseconds(10));
    world.hear(id, {0, 0, 0}, 0, appearance);
  };
  for (int i = 0; i < 5; ++i) hear();
  EXPECT_EQ(changes(), "d");
  EXPECT_EQ(changes(), "");
  for (int i = 0; i < 5; ++i) hear();
  EXPECT_EQ(changes(), "u");
  hear(), hear(pdu::kAppearanceDeactivated);
  EXPECT_EQ(changes(), "r");
  hear(), hear(pdu::kAppearanceDeactivated);
  EXPECT_EQ(changes(), "");
  hear();
  EXPECT_EQ(changes(), "d");
  for (int i = 0; i < 5; ++i) hear(pdu::kAppearanceDeactivated), hear();
  EXPECT_EQ(changes(), "rd");
}

TEST(Changes, StateWhyAnEntityIsGone) {
  World world(10);
  const pdu::EntityId id{7, 8, 9};
  // The cause of its removal, after it was reported as added.
  const auto cause_of = [&](auto&& end) {
    world.wait(milliseconds(10));
    world.hear(id, {0, 0, 0}, 1);
    (void)world.remote().take_changes();
    world.wait(milliseconds(10));
    end();
    const auto changes = world.remote().take_changes();
    return changes.empty() || changes[0].change != Change::removed
               ? std::string("is there")
               : std::string(name(changes[0].cause));
  };
  EXPECT_EQ(cause_of([] {}), "is there");
  EXPECT_EQ(cause_of([&] {
              world.hear(id, {0, 0, 0}, 1, pdu::kAppearanceDeactivated);
            }),
            "deactivated");
  EXPECT_EQ(cause_of([&] { world.remote().drop_peer({7, 8}, Gone::left, {}); }), "owner left");
  EXPECT_EQ(cause_of([&] { world.remote().drop_peer({7, 8}, Gone::silent, {}); }), "silent");
  EXPECT_EQ(cause_of([&] {
              world.wait(std::chrono::seconds(60));
              world.remote().expire(world.now());
            }),
            "silent");
  EXPECT_EQ(cause_of([&] { world.remote().claim({7, 8}, 2); }), "owner changed");
  EXPECT_EQ(cause_of([&] { world.hear(id, {250'000, 0, 0}, 1); }), "out of sight");
}

TEST(Changes, AllocateNothingAndAreOptional) {
  for (const bool record : {true, false}) {
    World world(40, record);
    std::mt19937 random(1);
    std::size_t told = 0;
    const reckon::test::AllocationGuard guard;
    for (int i = 0; i < 3000; ++i) {
      do_something(world, random);
      if (i % 1000 == 999) told += world.remote().take_changes().size();
    }
    EXPECT_EQ(guard.count(), 0U);
    EXPECT_EQ(told > 0, record);
  }
}

// --- copies

TEST(Copies, OutliveChangesAndRemovalOfTheirRow) {
  for (const char* prediction : {"as_sent", "adaptive"}) {
    SCOPED_TRACE(prediction);
    World world(10, false, std::string("[convergence]\nprediction = \"") + prediction + "\"\n");
    const pdu::EntityId id{7, 8, 9};
    world.hear({7, 8, 1}, {0, 0, 0});
    for (int i = 0; i < 6; ++i) {
      world.wait(milliseconds(100));
      world.hear(id, {1.1 * i, 0.2 * i * i, 0});
    }
    const RemoteEntity* row = world.remote().find(id);
    ASSERT_NE(row, nullptr);
    const RemoteCopy copy(*row);
    std::map<nanoseconds, deadreckon::Pose> shown;
    for (int k = 0; k < 40; ++k) {
      const nanoseconds at = world.now() + milliseconds(10 * k);
      shown[at] = row->shown(at);
    }
    world.wait(milliseconds(100));
    world.hear(id, {50, 50, 50});
    world.remote().drop_peer({7, 8}, Gone::left, {});
    for (const auto& [at, pose] : shown) {
      EXPECT_EQ(copy.shown(at).position, pose.position);
      EXPECT_EQ(copy.shown(at).orientation.coeffs(), pose.orientation.coeffs());
      EXPECT_EQ(copy.shown(at).velocity, pose.velocity);
    }
    EXPECT_EQ(copy.entity().id, id);
  }
}

// The data beside the rows moves with them: each entity continues from its own history.
TEST(Copies, KeepTheirEntityWhenOthersAreRemoved) {
  World world(10, false, "[convergence]\nprediction = \"adaptive\"\n");
  World alone(10, false, "[convergence]\nprediction = \"adaptive\"\n");
  for (int i = 0; i < 8; ++i) {
    world.wait(milliseconds(100)), alone.wait(milliseconds(100));
    if (i < 4) world.hear({7, 8, 1}, {3.0 * i * i, 0, 0});
    for (World* each : {&world, &alone}) each->hear({7, 8, 2}, {1.1 * i, 0.2 * i * i, 0});
    if (i == 5) world.hear({7, 8, 1}, {0, 0, 0}, 0, pdu::kAppearanceDeactivated);
  }
  const nanoseconds at = world.now() + milliseconds(70);
  ASSERT_EQ(world.remote().rows().size(), 1U);
  EXPECT_EQ(world.remote().rows()[0].shown(at).position,
            alone.remote().rows()[0].shown(at).position);
  EXPECT_NE(world.remote().rows()[0].shown(at).position,
            world.remote().rows()[0].predicted(at).position);
}

TEST(RemoteEntities, KeepTheirSendersClockWhenOthersAreRemoved) {
  World world(10);
  for (int i = 0; i < 6; ++i) {
    world.wait(milliseconds(100));
    world.ahead = std::chrono::minutes(20);
    if (i < 3) world.hear({7, 8, 1}, {0, 0, 0});
    if (i == 3) world.hear({7, 8, 1}, {0, 0, 0}, 0, pdu::kAppearanceDeactivated);
    world.ahead = nanoseconds(0);
    world.hear({7, 8, 2}, {0, 0, 0});
  }
  ASSERT_EQ(world.remote().rows().size(), 1U);
  EXPECT_EQ(world.remote().rows()[0].updates, 6U);
  EXPECT_EQ(world.count("stale_in"), 0U);
}

// --- capacity

TEST(RemoteEntities, ManyEntitiesExpireIndividually) {
  constexpr std::uint32_t kMany = 20'000;
  World world(kMany);
  const auto id = [](std::uint32_t i) {
    return pdu::EntityId{7, static_cast<std::uint16_t>(1 + i / 1000),
                         static_cast<std::uint16_t>(1 + i % 1000)};
  };
  for (std::uint32_t i = 0; i < kMany; ++i) {
    world.hear(id(i), {0, 0, 0});
    world.wait(std::chrono::microseconds(50));  // the last one second after the first
  }
  world.hear({8, 1, 1}, {0, 0, 0});
  EXPECT_EQ(world.count("table_full"), 1U);
  EXPECT_EQ(world.remote().rows().size(), kMany);
  for (const std::uint32_t i : {0U, 1U, 777U, kMany - 1}) {
    ASSERT_NE(world.remote().find(id(i)), nullptr);
    EXPECT_EQ(world.remote().find(id(i))->id, id(i));
  }

  // Aircraft expire after 12 s: exactly half of them are left half a second later.
  world.remote().expire(std::chrono::seconds(13) + std::chrono::microseconds(50) * (kMany / 2));
  EXPECT_EQ(world.remote().rows().size(), kMany / 2);
  EXPECT_EQ(world.remote().find(id(kMany / 2 - 1)), nullptr);
  EXPECT_NE(world.remote().find(id(kMany / 2)), nullptr);
  world.remote().expire(std::chrono::seconds(30));
  EXPECT_TRUE(world.remote().rows().empty());
  EXPECT_EQ(world.count("timed_out"), kMany);
}

}  // namespace
}  // namespace reckon::peer::remote_changes_test
