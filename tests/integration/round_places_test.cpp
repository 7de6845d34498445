// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An entity at rest or in motion at round coordinates: multiples of the side of a cell, of half of
// it, of 10 and of 100 m, so often exactly on a border or a corner, on either side of the origin
// and far from it. A position that is written to the wire and read again may be in another cell
// than before. A peer in reach shows it all the time, within the error limit, and so does a distant
// one that follows its beacon.
//
// RECKON_SOAK=1 tries 10,000 seeds, RECKON_SEEDS=N the first N; otherwise a few dozen.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/integration/federates.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test::round_places_test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kThreshold = 0.2;                           // [m]
constexpr std::size_t kOwner = 0, kNear = 1, kFollower = 2;  // federates

/// Random values of a seed.
struct Draw {
  explicit Draw(std::uint64_t seed) : random(seed) {}
  template <typename T, std::size_t N>
  T one_of(const T (&choices)[N]) {
    return choices[std::uniform_int_distribution<std::size_t>(0, N - 1)(random)];
  }
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  }
  bool is(double share) { return uniform(0, 1) < share; }
  /// A round number, or one time in five a neighbour: an adjacent double or a millimetre away.
  double coordinate(double cell) {
    const double steps[]{cell, cell / 2, cell * std::numbers::sqrt3 / 2, 10.0, 100.0};
    const double farthest[]{1, 4, 40, 400};
    const double step = one_of(steps), far = one_of(farthest);
    const double round = step * std::round(uniform(-far, far));
    const double beside[]{std::nextafter(round, 1e9), std::nextafter(round, -1e9), round - 1e-3,
                          round + 1e-3};
    return is(0.2) ? one_of(beside) : round;
  }

  std::mt19937_64 random;
};

/// A scene, an entity at a round position, a watcher in reach, and a follower if it has a beacon.
struct Place {
  static constexpr double kRate = 2.0;  // of the oscillation [rad/s]

  explicit Place(std::uint64_t seed) {
    Draw draw(seed);
    const double cells[]{10, 25, 50, 62.5, 100, 128};
    cell = draw.one_of(cells);
    start = {draw.coordinate(cell), draw.coordinate(cell), 0};
    draw_scene(draw);
    const double speeds[]{0, 0, 0.01, 0.5, 3};
    speed = draw.one_of(speeds);
    const Vector3d ways[]{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 1, 0}};
    way = draw.one_of(ways).normalized();
    // So near that it stays within the radius, at a round offset or a random one.
    const double most = radius - 1.0 - speed, step = std::min(cell, most);
    const double angle = draw.uniform(0, 2 * std::numbers::pi), away = draw.uniform(0, most);
    const Vector3d offsets[]{{0, 0, 0},
                             {step, 0, 0},
                             {0, -step, 0},
                             {away * std::cos(angle), away * std::sin(angle), 0}};
    watcher = start + draw.one_of(offsets);
    const double aside[]{-7 * cell, 0, 11 * cell};
    follower = start + Vector3d(20 * cell, draw.one_of(aside), 0);
  }
  void draw_scene(Draw& draw) {
    const std::string_view schemes[]{"square", "hexagonal", "quadtree"};
    const std::string_view scheme = draw.one_of(schemes);
    const double radii[]{0.5 * cell, cell, 1.7 * cell, 2 * cell};
    radius = draw.one_of(radii);
    const int pools[]{31, 40, 61};
    has_beacon = draw.is(0.5);
    const bool has_leaders = has_beacon || draw.is(0.3);
    text = fmt::format(
        "[scene]\nname = \"round\"\norigin = {{latitude = \"47 deg\", longitude = \"8 deg\", "
        "height = \"430 m\"}}\n[dead_reckoning]\nposition = \"{} m\"\nheartbeat = \"5 s\"\n"
        "[aoim]\nscheme = \"{}\"\nradius = \"{} m\"\npool = {}\n{}{}",
        kThreshold, scheme, radius, draw.one_of(pools),
        has_leaders ? "leaders = true\nhand_out = true\n" : "",
        scheme == "quadtree" ? quarters() : fmt::format("cell = \"{} m\"\n", cell));
  }
  /// A square of 16 cells, divided down to one cell at the position.
  [[nodiscard]] std::string quarters() const {
    std::string path;
    double east = 0, north = 0;
    for (double half = 4 * cell; half >= cell / 2; half /= 2) {
      const bool is_east = start.x() >= east, is_north = start.y() >= north;
      path += static_cast<char>('0' + (is_east ? 1 : 0) + (is_north ? 2 : 0));
      east += is_east ? half : -half;
      north += is_north ? half : -half;
    }
    return fmt::format("[aoim.quadtree]\nside = \"{} m\"\nsmallest = \"{} m\"\nleaves = \"{}\"\n",
                       16 * cell, cell, path);
  }
  /// Back and forth through the round position within 1.5 m.
  [[nodiscard]] peer::EntityTruth truth(nanoseconds now) const {
    peer::EntityTruth truth;
    truth.time = now;
    truth.position = start;
    if (speed == 0) return truth;
    const double t = pdu::to_seconds(now);
    truth.position += speed / kRate * std::sin(kRate * t) * way;
    truth.velocity = speed * std::cos(kRate * t) * way;
    truth.acceleration = -speed * kRate * std::sin(kRate * t) * way;
    return truth;
  }

  std::string text;
  double cell = 0, radius = 0, speed = 0;  // [m], [m/s]
  bool has_beacon = false;
  Vector3d start, way, watcher, follower;
};

peer::EntityDescription description(const peer::SceneFile& scene) {
  peer::EntityDescription thing;
  thing.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
  thing.dead_reckoning = scene.dead_reckoning;
  return thing;
}

void stand(peer::Federate& federate, const peer::SceneFile& scene, const Vector3d& at,
           nanoseconds now) {
  peer::EntityTruth truth;
  truth.time = now;
  truth.position = at;
  federate.register_object(description(scene), truth);
}

/// Of one peer, because all know each other.
struct Looks {
  std::size_t all = 0, hidden = 0;
  double worst = 0;  // [m]
};

void try_place(std::uint64_t seed) {
  const Place place(seed);
  SCOPED_TRACE(fmt::format("seed {}\n{}entity ({:.17g}, {:.17g}) at {} m/s, watcher ({}, {})", seed,
                           place.text, place.start.x(), place.start.y(), place.speed,
                           place.watcher.x(), place.watcher.y()));
  const peer::SceneFile scene = peer::parse_scene_file(place.text, "round");
  Federates federates(3, Federates::delayed(5ms), seed);
  peer::EntityDescription thing = description(scene);
  if (place.has_beacon) thing.beacon = "gate";
  const peer::ObjectHandle handle =
      federates.join(scene).register_object(thing, place.truth(federates.now()));
  stand(federates.join(scene), scene, place.watcher, federates.now());
  if (place.has_beacon) {
    peer::SceneFile following = scene;
    following.aoim.follow = "gate";
    stand(federates.join(following), scene, place.follower, federates.now());
  }
  std::array<Looks, 3> seen;
  const auto drive = [&] {
    federates[kOwner].update_attributes(handle, place.truth(federates.now()));
  };
  const auto look = [&] {
    for (std::size_t i = kNear; i < federates.size(); ++i) {
      std::size_t there = 0;
      federates[i].for_each([&](const peer::RemoteObject& object) {
        if (object.id().application != 1) return;
        ++there;
        const nanoseconds now = federates.now();
        const double off = (object.shown(now).position - place.truth(now).position).norm();
        seen[i].worst = std::max(seen[i].worst, off);
      });
      ++seen[i].all;
      seen[i].hidden += there == 0 ? 1 : 0;
    }
  };
  federates.run(place.has_beacon ? 8s : 3s, 20ms, drive, [] {});
  federates.run(4s, 20ms, drive, look);
  for (std::size_t i = kNear; i < federates.size(); ++i) {
    SCOPED_TRACE(i == kFollower ? "by its beacon" : "in reach");
    EXPECT_EQ(seen[i].hidden, 0U) << "of " << seen[i].all;
    // A distant follower receives the next cell up to 0.4 s after the border.
    const double unseen = i == kFollower ? 0.4 : 0.0;
    const double change = Place::kRate * place.speed * unseen * unseen / 2;
    EXPECT_LE(seen[i].worst, kThreshold + 0.02 + 0.1 * place.speed + change);
  }
}

TEST(RoundPlaces, AreAlwaysShownInReachAndToFollowers) {
  std::uint64_t seeds = test::tries(40U, 10'000U);
  if (const char* given = std::getenv("RECKON_SEEDS")) seeds = std::stoul(given);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) try_place(seed);
}

}  // namespace
}  // namespace reckon::test::round_places_test
