// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers whose scene thins updates by distance ([[aoim.tier]]), and their awareness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/integration/federates.hpp"

namespace reckon::test::channels_test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kTurn = 20.0, kSpeed = 10.0;  // [m], [m/s]
constexpr double kThreshold = 0.01;            // [m]
// In the second until the next update the prediction of a turning car errs by its jerk alone: v^3
// t^3 / 6 r^2. A tenth more is for the delay and convergence.
constexpr double kFarError = 1.1 * kSpeed * kSpeed * kSpeed / (6 * kTurn * kTurn);

peer::SceneFile country(bool channels) {
  peer::SceneFile scene = *peer::dis_exercise(1, 0.82, 0.145);
  scene.network.interop = false;
  scene.aoim.cell = 500.0;
  scene.aoim.radius = 2000.0;
  if (channels) scene.aoim.tiers = peer::distance_tiers(aoim::default_channels());
  scene.hash = peer::scene_hash(scene);
  return scene;
}

peer::EntityTruth car_at(nanoseconds now) {
  const double angle = kSpeed / kTurn * pdu::to_seconds(now);
  peer::EntityTruth truth;
  truth.time = now;
  truth.position = {kTurn * std::cos(angle), kTurn * std::sin(angle), 0.0};
  truth.velocity = {-kSpeed * std::sin(angle), kSpeed * std::cos(angle), 0.0};
  truth.acceleration = -kSpeed * kSpeed / (kTurn * kTurn) * truth.position;
  return truth;
}

peer::EntityTruth standing_at(const Vector3d& place, nanoseconds now) {
  peer::EntityTruth truth;
  truth.time = now;
  truth.position = place;
  return truth;
}

// The first federate has a car that circles; each other one has an entity at rest and watches. One
// pass each 10 ms.
class Roundabout {
 public:
  explicit Roundabout(const peer::SceneFile& scene)
      : scene_(scene), federates_(4, Federates::delayed(5ms), 7) {
    federates_.join(scene_);
    peer::EntityDescription car = description();
    car.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::rvw;
    car.dead_reckoning.thresholds.position = kThreshold;
    car_ = federates_[0].register_object(car, car_at(now()));
  }

  void join_at(const Vector3d& place) {
    things_.push_back(
        federates_.join(scene_).register_object(description(), standing_at(place, now())));
  }
  void move(std::size_t watcher, const Vector3d& place) {
    federates_[watcher].update_attributes(things_[watcher - 1], standing_at(place, now()));
  }

  void run(nanoseconds span) {
    const auto drive = [&] {
      if (drives_) federates_[0].update_attributes(car_, car_at(now()));
    };
    const auto all_look = [&] {
      for (std::size_t i = 1; i < federates_.size(); ++i) look(i);
    };
    federates_.run(span, 10ms, drive, all_look);
  }
  void stop_the_car(const Vector3d& place) {
    drives_ = false;
    federates_[0].update_attributes(car_, standing_at(place, now()));
  }

  /// Rate of a counter of the first federate over `span` [1/s].
  double rate(const char* counter, nanoseconds span) {
    const std::uint64_t before = count(0, counter);
    for (auto& worst : worst_) worst = 0;
    run(span);
    return static_cast<double>(count(0, counter) - before) / pdu::to_seconds(span);
  }
  std::uint64_t count(std::size_t federate, const char* counter) {
    return federates_.count(federate, counter);
  }
  /// Greatest error of the car as a federate showed it since rate() was called [m].
  double worst(std::size_t watcher) const { return worst_[watcher]; }
  std::size_t shown(std::size_t watcher) { return federates_[watcher].size(); }
  peer::Federate& operator[](std::size_t i) { return federates_[i]; }
  nanoseconds now() const { return federates_.now(); }

 private:
  static peer::EntityDescription description() {
    peer::EntityDescription thing;
    thing.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
    return thing;
  }
  void look(std::size_t watcher) {
    federates_[watcher].for_each([&](const peer::RemoteObject& object) {
      if (object.id().application != 1 || !drives_) return;
      const double off = (object.shown(now()).position - car_at(now()).position).norm();
      worst_[watcher] = std::max(worst_[watcher], off);
    });
  }

  peer::SceneFile scene_;
  Federates federates_;
  std::vector<peer::ObjectHandle> things_;
  peer::ObjectHandle car_{};
  bool drives_ = true;
  double worst_[4] = {};
};

TEST(Channels, NearReceiversGetAllUpdatesDistantOnesFew) {
  Roundabout all(country(false)), thinned(country(true));
  for (Roundabout* place : {&all, &thinned}) {
    place->join_at({600, 0, 0});
    place->run(5s);
  }
  const double plain = all.rate("updates_out", 20s), far = thinned.rate("updates_out", 20s);
  std::printf("[ residual ] %.2f updates/s to all, %.2f to one at 600 m: off by %.3f and %.3f m\n",
              plain, far, all.worst(1), thinned.worst(1));
  EXPECT_GT(plain, 2.0);
  EXPECT_NEAR(far, 1.0, 0.1);
  EXPECT_LT(all.worst(1), 2 * kThreshold + 0.06);
  EXPECT_LT(thinned.worst(1), kFarError);
  EXPECT_GT(thinned.worst(1), 3 * kThreshold) << "the car does need more updates";

  thinned.join_at({30, 20, 0});
  thinned.run(3s);
  const double near = thinned.rate("updates_out", 20s);
  std::printf(
      "[ residual ] %.2f updates/s with one at 30 m: off by %.3f m there, %.3f m at 600 m\n", near,
      thinned.worst(2), thinned.worst(1));
  EXPECT_NEAR(near, plain, 0.1 * plain);
  EXPECT_LT(thinned.worst(2), 2 * kThreshold + 0.06);
  EXPECT_LT(thinned.worst(1), 2 * kThreshold + 0.06) << "the stream is one";
}

TEST(Channels, DoNotChangeUpdatesForNearReceivers) {
  Roundabout all(country(false)), thinned(country(true));
  for (Roundabout* place : {&all, &thinned}) {
    place->join_at({30, 20, 0});
    place->run(20s);
  }
  EXPECT_EQ(thinned.count(0, "octets_out"), all.count(0, "octets_out"));
  EXPECT_EQ(thinned.count(0, "datagrams_out"), all.count(0, "datagrams_out"));
  EXPECT_EQ(thinned.count(0, "updates_held_back"), 0u);
}

TEST(Channels, FollowAnApproachingReceiverWithinTwoHundredMilliseconds) {
  Roundabout place(country(true));
  place.join_at({600, 0, 0});
  place.run(10s);
  place.move(1, {25, 0, 0});
  place.run(200ms);
  EXPECT_GT(place.rate("updates_out", 5s), 2.0);
}

// The outermost tier grants moving entities no updates. Recorders and plain DIS programs drop an
// entity after 2.4 heartbeats without one.
TEST(Channels, SendHeartbeatsOfDeferredEntities) {
  peer::SceneFile scene = country(true);
  scene.aoim.tiers.back().channel.active_hz = 0.0;
  Roundabout place(scene);
  place.join_at({600, 0, 0});
  place.run(5s);
  const std::uint64_t before = place.count(0, "updates_out");
  place.run(200s);
  const std::uint64_t sent = place.count(0, "updates_out") - before;
  EXPECT_GE(sent, 3u);
  EXPECT_LE(sent, 8u) << "a heartbeat may be sent twice";
}

TEST(Channels, SendHeldBackStatesInTheEnd) {
  Roundabout place(country(true));
  place.join_at({600, 0, 0});
  place.run(10s);
  // It rests elsewhere, just after an update, and gets no further truth.
  const std::uint64_t before = place.count(0, "updates_out");
  while (place.count(0, "updates_out") == before) place.run(10ms);
  place.stop_the_car({3, 0, 0});
  place.run(6s);
  bool seen = false;
  place[1].for_each([&](const peer::RemoteObject& object) {
    seen = seen || (object.shown(place.now()).position - Vector3d(3, 0, 0)).norm() < kThreshold;
  });
  EXPECT_TRUE(seen);
}

TEST(Channels, GiveLessToAReceiverWithLessBudget) {
  peer::SceneFile poor = country(true);
  poor.aoim.awareness.budget = 1000.0;
  Roundabout place(poor);
  place.join_at({0, 0, 45});  // at a constant distance
  place.run(5s);
  const double rate = place.rate("updates_out", 20s);
  std::printf("[ residual ] %.2f updates/s to one that takes 1,000 B/s, 49 m away\n", rate);
  EXPECT_LT(rate, 1.2);
}

TEST(Awareness, ShowsWantedKindsWithinTheAuraBeforeWalls) {
  const auto shown = [](const auto& change) {
    peer::SceneFile scene = country(false);
    change(scene.aoim.awareness);
    Roundabout place(scene);
    place.join_at({600, 0, 0});
    place.run(4s);
    return place.shown(1);
  };
  EXPECT_EQ(shown([](peer::AwarenessConfig&) {}), 1u);
  EXPECT_EQ(shown([](peer::AwarenessConfig& config) { config.kinds_wanted = 1U << 3; }), 0u);
  EXPECT_EQ(shown([](peer::AwarenessConfig& config) { config.kinds_wanted = 1U << 1; }), 1u);
  EXPECT_EQ(shown([](peer::AwarenessConfig& config) { config.aura = 500; }), 0u);
  EXPECT_EQ(shown([](peer::AwarenessConfig& config) { config.aura = 700; }), 1u);
  const auto wall = [](double y) {
    return [y](peer::AwarenessConfig& config) {
      config.occluders.push_back({Vector3d(300, y, -50), Vector3d(301, y + 100, 50)});
    };
  };
  EXPECT_EQ(shown(wall(-50)), 0u);
  EXPECT_EQ(shown(wall(100)), 1u) << "it stands aside";
}

TEST(Awareness, WalkingRoundAWallRevealsEntitiesBehindIt) {
  peer::SceneFile scene = country(false);
  scene.aoim.awareness.occluders.push_back({Vector3d(300, -50, -50), Vector3d(301, 50, 50)});
  Roundabout place(scene);
  place.join_at({600, 0, 0});
  place.stop_the_car({0, 0, 0});
  place.run(10s);
  EXPECT_EQ(place.shown(1), 0u);
  place.move(1, {600, 300, 0});
  place.run(1200ms);
  EXPECT_EQ(place.shown(1), 1u);
}

TEST(Awareness, ANimbusReachesBeyondTheRadius) {
  for (const double reach : {0.0, 800.0}) {
    peer::SceneFile scene = country(false);
    scene.aoim.radius = 100.0;
    scene.aoim.cell = 50.0;
    scene.aoim.awareness.nimbus.push_back({{pdu::EntityKind::platform}, reach});
    Roundabout place(scene);
    place.join_at({600, 0, 0});
    place.run(4s);
    EXPECT_EQ(place.shown(1), reach > 0 ? 1u : 0u);
  }
}

}  // namespace
}  // namespace reckon::test::channels_test
