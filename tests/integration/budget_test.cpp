// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer with a limited receive rate ([aoim] budget): it leaves the most distant cells, and
// continues to feel the entities that it touches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/integration/federates.hpp"
#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test::budget_test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using std::chrono::nanoseconds;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr double kTurn = 3.0, kSpeed = 6.0;  // of the cars [m], [m/s]
constexpr int kCars = 10;                    // at each position

peer::SceneFile town(bool tiers) {
  peer::SceneFile scene = *peer::dis_exercise(1, 0.3, 0.145);
  scene.network.interop = false;
  scene.aoim.scheme = aoim::CellScheme::square;
  scene.aoim.cell = 50.0;
  scene.aoim.radius = 300.0;
  scene.aoim.pool = 200;
  if (tiers) scene.aoim.tiers = peer::distance_tiers(aoim::default_channels());
  scene.hash = peer::scene_hash(scene);
  return scene;
}

peer::EntityTruth car_at(const Vector3d& place, double phase, nanoseconds now) {
  const double angle = phase + kSpeed / kTurn * pdu::to_seconds(now);
  const Vector3d arm(std::cos(angle), std::sin(angle), 0.0);
  peer::EntityTruth truth;
  truth.time = now;
  truth.position = place + kTurn * arm;
  truth.velocity = kSpeed * Vector3d(-arm.y(), arm.x(), 0.0);
  truth.acceleration = -kSpeed * kSpeed / kTurn * arm;
  return truth;
}

// The first federate rests in the centre of a cell. Others have ten cars each that circle in the
// centres of other cells.
class Town {
 public:
  Town(const peer::SceneFile& scene, double budget, const std::vector<double>& away)
      : federates_(away.size() + 1, Federates::delayed(5ms), 7) {
    peer::SceneFile ours = scene;
    ours.aoim.awareness.budget = budget;
    peer::Federate& watcher = federates_.join(ours);
    peer::EntityTruth stands;
    stands.time = federates_.now();
    stands.position = {25, 25, 0};
    watcher.register_object(description(), stands);
    for (const double x : away) {
      peer::Federate& owner = federates_.join(scene);
      for (int i = 0; i < kCars; ++i) {
        peer::EntityDescription car = description();
        car.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
        cars_.push_back({federates_.size() - 1, {}, {25 + x, 25, 0}, 0.6 * i});
        cars_.back().handle = owner.register_object(car, truth(cars_.back()));
      }
    }
  }

  void run(nanoseconds span) {
    const auto drive = [&] {
      for (const Car& car : cars_) federates_[car.owner].update_attributes(car.handle, truth(car));
    };
    federates_.run(span, 20ms, drive, [&] {
      for (auto& notices = federates_[0].peer().notices(); notices.front() != nullptr;
           notices.pop())
        notices_.emplace_back(notices.front()->text.data());
    });
  }
  /// Receive rate of the first federate in `span` [B/s].
  double heard(nanoseconds span) {
    const std::uint64_t before = federates_.count(0, "octets_in");
    run(span);
    return static_cast<double>(federates_.count(0, "octets_in") - before) / pdu::to_seconds(span);
  }
  /// Cars shown to the first federate, by owner from 1.
  std::vector<int> shown() {
    std::vector<int> shown(federates_.size(), 0);
    federates_[0].for_each(
        [&](const peer::RemoteObject& object) { ++shown[object.id().application - 1u]; });
    return {shown.begin() + 1, shown.end()};
  }
  void stop() { stopped_at_ = federates_.now(); }
  const std::vector<std::string>& notices() const { return notices_; }

 private:
  struct Car {
    std::size_t owner;
    peer::ObjectHandle handle;
    Vector3d place;
    double phase;
  };
  static peer::EntityDescription description() {
    peer::EntityDescription thing;
    thing.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
    return thing;
  }
  peer::EntityTruth truth(const Car& car) const {
    peer::EntityTruth truth = car_at(car.place, car.phase, stopped_at_.value_or(federates_.now()));
    truth.time = federates_.now();
    if (stopped_at_) truth.velocity = truth.acceleration = Vector3d::Zero();
    return truth;
  }

  Federates federates_;
  std::vector<Car> cars_;
  std::optional<nanoseconds> stopped_at_;
  std::vector<std::string> notices_;
};

const std::vector<double> kStreet{0, 50, 100, 150, 200, 250};

TEST(Budget, LeavesTheFarthestCellsAndShowsTheNearest) {
  Town all(town(false), 0, kStreet);
  all.run(10s);
  const double whole = all.heard(20s);
  EXPECT_THAT(all.shown(), testing::Each(kCars));
  for (const double share : {0.75, 0.5, 0.3}) {
    if (share == 0.5 && !soaks()) continue;
    Town place(town(false), share * whole, kStreet);
    place.run(30s);
    const std::vector<int> shown = place.shown();
    place.run(60s);
    const double heard = place.heard(100s);
    std::printf(
        "[ residual ] %.0f of %.0f B/s heard, %.0f without a budget; shown %d %d %d %d %d %d\n",
        heard, share * whole, whole, shown[0], shown[1], shown[2], shown[3], shown[4], shown[5]);
    // From time to time it checks whether there is more room.
    EXPECT_LE(heard, 1.1 * share * whole);
    EXPECT_EQ(shown[0], kCars);
    EXPECT_EQ(shown[5], 0);
    EXPECT_TRUE(std::is_sorted(shown.rbegin(), shown.rend())) << "the nearest first";
    for (const int cars : shown) EXPECT_TRUE(cars == 0 || cars == kCars) << cars;
    EXPECT_THAT(place.notices(), Contains(HasSubstr("cells farther than")));
    EXPECT_THAT(place.notices(), Not(Contains(HasSubstr("cannot be met"))));
  }
}

TEST(Budget, KeepsItsCellAndReportsAnExceededBudget) {
  Town place(town(false), 200, kStreet);
  place.run(60s);
  const std::vector<int> shown = place.shown();
  EXPECT_EQ(shown[0], kCars);
  EXPECT_EQ(shown[2], 0);
  const auto unmet = std::ranges::count_if(place.notices(), [](const std::string& notice) {
    return notice.find("cannot be met") != std::string::npos;
  });
  EXPECT_EQ(unmet, 1);
}

TEST(Budget, ShowsDistantEntitiesAgainAfterTheCrowdRests) {
  Town place(town(false), 6000, kStreet);
  place.run(40s);
  ASSERT_EQ(place.shown().back(), 0);
  place.stop();
  place.run(4min);
  EXPECT_THAT(place.shown(), testing::Each(kCars));
  EXPECT_THAT(place.notices(), Contains(HasSubstr("all cells in range fit the budget again")));
}

TEST(Budget, BindsBesideTiersToo) {
  for (const double budget : {12'000.0, 7000.0}) {
    Town place(town(true), budget, kStreet);
    place.run(90s);
    const double heard = place.heard(100s);
    std::printf("[ residual ] with tiers %.0f of %.0f B/s heard\n", heard, budget);
    EXPECT_LE(heard, 1.1 * budget);
    EXPECT_EQ(place.shown()[0], kCars);
  }
}

// Both hands press each other across a border of cells.
TEST(Budget, NeverCostsTheContact) {
  const std::string scene = R"(
[scene]
name = "border"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}
[hand]
radius = "10 mm"
k1 = "300 N/m"
[aoim]
pool = 16
cell = "1 m"
radius = "4 m"
budget = "1 B"
[[operator]]
sweep = {from = [-0.03, 0.5, 0.0], to = [-0.002, 0.5, 0.0], period = "240 s"}
[[operator]]
passive = true
position = [0.010, 0.5, 0.0]
stiffness = "150 N/m"
)";
  InProcess world(2, 1);
  const peer::SceneFile made = scene_of(scene);
  world.listen(made);
  world.start(0, made);
  world.start(1, made);
  const auto felt = [&](std::size_t link) {
    const haptics::ServoSnapshot& servo = world.view(link).servo();
    return servo.count > 0 ? servo.contacts[0].force.norm() : 0.0;
  };
  const auto press = [&] { return felt(0) > 0.2 && felt(1) > 0.2; };
  ASSERT_LE(world.run_until(press, 120'000), 120'000u);
  EXPECT_THAT(world.notices(0), Contains(HasSubstr("cannot be met")));
  for (int second = 0; second < 20; ++second) {
    world.run(1000);
    EXPECT_TRUE(press()) << second;
  }
}

}  // namespace
}  // namespace reckon::test::budget_test
