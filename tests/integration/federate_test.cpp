// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Programs that use the API: one program sends its entities, and another one receives them.
#include "reckon/peer/federate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <thread>
#include <vector>

#include "reckon/pdu/management/comment.hpp"
#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using peer::EntityClass;
using peer::Federate;
using peer::FederateOptions;
using std::chrono::nanoseconds;

constexpr pdu::EntityType kTruck{
    pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
constexpr pdu::EntityType kShip{
    pdu::EntityKind::platform, pdu::EntityDomain::surface, 225, 1, 1, 0, 0};

peer::EntityDescription truck() {
  peer::EntityDescription description;
  description.marking = "TRUCK1";
  description.type = kTruck;
  description.force_id = pdu::ForceId::friendly;
  description.appearance = 0x00000010;
  description.capabilities = 3;
  return description;
}

// A world for vehicles among peers with Reckon.
peer::SceneFile country() {
  peer::SceneFile scene = *peer::dis_exercise(1, 0.82, 0.145);
  scene.network.interop = false;
  scene.aoim.cell = 500.0;
  scene.aoim.radius = 2000.0;
  return scene;
}

// Federates in one thread, a pass each 10 ms.
class World {
 public:
  explicit World(const peer::SceneFile& scene, std::size_t count = 2)
      : clock_(1s, 1h), network_(options(count), clock_) {
    for (std::size_t i = 0; i < count; ++i) {
      FederateOptions options;
      options.name = "FED" + std::to_string(i + 1);
      options.scene = scene;
      options.application = static_cast<std::uint16_t>(i + 1);
      federates_.push_back(std::make_unique<Federate>(options, network_.link(i), clock_,
                                                      static_cast<std::uint32_t>(i + 1)));
      (*federates_.back()).subscribe(EntityClass{});
    }
  }
  Federate& operator[](std::size_t i) { return *federates_[i]; }
  peer::ManualClock& clock() { return clock_; }

  template <typename EachPass>
  void run(nanoseconds span, EachPass&& each) {
    for (const nanoseconds end = clock_.now() + span; clock_.now() < end;) {
      clock_.advance(10ms);
      each();
      for (auto& federate : federates_) federate->step();
    }
  }
  void run(nanoseconds span) {
    run(span, [] {});
  }

 private:
  static peer::SimulatedNetworkOptions options(std::size_t count) {
    peer::SimulatedNetworkOptions options;
    options.links = count;
    return options;
  }
  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  std::vector<std::unique_ptr<Federate>> federates_;
};

// A truck on a circle of 50 m, 10 m/s.
peer::EntityTruth on_circle(nanoseconds now) {
  const double angle = 0.2 * pdu::to_seconds(now);
  peer::EntityTruth truth;
  truth.position = 50.0 * Vector3d(std::cos(angle), std::sin(angle), 0.0);
  truth.velocity = 10.0 * Vector3d(-std::sin(angle), std::cos(angle), 0.0);
  truth.acceleration = -2.0 * Vector3d(std::cos(angle), std::sin(angle), 0.0);
  return truth;
}

class Federates : public testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] static peer::SceneFile scene() {
    return GetParam() ? *peer::dis_exercise(1, 0.82, 0.145) : country();
  }
};
INSTANTIATE_TEST_SUITE_P(PlainDisAndCells, Federates, testing::Bool());

TEST_P(Federates, SeeEachOthersEntitiesWithinTheirThresholds) {
  World world(scene());
  world[0].publish(EntityClass{kTruck});
  std::vector<std::string> told;
  world[1].on_discover([&](const peer::RemoteObject& object) {
    told.push_back("discovered " + std::string(object.marking()));
    EXPECT_EQ(object.type(), kTruck);
    EXPECT_EQ(object.force_id(), pdu::ForceId::friendly);
    EXPECT_EQ(object.appearance(), 0x00000010U);
    EXPECT_EQ(object.capabilities(), 3U);
  });
  std::size_t reflected = 0;
  world[1].on_reflect([&](const peer::RemoteObject&) { ++reflected; });
  world[1].on_remove([&](const peer::RemoteObject& object, peer::Removal cause) {
    told.push_back("removed " + std::string(object.marking()) + ": " + std::string(name(cause)));
    EXPECT_EQ(object.type(), kTruck);
    EXPECT_FALSE(world[1].find(object.id()).has_value());
    const nanoseconds now = world.clock().now();
    EXPECT_LE((object.shown(now).position - on_circle(now).position).norm(), 2.0);
  });
  world.run(500ms);

  const peer::ObjectHandle handle =
      world[0].register_object(truck(), on_circle(world.clock().now()));
  double worst = 0.0;
  world.run(30s, [&] {
    world[0].update_attributes(handle, on_circle(world.clock().now()));
    const auto seen = world[1].find(world[0].id_of(handle));
    if (!seen) return;
    const nanoseconds now = world.clock().now();
    const Vector3d off = seen->shown(now).position - on_circle(now).position;
    worst = std::max(worst, off.norm());
  });
  ASSERT_EQ(told, std::vector<std::string>{"discovered TRUCK1"});
  EXPECT_GT(reflected, 5U);
  EXPECT_LT(reflected, 100U);  // of 3,000 truths
  // The threshold of 1 m, and 2 m/s2 for the 20 ms until an update has arrived and is shown.
  EXPECT_LE(worst, 1.1);
  world[0].delete_object(handle);
  world.run(100ms);
  EXPECT_EQ(told.back(), "removed TRUCK1: deactivated");
  EXPECT_EQ(world[1].size(), 0U);
}

TEST_P(Federates, ReceiveSubscribedInteractions) {
  World world(scene());
  std::vector<pdu::Fire> fires;
  std::size_t comments = 0;
  world[1].subscribe<pdu::Fire>([&](const pdu::Fire& fire) { fires.push_back(fire); });
  world[0].publish<pdu::Fire>();
  world[0].publish<pdu::Comment>();
  world.run(500ms);
  pdu::Fire fire;
  fire.firing_entity_id = {1, 1, 7};
  const Vector3d at = world[0].frame().world_from_scene(Vector3d(10, 20, 2));
  fire.location_in_world_coordinates = {at.x(), at.y(), at.z()};
  world[0].send(fire);
  world[0].send(pdu::Comment{});
  world.run(100ms);
  ASSERT_EQ(fires.size(), 1U);
  EXPECT_EQ(fires[0].firing_entity_id, (pdu::EntityId{1, 1, 7}));
  EXPECT_EQ(fires[0].header.exercise_id, 1);
  EXPECT_NE(fires[0].header.timestamp, 0U);
  EXPECT_EQ(comments, 0U);
}

TEST_P(Federates, LateNewcomersReceiveEntitiesAtRest) {
  World world(scene(), 3);
  world[0].publish(EntityClass{kTruck});
  const auto handle = world[0].register_object(truck(), {});
  world.run(3s);
  EXPECT_EQ(world[2].size(), 1U);
  const auto seen = world[2].find(world[0].id_of(handle));
  ASSERT_TRUE(seen);
  EXPECT_LE(seen->shown(world.clock().now()).position.norm(), 1e-6);
}

TEST(FederateDeclarations, ArePreconditionsOfSending) {
  World world(country());
  EXPECT_THROW(world[0].register_object(truck(), {}), std::logic_error);
  EXPECT_THROW(world[0].send(pdu::Fire{}), std::logic_error);
  world[0].publish(EntityClass{kShip});
  EXPECT_THROW(world[0].register_object(truck(), {}), std::logic_error);
  world[0].publish(EntityClass{{pdu::EntityKind::platform}});
  EXPECT_NO_THROW(static_cast<void>(world[0].register_object(truck(), {})));
  peer::EntityDescription long_name = truck();
  long_name.marking = "ALONGMARKING";
  EXPECT_THROW(world[0].register_object(long_name, {}), std::invalid_argument);
}

TEST(FederateObjects, ThatAreGoneCannotBeChanged) {
  World world(country());
  world[0].publish(EntityClass{kTruck});
  const auto handle = world[0].register_object(truck(), {});
  world[0].delete_object(handle);
  EXPECT_THROW(world[0].delete_object(handle), std::logic_error);
  EXPECT_THROW(world[0].update_attributes(handle, {}), std::logic_error);
  EXPECT_THROW(world[0].update_appearance({77}, 0), std::logic_error);
  EXPECT_NE(world[0].register_object(truck(), {}), handle);
}

// One host may fill the table; it makes room for another one.
TEST(FederateObjects, FillTheTableUpToTheScenesEntities) {
  peer::SceneFile scene = country();
  scene.network.entities = 4;
  World world(scene, 3);
  const auto count = [&](const char* name) {
    return world[1].peer().counters().find(name)->value();
  };
  const auto add = [&](std::size_t federate) {
    world[federate].publish(EntityClass{kTruck});
    const auto handle = world[federate].register_object(truck(), {});
    world.run(500ms);
    return world[federate].id_of(handle);
  };
  world.run(500ms);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(world[1].find(add(0)));
  EXPECT_EQ(count("table_full"), 0U);
  EXPECT_FALSE(world[1].find(add(0)));
  EXPECT_GE(count("table_full"), 1U);
  EXPECT_TRUE(world[1].find(add(2)));
  EXPECT_GE(count("rows_evicted"), 1U);
  EXPECT_EQ(world[1].size(), 4U);
}

TEST(FederateObjects, SendTheirLastStateBeforeTheyResign) {
  World world(country());
  std::size_t fires = 0;
  world[1].subscribe<pdu::Fire>([&](const pdu::Fire&) { ++fires; });
  world[0].publish<pdu::Fire>();
  world.run(500ms);
  pdu::Fire fire;
  const Vector3d at = world[0].frame().origin();
  fire.location_in_world_coordinates = {at.x(), at.y(), at.z()};
  world[0].send(fire);
  world[0].resign();
  world.run(100ms);
  EXPECT_EQ(fires, 1U);
}

TEST(FederateDeclarations, OfAClassDiscoverNoOther) {
  World world(country(), 1);
  FederateOptions options;
  options.scene = country();
  EXPECT_TRUE(EntityClass{}.contains(kTruck));
  EXPECT_TRUE((EntityClass{{pdu::EntityKind::platform, pdu::EntityDomain::land}}).contains(kTruck));
  EXPECT_FALSE((EntityClass{{pdu::EntityKind::platform, pdu::EntityDomain::land}}).contains(kShip));
  EXPECT_FALSE(EntityClass{kTruck}.contains(kShip));
}

TEST(FederateTruth, IsNotSentUnlessFinite) {
  World world(country());
  world[0].publish(EntityClass{kTruck});
  const auto handle = world[0].register_object(truck(), {});
  world.run(1s);
  peer::EntityTruth bad;
  bad.position.x() = std::numeric_limits<double>::quiet_NaN();
  world[0].update_attributes(handle, bad);
  world.run(1s);
  const auto seen = world[1].find(world[0].id_of(handle));
  ASSERT_TRUE(seen);
  EXPECT_TRUE(seen->shown(world.clock().now()).position.isZero(1e-6));
}

TEST(FederateTime, FollowsOrdersOfPermittedPeers) {
  peer::SceneFile scene = country();
  scene.network.management = peer::ManagementRule::parse("members").value();
  World world(scene);
  world[0].publish<pdu::StopFreeze>();
  world[0].publish<pdu::StartResume>();
  world.run(1s);
  EXPECT_EQ(world[1].exercise_time(), world[1].utc());
  pdu::StopFreeze stop;
  stop.receiving_entity_id = {0xFFFF, 0xFFFF, 0xFFFF};
  world[0].send(stop);
  world.run(1s);
  const nanoseconds frozen = world[1].exercise_time();
  world.run(2s);
  EXPECT_EQ(world[1].exercise_time(), frozen);
  pdu::StartResume start;
  start.receiving_entity_id = {0xFFFF, 0xFFFF, 0xFFFF};
  start.simulation_time.hour = 100;
  world[0].send(start);
  world.run(1s);
  EXPECT_NEAR(pdu::to_seconds(world[1].exercise_time()), 100 * 3600.0 + 1.0, 0.03);
}

// With own threads over loopback: calls and callbacks of the program cross by message queues.
TEST(FederateThreads, DiscoverSendAndResign) {
  FederateOptions options;
  options.scene = country();
  options.scene->network.exercise = 77;
  options.interface = "lo";
  options.loops = peer::FederateLoops::threads;
  auto one = std::make_unique<Federate>(options);
  options.application = 2;
  Federate two(options);
  two.subscribe(EntityClass{});
  std::size_t fires = 0, removed = 0;
  two.subscribe<pdu::Fire>([&](const pdu::Fire&) { ++fires; });
  two.on_remove([&](const peer::RemoteObject&, peer::Removal) { ++removed; });
  one->publish(EntityClass{kTruck});
  one->publish<pdu::Fire>();
  const auto handle = one->register_object(truck(), {});
  const auto until = [&](auto&& holds) {
    for (int i = 0; i < 1000 && !holds(); ++i) {
      std::this_thread::sleep_for(10ms);
      if (one) {
        one->update_attributes(handle, on_circle(one->now()));
        one->step();
      }
      two.step();
    }
    return holds();
  };
  ASSERT_TRUE(until([&] { return two.size() == 1; }));
  const auto at = one->frame().origin();
  pdu::Fire fire;
  fire.location_in_world_coordinates = {at.x(), at.y(), at.z()};
  one->send(fire);
  EXPECT_TRUE(until([&] { return fires == 1; }));
  two.for_each([&](const peer::RemoteObject& object) {
    EXPECT_LE((object.shown(two.now()).position - on_circle(one->now()).position).norm(), 20.0);
  });
  one.reset();
  EXPECT_TRUE(until([&] { return removed == 1 && two.size() == 0; }));
}

}  // namespace
}  // namespace reckon::test
