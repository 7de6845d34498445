// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers on a quad-tree and in locales.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/integration/federates.hpp"
#include "reckon/tests/support/tier_rows.hpp"

namespace reckon::test::uneven_cells_test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kPace = 20.0;  // [m/s]
constexpr nanoseconds kLook = 10ms;

peer::SceneFile scene_with(const std::string& cells) {
  return peer::parse_scene_file(
      "[scene]\norigin = { latitude = \"47 deg\", longitude = \"8 deg\" }\n[aoim]\n" + cells,
      "uneven.toml");
}

// A square of 1,600 m with quarters of 800 m; the north-east has 400 m, and there once 100 m.
const std::string kTree =
    "scheme = \"quadtree\"\nradius = 150\npool = 64\n[aoim.quadtree]\nside = 1600\nleaves = \"3000 "
    "3030\"\n";
// A hall, a room with a door to it in the east, a store behind its wall in the north, and a far
// locale in which peers without entities begin.
const std::string kHouse = R"(scheme = "locales"
radius = 60
[[aoim.locale]]
name = "hall"
origin = [1000, 0, 0]
size = [40, 40, 0]
[[aoim.locale]]
name = "room"
origin = [1040, 0, 0]
size = [40, 40, 0]
neighbours = "hall"
[[aoim.locale]]
name = "store"
origin = [1000, 40, 0]
size = [40, 40, 0]
[[aoim.locale]]
name = "lobby"
size = [40, 40, 0]
)";
// Neither: everything within 150 m is received.
const std::string kSquares = "scheme = \"square\"\ncell = 100\nradius = 150\n";

struct Watch {
  std::size_t looks = 0, unseen = 0;
  double worst = 0.0;  // [m]
};

// The first federate has an entity that walks, each other one an entity at rest, and watches.
class Walk {
 public:
  Walk(const std::string& cells, const std::vector<Vector3d>& watchers, const Vector3d& from)
      : scene_(scene_with(cells)), federates_(watchers.size() + 1, Federates::delayed(5ms)) {
    place_ = from;
    join(from);
    for (const Vector3d& place : watchers) join(place);
    watches_.resize(federates_.size());
  }

  // Walks straight to a position, checked by all watchers; begins with their current data.
  void walk_to(const Vector3d& to) {
    const Vector3d from = place_;
    const nanoseconds begin = federates_.now();
    const double length = (to - from).norm();
    for (double gone = 0.0; gone < length;) {
      const nanoseconds next = federates_.now() + kLook;
      gone = std::min(kPace * pdu::to_seconds(next - begin), length);
      place_ = from + gone / length * (to - from);
      pass(kPace / length * (to - from));
    }
  }
  void stand(nanoseconds span) {
    for (const nanoseconds end = federates_.now() + span; federates_.now() < end;)
      pass(Vector3d::Zero());
  }
  void move(std::size_t watcher, const Vector3d& place) {
    federates_[watcher].update_attributes(things_[watcher], at(place, Vector3d::Zero()));
    stand(500ms);
  }
  [[nodiscard]] bool shows(std::size_t watcher) {
    return federates_[watcher].find(federates_.id_of(0)).has_value();
  }
  Watch take(std::size_t watcher) { return std::exchange(watches_[watcher], {}); }

 private:
  [[nodiscard]] peer::EntityTruth at(const Vector3d& place, const Vector3d& velocity) const {
    peer::EntityTruth truth;
    truth.time = federates_.now();
    truth.position = place;
    truth.velocity = velocity;
    return truth;
  }
  void join(const Vector3d& place) {
    peer::EntityDescription thing;
    thing.type.kind = pdu::EntityKind::platform;
    thing.dead_reckoning.thresholds.position = 0.1;
    things_.push_back(federates_.join(scene_).register_object(thing, at(place, Vector3d::Zero())));
  }
  void pass(const Vector3d& velocity) {
    const auto drive = [&] { federates_[0].update_attributes(things_[0], at(place_, velocity)); };
    const auto all_look = [&] {
      for (std::size_t i = 1; i < federates_.size(); ++i) look(i);
    };
    federates_.run(kLook, kLook, drive, all_look);
  }
  void look(std::size_t watcher) {
    const auto shown = federates_[watcher].find(federates_.id_of(0));
    Watch& watch = watches_[watcher];
    ++watch.looks;
    watch.unseen += !shown;
    if (shown)
      watch.worst =
          std::max(watch.worst, (shown->shown(federates_.now()).position - place_).norm());
  }

  peer::SceneFile scene_;
  Federates federates_;
  std::vector<peer::ObjectHandle> things_;
  std::vector<Watch> watches_;
  Vector3d place_ = Vector3d::Zero();
};

// The error of a copy, compared with one on equal cells, at sharp turns.
void expect_as_on_squares(const Watch& seen, Walk& squares, const std::vector<Vector3d>& round,
                          int rounds) {
  squares.stand(4s);
  static_cast<void>(squares.take(1));
  for (int i = 0; i < rounds; ++i)
    for (const Vector3d& place : round) squares.walk_to(place);
  const Watch there = squares.take(1);
  EXPECT_EQ(seen.looks, there.looks);
  EXPECT_EQ(seen.unseen, 0U);
  EXPECT_EQ(there.unseen, 0U);
  EXPECT_LE(seen.worst, 1.05 * there.worst);
}

// Over borders between cells of 800, 400 and 100 m, back and forth, past an entity at rest; with
// all options that depend on cells.
TEST(WholePeersOnATree, ShowEntitiesThatCrossBordersAtOnce) {
  const std::vector<Vector3d> places = {{60, 60, 0}, {700, -700, 0}};
  const std::vector<Vector3d> round = {{150, 60, 0}, {60, -50, 0}, {-50, 60, 0}};
  for (const std::string& more :
       {std::string(), std::string("leaders = true\n"),
        std::string("leaders = true\nhand_out = true\n"), kTouchTier, kDistanceTiers}) {
    SCOPED_TRACE(more);
    Walk walk(more + kTree, places, round.back());
    walk.stand(4s);  // groups that are handed out are used 2.5 s later
    static_cast<void>(walk.take(1));
    static_cast<void>(walk.take(2));
    for (int i = 0; i < 3; ++i)
      for (const Vector3d& place : round) walk.walk_to(place);
    const Watch near = walk.take(1), far = walk.take(2);
    EXPECT_GT(near.looks, 3000U);
    EXPECT_EQ(far.unseen, far.looks);
    Walk squares(more + kSquares, places, round.back());
    expect_as_on_squares(near, squares, round, 3);
  }
}

TEST(WholePeersInLocales, SeeThroughDoorsAndNotThroughWalls) {
  // One in the room, one in the store a step from the hall.
  const std::vector<Vector3d> places = {{1045, 0, 0}, {1000, 21, 0}};
  const std::vector<Vector3d> round = {{1055, 10, 0}, {1000, 15, 0}};
  Walk walk(kHouse, places, round.back());
  walk.stand(2s);
  EXPECT_TRUE(walk.shows(1));
  static_cast<void>(walk.take(1));
  for (int i = 0; i < 5; ++i)
    for (const Vector3d& place : round) walk.walk_to(place);
  const Watch through_the_door = walk.take(1), behind_the_wall = walk.take(2);
  EXPECT_EQ(behind_the_wall.unseen, behind_the_wall.looks) << "6 m away";
  Walk squares(kSquares, places, round.back());
  expect_as_on_squares(through_the_door, squares, round, 5);

  walk.move(2, {1000, 19, 0});
  EXPECT_TRUE(walk.shows(2)) << "now it is in the hall";
}

}  // namespace
}  // namespace reckon::test::uneven_cells_test
